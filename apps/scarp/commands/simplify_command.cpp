#include <utility>
#include <vector>

#include "commands/commands.h"
#include "session/options/points_options.h"
#include "session/plan/simplify_plan.h"
#include "session/reports/report.h"
#include "session/reports/simplify_outcome.h"
#include "session/reports/simplify_report.h"
#include "session/reports/simplify_run.h"
#include "session/table/option_table.h"
#include "session/tasks/runner.h"
#include "session/tasks/simplify_files.h"
#include "session/tasks/simplify_work.h"
#include "session/text/clock.h"
#include "session/text/json_text.h"
#include "session/text/paths.h"
#include "session/text/text.h"
#include "terminal/progress_display.h"
#include "terminal/signals.h"

namespace scarp::cli {
namespace {
using enum OptionId;
}

Result<void> run_simplify(const GivenOptions& given, const std::string& command_line) {
  const Clock::time_point start = Clock::now();
  SCARP_RETURN_IF_ERROR(check_kind_of_input(given));
  if (are_points_meant(given)) return run_simplify_points(given, command_line);
  SCARP_TRY(SimplifyPlan plan, plan_simplify(given, given.files_read()));

  Outcome outcome;
  ProgressDisplay display(ProgressDisplay::choose(given.has(kJsonProgress), given.has(kQuiet)));
  const Runner runner{display.callback(), content_with_interrupt, [&] { display.let_interrupt_finish("fit"); }};
  SCARP_RETURN_IF_ERROR(make_mesh(given, plan, runner, outcome));

  const Clock::time_point write_start = Clock::now();
  const bool go_on = display.callback()(
      {"write", 0, outcome.simplified.mesh.vertex_count(), outcome.simplified.measurement.max_error});
  if (!go_on) return fail(ErrorKind::kCancelled, "interrupted");
  SCARP_TRY(const std::vector<ReadyFile>& files, encode_files(plan, display.callback(), outcome));
  if (interrupted()) return fail(ErrorKind::kCancelled, "interrupted");

  // From here on, all files get their names, or none does.
  std::vector<FileBytes> ready;
  for (const ReadyFile& file : files) ready.push_back({file.path, file.bytes, file.raster.get()});
  SCARP_RETURN_IF_ERROR(write_files(ready, plan.overwrite));
  outcome.seconds_write = seconds_since(write_start);
  outcome.seconds_total = seconds_since(start);
  if (plan.report) {
    const Json report = make_report(plan, outcome, files, command_line);
    SCARP_RETURN_IF_ERROR(write_report(report, *plan.report, plan.overwrite, plan.output));
  }
  display.finish();

  if (given.has(kQuiet)) return {};
  outcome.was_ended = outcome.simplified.is_cut_short && content_with_interrupt();
  print_warnings(outcome.warnings);
  const std::string summary = make_summary(plan, outcome, files) + (given.has(kTiming) ? timing_lines(outcome) : "");
  bool stdout_is_data = is_stdout(plan.report.value_or(""));
  for (const ReadyFile& file : files) stdout_is_data = stdout_is_data || is_stdout(file.path);
  if (stdout_is_data) {
    print_to_stderr(summary);
    return {};
  }
  return print_summary(summary);
}

}  // namespace scarp::cli
