// Materials by polygon and node strings along lines, for 2DM.
#pragma once

#include <string>
#include <vector>

#include "scarp/features.h"
#include "scarp/height_field.h"
#include "scarp/zones.h"
#include "session/options/output_kind.h"
#include "session/options/values.h"
#include "session/text/json.h"

namespace CLI {
class App;
}

namespace scarp::cli {

/// Polygons and lines as they were read, which are also breaklines of the mesh.
struct ZonePlan {
  std::vector<Zone> zones;
  std::vector<Line> strings;
  std::array<double, 6> affine{};  ///< from samples to their coordinates
};

struct ZoneArguments {
  Given materials, field;
  std::vector<std::string> strings;

  void add_to(CLI::App& command);
  /// Refuses options that need others, and outputs that have no place for it.
  Result<void> check(const OutputFormat& format) const;
  /// The option that asks for lines in the mesh; null if there is none.
  const char* find_lines() const;
  std::string canonical() const;
  /// Reads the files, and adds their lines to the breaklines of a mesh, without heights.
  Result<ZonePlan> read(const RasterInfo& raster, int rows, const ProgressCallback& progress,
                        LineConstraints& breaklines, std::vector<std::string>& warnings) const;
};

/// Of a mesh in the frame.
MeshZones find_zones(const ZonePlan& plan, const Frame& frame, const Mesh& mesh);

/// For a report: "materials" and "node_strings", null where they were not asked for.
void add_zones(Json& report, const ZoneArguments& given, const MeshZones& zones);
/// Of the summary.
std::string zones_lines(const ZoneArguments& given, const MeshZones& zones);

}  // namespace scarp::cli
