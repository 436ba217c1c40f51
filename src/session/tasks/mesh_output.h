// Turns the engine's mesh into the written one: solid, axis, origin and format.
#pragma once

#include <cstdint>
#include <string>
#include <vector>

#include "scarp/io.h"
#include "scarp/mesh.h"
#include "session/options/output_kind.h"
#include "session/plan/simplify_plan.h"
#include "session/reports/simplify_run.h"

namespace scarp::cli {

/// kUsage if the format cannot hold a mesh in the CRS with heights in `unit` (both may be empty). Checks early what
/// writing would reject.
Result<void> check_crs_of(const OutputFormat& format, const std::string& crs, const std::string& unit);
/// kUsage if the format requires metres but x and y have another unit of length. `metres`: its length, 0 if unknown.
Result<void> check_unit_of_frame(const OutputFormat& format, double metres);

/// Makes a solid of the mesh; kUsage if --base is not below its lowest vertex.
Result<void> close_with_base(Mesh& mesh, double base);
/// Counts the terrain's vertices and triangles, then closes the terrain into a solid on request.
Result<void> finish_mesh(const SimplifyPlan& plan, SimplifyRun& run);
/// Records in the mesh its program, command and frame. `crs_option`: the --crs that measure() needs, or empty.
void add_origin(const std::string& command, const std::string& frame, const std::string& crs,
                const std::string& crs_option, Mesh& mesh);
/// Turns the mesh y up if planned.
void turn_as_planned(const SimplifyPlan& plan, Mesh& mesh);

/// Adds the draped image, if planned.
Result<void> add_drape(const SimplifyPlan& plan, const Picture& image, GlbOptions& glb);

/// Encodes the file. REQUIRES: not a kDem.
Result<std::vector<std::uint8_t>> encode_as(const OutputFormat& format, const Mesh& mesh, const GlbOptions& glb = {},
                                            const EncodeOptions& options = {});

/// Stores a print in the run. Its scale, and with it the requested error, may differ from the estimate.
void take_print(const SimplifyPlan& plan, Print print, SimplifyRun& run);
/// Rewrites an error of simplify_for_print() in terms of the options.
Error name_print(Error error);
/// The print tiles, with the terrain's metadata. REQUIRES: a print.
std::vector<Mesh> named_solids(const SimplifyPlan& plan, const SimplifyRun& run);
/// Adds a file for each print tile; the first replaces OUTPUT's file.
Result<void> encode_print_tiles(const SimplifyPlan& plan, const SimplifyRun& run, std::vector<ReadyFile>& files);

}  // namespace scarp::cli
