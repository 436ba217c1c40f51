// Materials by polygon, and node strings along lines. Reads their files and assigns them to parts of a mesh.
#pragma once

#include <array>
#include <cstdint>
#include <string>
#include <vector>

#include "scarp/features.h"
#include "scarp/io.h"
#include "session/options/given_options.h"
#include "simplify/zones.h"

namespace scarp::cli {

/// The material outside of all polygons.
inline constexpr std::uint32_t kElsewhere = 1;

/// The polygons and lines as read, which are also breaklines of the mesh.
struct ZonePlan {
  std::vector<run::Zone> zones;
  std::vector<Line> strings;
  std::array<double, 6> affine{};  ///< from samples to the lines' coordinates
};

/// Reads the files and adds their lines, without heights, to the breaklines of a mesh.
Result<ZonePlan> read_zones(const GivenOptions& given, const RasterInfo& raster, int rows,
                            const ProgressCallback& progress, LineConstraints& breaklines,
                            std::vector<std::string>& warnings);

/// The zones of a mesh in the frame.
MeshZones find_zones(const ZonePlan& plan, const Frame& frame, const Mesh& mesh);

}  // namespace scarp::cli
