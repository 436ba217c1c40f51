#include "commands/measure_command.h"

#include <fmt/format.h>

#include "commands/points_command.h"
#include "session/reports/measure_report.h"
#include "session/table/option_table.h"
#include "session/tasks/measure_work.h"
#include "session/text/clock.h"
#include "session/text/json_text.h"
#include "session/text/paths.h"
#include "session/text/text.h"
#include "terminal/progress_display.h"
#include "terminal/signals.h"

namespace scarp::cli {

MeasureCommand::MeasureCommand(CLI::App& program) : command_(add_command(program, kMeasure)) {
  given_.add_to(*command_);
}

Result<void> MeasureCommand::run(const std::string& command_line) const {
  const Clock::time_point start = Clock::now();
  SCARP_RETURN_IF_ERROR(given_.points.check_single(given_.raster.paths));
  if (given_.are_points()) return run_measure_points(*command_, given_, command_line);
  SCARP_RETURN_IF_ERROR(given_.points.check_unused(given_.raster.path()));
  Judged judged;
  StreamedErrors errors;
  ProgressDisplay display(ProgressDisplay::choose(given_.json_progress, given_.quiet));
  SCARP_RETURN_IF_ERROR(judge_inputs(given_, files_read(*command_), {display.callback()}, judged, errors));
  if (interrupted()) return fail(ErrorKind::kCancelled, "interrupted");
  SCARP_RETURN_IF_ERROR(write_error_files(given_, judged, errors));
  display.finish();
  judged.seconds_total = seconds_since(start);

  if (!given_.quiet) print_warnings(judged.warnings);
  if (given_.json) {
    SCARP_RETURN_IF_ERROR(print_to_stdout(to_text(make_report(judged, given_.mesh, given_.cut, command_line))));
  } else if (!given_.quiet) {
    const std::string table = make_table(judged, given_.raster.path(), given_.mesh);
    if (is_stdout(given_.map.value_or("")) || is_stdout(given_.error_raster.value_or(""))) {
      print_to_stderr(table);
    } else {
      SCARP_RETURN_IF_ERROR(print_to_stdout(table));
    }
  }
  if (judged.broken) return fail(ErrorKind::kPromise, fmt::format("{}: {}", given_.mesh, *judged.broken));
  return {};
}

}  // namespace scarp::cli
