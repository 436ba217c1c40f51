#include "commands/measure_command.h"

#include <fmt/format.h>

#include "reports/report.h"
#include "terminal/clock.h"
#include "terminal/progress_display.h"
#include "terminal/signals.h"
#include "terminal/text.h"

namespace scarp::cli {

Result<void> MeasureCommand::run(const std::string& command_line) const {
  const Clock::time_point start = Clock::now();
  SCARP_RETURN_IF_ERROR(points_.check_single(raster_.paths));
  if (are_points()) return run_measure_points(*command_, points_arguments(), points_, command_line);
  SCARP_RETURN_IF_ERROR(points_.check_unused(raster_.path()));
  Judged judged;
  StreamedErrors errors;
  ProgressDisplay display(ProgressDisplay::choose(json_progress_, quiet_));
  SCARP_RETURN_IF_ERROR(judge_inputs({display.callback()}, judged, errors));
  if (interrupted()) return fail(ErrorKind::kCancelled, "interrupted");
  SCARP_RETURN_IF_ERROR(write_files(judged, errors));
  display.finish();
  judged.seconds_total = seconds_since(start);

  if (!quiet_) print_warnings(judged.warnings);
  if (json_) {
    SCARP_RETURN_IF_ERROR(print_to_stdout(to_text(make_report(judged, mesh_, cut_, command_line))));
  } else if (!quiet_) {
    const std::string table = make_table(judged, raster_.path(), mesh_);
    if (is_stdout(map_.value_or("")) || is_stdout(error_raster_.value_or(""))) {
      print_to_stderr(table);
    } else {
      SCARP_RETURN_IF_ERROR(print_to_stdout(table));
    }
  }
  if (judged.broken) return fail(ErrorKind::kPromise, fmt::format("{}: {}", mesh_, *judged.broken));
  return {};
}

}  // namespace scarp::cli
