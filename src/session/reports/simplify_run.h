// Results and messages of a run of `scarp simplify`, on a raster or on points.
#pragma once

#include <cstdint>
#include <memory>
#include <optional>
#include <string>
#include <vector>

#include "scarp/io.h"
#include "scarp/simplify.h"
#include "session/plan/projection_file.h"
#include "session/plan/simplify_plan.h"
#include "session/text/json.h"

namespace scarp::cli {

/// A file of this run that is ready to be written: its bytes, or a raster written row by row.
struct ReadyFile {
  std::string path;
  const char* kind;
  std::vector<std::uint8_t> bytes;
  std::shared_ptr<RasterFile> raster = nullptr;

  std::uint64_t size() const { return raster ? raster->size() : bytes.size(); }
};

ReadyFile ready(const ProjectionFile& file);

/// A level of detail other than the finest.
struct Level {
  std::optional<double> asked;
  Simplified simplified;
};

struct SimplifyRun {
  std::optional<double> asked;  ///< max error in z units
  Simplified simplified;
  std::uint64_t vertices = 0, triangles = 0;              ///< size of the terrain
  std::uint64_t solid_vertices = 0, solid_triangles = 0;  ///< size with a base
  std::vector<Level> coarser;                             ///< with --lods
  std::optional<Print> print;                             ///< with --solid
  std::vector<ProjectionFile> projections;                ///< next to OUTPUT or each level
  std::vector<std::string> warnings;
  bool was_ended = false;  ///< a waiting caller ended the run early
  double seconds_read = 0, seconds_write = 0, seconds_total = 0;
};

/// Parts of the report: "goal", "passes", "seconds" and "outputs"; "solid", if any.
Json describe_goal(const SimplifyPlan& plan, const SimplifyRun& run);
Json describe_passes(const SimplifyRun& run);
Json describe_seconds(const SimplifyRun& run);
Json describe_outputs(const std::vector<ReadyFile>& files);
void add_solid(Json& report, const SimplifyPlan& plan, const SimplifyRun& run);
/// One path for each print tile, or one for all.
std::vector<std::string> print_paths(const SimplifyPlan& plan, const Print& print);

/// Lines common to all summaries.
std::string files_lines(const SimplifyPlan& plan, const std::vector<ReadyFile>& files);
std::string solid_line(const SimplifyPlan& plan, const SimplifyRun& run);
std::string seconds_line(const SimplifyRun& run);

/// The lines of --timing: a table of passes, from reading to writing.
std::string timing_lines(const SimplifyRun& run);

/// Text after the reached error: " (asked 0.5)", " (asked 0.5, not reached)", or "" without a request. `exceptions`:
/// samples for which the request does not hold.
std::string describe_asked(const SimplifyRun& run, const char* exceptions = "");
/// The last line of the summary: the goal that ended the run. `exact`: text for a mesh without loss; null if there was
/// loss.
std::string describe_end(const SimplifyPlan& plan, const SimplifyRun& run, const char* exact);

}  // namespace scarp::cli
