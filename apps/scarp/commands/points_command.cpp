#include <utility>
#include <vector>

#include "commands/commands.h"
#include "session/plan/projection_file.h"
#include "session/plan/simplify_plan.h"
#include "session/reports/points_report.h"
#include "session/reports/report.h"
#include "session/reports/simplify_run.h"
#include "session/tasks/mesh_output.h"
#include "session/tasks/points_dem.h"
#include "session/tasks/points_work.h"
#include "session/text/clock.h"
#include "session/text/json_text.h"
#include "session/text/paths.h"
#include "session/text/text.h"
#include "terminal/progress_display.h"
#include "terminal/signals.h"

namespace scarp::cli {
namespace {

using enum OptionId;

Result<ReadyFile> encode(const SimplifyPlan& plan, PointsOutcome& outcome) {
  SCARP_RETURN_IF_ERROR(complete_mesh(plan, outcome));
  if (plan.format.kind == OutputKind::kDem) {
    SCARP_TRY(auto&& raster, encode_points_dem(plan, outcome));
    return ReadyFile{plan.output, plan.format.name(), std::move(raster)};
  }
  turn_as_planned(plan, outcome.simplified.mesh);
  SCARP_TRY(auto&& bytes, encode_as(plan.format, outcome.simplified.mesh,
                                    {.compress = plan.compress, .threads = plan.simplify.run.threads},
                                    {.double_positions = plan.doubles}));
  return ReadyFile{plan.output, plan.format.name(), std::move(bytes)};
}

}  // namespace

Result<void> run_simplify_points(const GivenOptions& given, const std::string& command_line) {
  const Clock::time_point start = Clock::now();
  ProgressDisplay display(ProgressDisplay::choose(given.has(kJsonProgress), given.has(kQuiet)));
  SimplifyPlan plan;
  PointsOutcome outcome;
  SCARP_RETURN_IF_ERROR(make_points_mesh(given, {display.callback()}, plan, outcome));

  const Clock::time_point write_start = Clock::now();
  SCARP_TRY(ReadyFile file, encode(plan, outcome));
  std::vector<ReadyFile> files{std::move(file)};
  for (const ProjectionFile& projection : outcome.projections) files.push_back(ready(projection));
  if (interrupted()) return fail(ErrorKind::kCancelled, "interrupted");
  std::vector<FileBytes> named;
  for (const ReadyFile& each : files) named.push_back({each.path, each.bytes});
  SCARP_RETURN_IF_ERROR(write_files(named, plan.overwrite));
  outcome.seconds_write = seconds_since(write_start);
  outcome.seconds_total = seconds_since(start);
  if (plan.report) {
    const Json report = make_report(plan, outcome, files, command_line);
    SCARP_RETURN_IF_ERROR(write_report(report, *plan.report, plan.overwrite, plan.output));
  }
  display.finish();

  if (given.has(kQuiet)) return {};
  print_warnings(outcome.warnings);
  const std::string summary = make_summary(plan, outcome, files);
  if (!is_stdout(plan.output) && !is_stdout(plan.report.value_or(""))) return print_summary(summary);
  print_to_stderr(summary);
  return {};
}

Result<void> run_measure_points(const GivenOptions& given, const std::string& command_line) {
  const Clock::time_point start = Clock::now();
  ProgressDisplay display(ProgressDisplay::choose(given.has(kJsonProgress), given.has(kQuiet)));
  JudgedPoints judged;
  SCARP_RETURN_IF_ERROR(judge_points(given, {display.callback()}, judged));
  if (interrupted()) return fail(ErrorKind::kCancelled, "interrupted");
  display.finish();
  judged.seconds_total = seconds_since(start);

  if (!given.has(kQuiet)) print_warnings(judged.points.warnings);
  if (given.has(kJson)) {
    SCARP_RETURN_IF_ERROR(print_to_stdout(to_text(make_report(judged, *given[kMesh], command_line))));
  } else if (!given.has(kQuiet)) {
    SCARP_RETURN_IF_ERROR(print_to_stdout(make_table(judged, *given[kMesh])));
  }
  if (judged.broken) return fail(ErrorKind::kPromise, fmt::format("{}: {}", *given[kMesh], *judged.broken));
  return {};
}

}  // namespace scarp::cli
