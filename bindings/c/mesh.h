// The contents of a scarp_mesh.
#pragma once

#include <mutex>
#include <optional>
#include <string>
#include <vector>

#include "scarp/io.h"
#include "scarp/measure.h"
#include "scarp/mesh.h"
#include "scarp/simplify.h"
#include "scarp_c.h"
#include "session/options/output_kind.h"
#include "session/options/values.h"

struct scarp_bytes {
  std::vector<std::uint8_t> bytes;
};

struct scarp_mesh {
  scarp::Mesh mesh;  ///< z up
  std::optional<scarp_report> report;
  scarp::cli::OutputFormat format;  ///< format that the mesh was made for
  scarp::cli::Given up;
  std::string crs;  ///< requested CRS
  bool is_print = false, doubles = false;
  scarp::GlbOptions glb;
  std::string warnings;

  const float* rounded() const;

 private:
  mutable std::once_flag once_;
  mutable std::vector<float> rounded_;
};

namespace scarp::door {

/// Triangles have 32-bit vertex ids, one of which means none.
constexpr std::uint64_t kMostVertices = 0xfffffffe;

scarp_report describe_measurement(const Measurement& measured);
scarp_report describe_run(const Simplified& simplified);
std::string join_lines(const std::vector<std::string>& sentences);
/// Copies everything except the float32 positions.
std::unique_ptr<scarp_mesh> copy_mesh(const scarp_mesh& mesh);

}  // namespace scarp::door
