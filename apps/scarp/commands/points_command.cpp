#include "commands/points_command.h"

#include <CLI/CLI.hpp>
#include <utility>
#include <vector>

#include "session/plan/projection_file.h"
#include "session/plan/simplify_plan.h"
#include "session/reports/points_report.h"
#include "session/reports/report.h"
#include "session/reports/simplify_run.h"
#include "session/text/clock.h"
#include "session/text/json_text.h"
#include "session/text/paths.h"
#include "session/text/text.h"
#include "session/work/mesh_output.h"
#include "session/work/points_work.h"
#include "terminal/progress_display.h"
#include "terminal/signals.h"

namespace scarp::cli {
namespace {

Result<ReadyFile> encode(const SimplifyPlan& plan, const PointsArguments& arguments, PointsOutcome& outcome) {
  if (auto completed = complete_mesh(plan, arguments, outcome); !completed)
    return tl::unexpected(std::move(completed.error()));
  turn_as_planned(plan, outcome.simplified.mesh);
  auto bytes = encode_as(plan.format, outcome.simplified.mesh,
                         {.compress = plan.compress, .threads = plan.simplify.run.threads}, plan.doubles);
  if (!bytes) return tl::unexpected(std::move(bytes.error()));
  return ReadyFile{plan.output, plan.format.name(), std::move(*bytes)};
}

}  // namespace

Result<void> run_simplify_points(const CLI::App& command, const SimplifyArguments& given,
                                 const PointsArguments& arguments, const std::string& command_line) {
  const Clock::time_point start = Clock::now();
  ProgressDisplay display(ProgressDisplay::choose(given.json_progress, given.quiet));
  SimplifyPlan plan;
  PointsOutcome outcome;
  if (auto made = make_points_mesh(command, given, arguments, {display.callback()}, plan, outcome); !made) return made;

  const Clock::time_point write_start = Clock::now();
  Result<ReadyFile> file = encode(plan, arguments, outcome);
  if (!file) return tl::unexpected(std::move(file.error()));
  std::vector<ReadyFile> files{std::move(*file)};
  for (const ProjectionFile& projection : outcome.projections) files.push_back(ready(projection));
  if (interrupted()) return fail(ErrorKind::kCancelled, "interrupted");
  std::vector<FileBytes> named;
  for (const ReadyFile& each : files) named.push_back({each.path, each.bytes});
  const Result<void> written = write_files(named, plan.overwrite);
  if (!written) return written;
  outcome.seconds_write = seconds_since(write_start);
  outcome.seconds_total = seconds_since(start);
  if (plan.report) {
    const Json report = make_report(plan, outcome, files, command_line);
    const Result<void> reported = write_report(report, *plan.report, plan.overwrite, plan.output);
    if (!reported) return reported;
  }
  display.finish();

  if (given.quiet) return {};
  print_warnings(outcome.warnings);
  const std::string summary = make_summary(plan, outcome, files);
  if (!is_stdout(plan.output) && !is_stdout(plan.report.value_or(""))) return print_summary(summary);
  print_to_stderr(summary);
  return {};
}

Result<void> run_measure_points(const CLI::App& command, const MeasureArguments& given,
                                const std::string& command_line) {
  const Clock::time_point start = Clock::now();
  ProgressDisplay display(ProgressDisplay::choose(given.json_progress, given.quiet));
  JudgedPoints judged;
  if (auto done = judge_points(command, given, {display.callback()}, judged); !done) return done;
  if (interrupted()) return fail(ErrorKind::kCancelled, "interrupted");
  display.finish();
  judged.seconds_total = seconds_since(start);

  if (!given.quiet) print_warnings(judged.points.warnings);
  if (given.json) {
    const Result<void> printed = print_to_stdout(to_text(make_report(judged, given.mesh, command_line)));
    if (!printed) return printed;
  } else if (!given.quiet) {
    const Result<void> printed = print_to_stdout(make_table(judged, given.mesh));
    if (!printed) return printed;
  }
  if (judged.broken) return fail(ErrorKind::kPromise, fmt::format("{}: {}", given.mesh, *judged.broken));
  return {};
}

}  // namespace scarp::cli
