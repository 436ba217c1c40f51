#include "commands/tile_command.h"

#include <utility>
#include <vector>

#include "session/plan/outputs.h"
#include "session/reports/report.h"
#include "session/reports/tile_report.h"
#include "session/table/option_table.h"
#include "session/tasks/tile_work.h"
#include "session/text/clock.h"
#include "session/text/json_text.h"
#include "session/text/text.h"
#include "session/text/tile_counts.h"
#include "terminal/progress_display.h"

namespace scarp::cli {

TileCommand::TileCommand(CLI::App& program) : command_(add_command(program, kTile)) {
  add_arguments(*command_, OptionId::kInput, tiles_.raster.paths, OptionId::kOutput, output_);
  tiles_.add_to(*command_);
  add_option(*command_, OptionId::kReport, report_);
  add_flag(*command_, OptionId::kOverwrite, overwrite_);
  add_option(*command_, OptionId::kThreads, threads_);
  add_flag(*command_, OptionId::kQuiet, quiet_);
  add_flag(*command_, OptionId::kJsonProgress, json_progress_);
}

Result<void> TileCommand::run(const std::string& command_line) const {
  const Clock::time_point start = Clock::now();
  SCARP_TRY(const int threads, parse_threads(threads_));
  std::vector<PlannedOutput> outputs;
  if (report_) outputs.push_back({"--report", *report_});
  SCARP_RETURN_IF_ERROR(check_outputs(outputs, files_read(*command_), overwrite_));

  ProgressDisplay display(ProgressDisplay::choose(json_progress_, quiet_));
  TileCounts counts;
  display.show_tiles(counts);
  Run run;
  run.threads = threads;
  run.progress = display.callback();
  SCARP_TRY(const MadeTiles& made, make_tiles(tiles_, output_, overwrite_, run, counts));
  display.finish();
  if (!quiet_) print_warnings(made.warnings);
  const TileJob& job = made.opened.job;
  const double seconds = seconds_since(start);
  if (report_) {
    Json json{{"command", command_line}, {"input", tiles_.raster.paths}};
    add_tiles(json, job, output_, made.report);
    json["warnings"] = made.warnings;
    json["seconds"] = seconds;
    SCARP_RETURN_IF_ERROR(write_report(json, *report_, overwrite_, output_));
  }
  if (quiet_) return {};
  return print_summary(make_tile_summary(job, output_, made.report, seconds));
}

}  // namespace scarp::cli
