#include <fmt/format.h>

#include "commands/commands.h"
#include "session/options/points_options.h"
#include "session/reports/measure_report.h"
#include "session/reports/volume_report.h"
#include "session/table/option_table.h"
#include "session/tasks/measure_work.h"
#include "session/tasks/volume_work.h"
#include "session/text/clock.h"
#include "session/text/json_text.h"
#include "session/text/paths.h"
#include "session/text/text.h"
#include "terminal/progress_display.h"
#include "terminal/signals.h"

namespace scarp::cli {
namespace {
using enum OptionId;

Result<void> run_measure_volume(const GivenOptions& given, const std::string& command_line) {
  ComparedSurfaces compared;
  ProgressDisplay display(ProgressDisplay::choose(given.has(kJsonProgress), given.has(kQuiet)));
  SCARP_RETURN_IF_ERROR(compare_surfaces(given, {display.callback()}, compared));
  display.finish();
  if (given.has(kJson)) return print_to_stdout(to_text(make_report(compared, command_line)));
  if (given.has(kQuiet)) return {};
  print_warnings(compared.warnings);
  return print_to_stdout(make_table(compared));
}

}  // namespace

Result<void> run_measure(const GivenOptions& given, const std::string& command_line) {
  if (given.has(kVolume)) return run_measure_volume(given, command_line);
  const Clock::time_point start = Clock::now();
  SCARP_RETURN_IF_ERROR(check_kind_of_input(given));
  if (are_points_meant(given)) return run_measure_points(given, command_line);
  Judged judged;
  StreamedErrors errors;
  ProgressDisplay display(ProgressDisplay::choose(given.has(kJsonProgress), given.has(kQuiet)));
  SCARP_RETURN_IF_ERROR(judge_inputs(given, {display.callback()}, judged, errors));
  if (interrupted()) return fail(ErrorKind::kCancelled, "interrupted");
  SCARP_RETURN_IF_ERROR(write_error_files(given, judged, errors));
  display.finish();
  judged.seconds_total = seconds_since(start);

  if (!given.has(kQuiet)) print_warnings(judged.warnings);
  if (given.has(kJson)) {
    SCARP_RETURN_IF_ERROR(print_to_stdout(to_text(make_report(judged, *given[kMesh], given, command_line))));
  } else if (!given.has(kQuiet)) {
    const std::string table = make_table(judged, given.input(), *given[kMesh]);
    if (is_stdout(given[kMap].value_or("")) || is_stdout(given[kErrorRaster].value_or(""))) {
      print_to_stderr(table);
    } else {
      SCARP_RETURN_IF_ERROR(print_to_stdout(table));
    }
  }
  if (judged.broken) return fail(ErrorKind::kPromise, fmt::format("{}: {}", *given[kMesh], *judged.broken));
  return {};
}

}  // namespace scarp::cli
