#include "commands/tile_finish_command.h"

#include <fmt/format.h>

#include <utility>
#include <vector>

#include "session/plan/outputs.h"
#include "session/plan/tile_parts.h"
#include "session/reports/report.h"
#include "session/reports/tile_report.h"
#include "session/table/option_table.h"
#include "session/tasks/counted_set.h"
#include "session/tasks/tile_work.h"
#include "session/text/clock.h"
#include "session/text/json_text.h"
#include "session/text/text.h"
#include "session/text/tile_counts.h"
#include "terminal/progress_display.h"

namespace scarp::cli {

TileFinishCommand::TileFinishCommand(CLI::App& program) : command_(add_command(program, kTileFinish)) {
  add_option(*command_, OptionId::kPlan, plan_);
  add_option(*command_, OptionId::kOutput, output_);
  add_option(*command_, OptionId::kParts, parts_);
  add_option(*command_, OptionId::kReport, report_);
  add_flag(*command_, OptionId::kOverwrite, overwrite_);
  add_option(*command_, OptionId::kThreads, threads_);
  add_flag(*command_, OptionId::kQuiet, quiet_);
  add_flag(*command_, OptionId::kJsonProgress, json_progress_);
}

Result<void> TileFinishCommand::run(const std::string& command_line) const {
  const Clock::time_point start = Clock::now();
  Run run;
  SCARP_TRY(run.threads, parse_threads(threads_));
  std::vector<PlannedOutput> outputs;
  if (report_) outputs.push_back({"--report", *report_});
  SCARP_RETURN_IF_ERROR(check_outputs(outputs, files_read(*command_), overwrite_));
  SCARP_TRY(const TileJob& job, read_tile_job(plan_));
  SCARP_RETURN_IF_ERROR(check_container(job, output_));
  SCARP_TRY(auto&& container, create_tile_set(output_, job.format, overwrite_));
  TileCounts counts;
  CountedSet set(std::move(container), counts);
  ProgressDisplay display(ProgressDisplay::choose(json_progress_, quiet_));
  display.show_tiles(counts);
  run.progress = display.callback();
  PartsCost cost;
  SCARP_TRY(const PyramidReport& report, finish_parts(job, parts_folder(plan_, parts_, job), set, run, &cost));
  display.finish();
  if (!quiet_) {
    print_warnings(warnings_of_levels(job.plan, report));
    if (const auto changed = find_changed(job)) print_warnings({*changed + ": the set shows it as it was then"});
  }
  const double seconds = seconds_since(start);
  if (report_) {
    Json json{{"command", command_line}, {"plan", plan_}};
    add_tiles(json, job, output_, report);
    json["model"] = compare_model(job, report, cost);
    json["seconds"] = seconds;
    SCARP_RETURN_IF_ERROR(write_report(json, *report_, overwrite_, output_));
  }
  if (quiet_) return {};
  return print_summary(make_tile_summary(job, output_, report, seconds) + summarize_model(job, report, cost));
}

}  // namespace scarp::cli
