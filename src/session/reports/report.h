// Reports as JSON. simplify, measure and info use common names, listed in docs/cli/reports.md.
#pragma once

#include <optional>
#include <string>
#include <vector>

#include "measure/judge.h"
#include "scarp/height_field.h"
#include "scarp/io.h"
#include "scarp/measure.h"
#include "scarp/simplify.h"
#include "session/text/json.h"

namespace scarp::cli {

/// Text after a height: " m", " m (ft in the file)", or nothing.
std::string heights_unit(const RasterInfo& info);
/// The "input" object: the raster as it was read.
Json describe_input(const OwnedHeightField& field, const RasterInfo& as_read, int band);
/// The "frame" object: the meaning of the mesh's x and y, and the map back to the raster's coordinates.
Json describe_frame(const Frame& frame, const RasterInfo& info, int rows);
/// Adds the mesh's place in the source's coordinates; null if unknown.
void add_place(Json& json, const std::optional<PlaceInSource>& place);
/// The value of "stopped_by": the option of the goal that ended the run.
const char* stop_name(StopReason stop);
/// Triangles of the full grid: 2·(cols − 1)·(rows − 1).
std::uint64_t full_grid_triangles(const HeightField& field);
/// Adds max_error … p999, and sample_rounding unless it is 0.
void add_errors(Json& report, const Measurement& measured, double sample_rounding);
/// Adds samples … void_cells_covered and the "topology" object.
void add_coverage(Json& report, const Measurement& measured);
/// Adds errors and coverage.
void add_measurement(Json& report, const Measurement& measured, double sample_rounding);
/// Adds bounded_max_error and bounded_max_error_at: [-1, -1] if all errors are 0.
void add_bounded(Json& report, const judge::LargestError& bounded);
/// The "channels" list: each channel's name, scale, max_error … p999 and samples, in its own units.
Json describe_channels(const std::vector<std::string>& names, const std::vector<double>& scales,
                       const std::vector<Measurement>& measured);
/// Writes the report of a mesh that is already under its final name. If writing fails, the error mentions the mesh.
Result<void> write_report(const Json& report, const std::string& path, bool overwrite, const std::string& mesh);

}  // namespace scarp::cli
