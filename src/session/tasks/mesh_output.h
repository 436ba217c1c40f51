// From the engine's mesh to what is written: solid, axis, origin and format.
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

/// kUsage if the format cannot hold a mesh in the CRS, with heights in `unit` (both may be empty): what writing would
/// find out, before the work is done.
Result<void> check_crs_of(const OutputFormat& format, const std::string& crs, const std::string& unit);
/// kUsage if the format is in metres by its specification, and x and y are in units of another length (0: not known).
Result<void> check_unit_of_frame(const OutputFormat& format, double metres);

/// Makes a solid of the mesh; kUsage if --base is not below its lowest vertex.
Result<void> close_with_base(Mesh& mesh, double base);
/// Counts the terrain's vertices and triangles, then closes it into a solid where that was asked for.
Result<void> finish_mesh(const SimplifyPlan& plan, SimplifyRun& run);
/// Writes into the mesh who made it, how, and in which frame; `crs_option` is what measure() needs as --crs, or empty.
void add_origin(const std::string& command, const std::string& frame, const std::string& crs,
                const std::string& crs_option, Mesh& mesh);
/// The mesh as it is written: y up, if that was asked for.
void turn_as_planned(const SimplifyPlan& plan, Mesh& mesh);

/// The file's bytes. REQUIRES: not a kDem.
Result<std::vector<std::uint8_t>> encode_as(const OutputFormat& format, const Mesh& mesh, const GlbOptions& glb = {},
                                            const EncodeOptions& options = {});

}  // namespace scarp::cli
