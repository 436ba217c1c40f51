#include <utility>
#include <vector>

#include "commands/commands.h"
#include "session/plan/simplify_plan.h"
#include "session/reports/points_report.h"
#include "session/reports/report.h"
#include "session/reports/simplify_run.h"
#include "session/tasks/points_files.h"
#include "session/tasks/points_work.h"
#include "session/text/clock.h"
#include "session/text/json_text.h"
#include "session/text/paths.h"
#include "session/text/text.h"
#include "terminal/progress_display.h"
#include "terminal/signals.h"

namespace scarp::cli {

using enum OptionId;

Result<void> run_simplify_points(const GivenOptions& given, const std::string& command_line) {
  const Clock::time_point start = Clock::now();
  ProgressDisplay display(ProgressDisplay::choose(given.has(kJsonProgress), given.has(kQuiet)));
  SimplifyPlan plan;
  PointsOutcome outcome;
  SCARP_RETURN_IF_ERROR(make_points_mesh(given, {display.callback()}, plan, outcome));

  const Clock::time_point write_start = Clock::now();
  SCARP_TRY(const std::vector<ReadyFile>& files, encode_files(plan, {display.callback()}, outcome));
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
  const std::string summary = make_summary(plan, outcome, files) + (given.has(kTiming) ? timing_lines(outcome) : "");
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
  if (judged.errors) {
    const FileBytes errors[] = {{judged.errors->path, judged.errors->bytes}};
    SCARP_RETURN_IF_ERROR(write_files(errors, given.has(kOverwrite)));
  }
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
