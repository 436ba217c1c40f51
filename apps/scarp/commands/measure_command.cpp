#include "commands/measure_command.h"

#include <fmt/format.h>

#include "session/reports/report.h"
#include "session/text/clock.h"
#include "session/text/text.h"
#include "terminal/progress_display.h"
#include "terminal/signals.h"

namespace scarp::cli {

Result<void> MeasureCommand::run(const std::string& command_line) const {
  const Clock::time_point start = Clock::now();
  if (auto single = points_.check_single(raster_.paths); !single) return single;
  if (are_points()) return run_measure_points(*command_, points_arguments(), points_, command_line);
  if (auto unused = points_.check_unused(raster_.path()); !unused) return unused;
  Judged judged;
  StreamedErrors errors;
  ProgressDisplay display(ProgressDisplay::choose(json_progress_, quiet_));
  if (auto done = judge_inputs({display.callback()}, judged, errors); !done) return done;
  if (interrupted()) return fail(ErrorKind::kCancelled, "interrupted");
  const Result<void> files = write_files(judged, errors);
  if (!files) return files;
  display.finish();
  judged.seconds_total = seconds_since(start);

  if (!quiet_) print_warnings(judged.warnings);
  if (json_) {
    const Result<void> printed = print_to_stdout(to_text(make_report(judged, mesh_, cut_, command_line)));
    if (!printed) return printed;
  } else if (!quiet_) {
    const std::string table = make_table(judged, raster_.path(), mesh_);
    if (is_stdout(map_.value_or("")) || is_stdout(error_raster_.value_or(""))) {
      print_to_stderr(table);
    } else {
      const Result<void> printed = print_to_stdout(table);
      if (!printed) return printed;
    }
  }
  if (judged.broken) return fail(ErrorKind::kPromise, fmt::format("{}: {}", mesh_, *judged.broken));
  return {};
}

}  // namespace scarp::cli
