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

/// A file of this run, ready to be written: its bytes, or a raster that was written row by row.
struct ReadyFile {
  std::string path;
  const char* kind;
  std::vector<std::uint8_t> bytes;
  std::shared_ptr<RasterFile> raster = nullptr;

  std::uint64_t size() const { return raster ? raster->size() : bytes.size(); }
};

ReadyFile ready(const ProjectionFile& file);

struct SimplifyRun {
  std::optional<double> asked;  ///< max error in z units
  Simplified simplified;
  std::uint64_t vertices = 0, triangles = 0;              ///< size of the terrain
  std::uint64_t solid_vertices = 0, solid_triangles = 0;  ///< with --base
  std::optional<Print> print;                             ///< with --solid
  std::vector<ProjectionFile> projections;                ///< next to OUTPUT, or each level
  std::vector<std::string> warnings;
  bool was_ended = false;  ///< a run that is cut short, by who waited for it
  double seconds_read = 0, seconds_write = 0, seconds_total = 0;
};

/// The "goal", "passes", "seconds" and "outputs" of the report; "solid", where there is one.
Json describe_goal(const SimplifyPlan& plan, const SimplifyRun& run);
Json describe_passes(const SimplifyRun& run);
Json describe_seconds(const SimplifyRun& run);
Json describe_outputs(const std::vector<ReadyFile>& files);
void add_solid(Json& report, const SimplifyPlan& plan, const SimplifyRun& run);
/// The file of each print tile, or one that holds them all.
std::vector<std::string> print_paths(const SimplifyPlan& plan, const Print& print);

/// Lines that every summary has.
std::string files_lines(const SimplifyPlan& plan, const std::vector<ReadyFile>& files);
std::string solid_line(const SimplifyPlan& plan, const SimplifyRun& run);
std::string seconds_line(const SimplifyRun& run);

/// The lines of --timing: a table of the passes, reading first and writing last.
std::string timing_lines(const SimplifyRun& run);

/// The request, added to the error that was reached: " (asked 0.5)", " (asked 0.5, not reached)"; "" for nothing.
/// `exceptions`: samples for which it does not hold.
std::string describe_asked(const SimplifyRun& run, const char* exceptions = "");
/// The last line of the summary: which goal ended the run. `exact`: text for a mesh without loss; null: there was some.
std::string describe_end(const SimplifyPlan& plan, const SimplifyRun& run, const char* exact);

}  // namespace scarp::cli
