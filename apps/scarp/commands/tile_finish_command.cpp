#include <fmt/format.h>

#include <utility>
#include <vector>

#include "commands/commands.h"
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
namespace {
using enum OptionId;
}

Result<void> run_tile_finish(const GivenOptions& given, const std::string& command_line) {
  const Clock::time_point start = Clock::now();
  Run run;
  SCARP_TRY(run.threads, given.threads());
  std::vector<PlannedOutput> outputs;
  if (given.has(kReport)) outputs.push_back({name_of(kReport), *given[kReport]});
  SCARP_RETURN_IF_ERROR(check_outputs(outputs, given.files_read(), given.has(kOverwrite)));
  SCARP_TRY(const TileJob& job, read_tile_job(*given[kPlan]));
  SCARP_RETURN_IF_ERROR(check_container(job, *given[kOutput]));
  SCARP_TRY(auto&& container, create_tile_set(*given[kOutput], job.format, given.has(kOverwrite)));
  TileCounts counts;
  CountedSet set(std::move(container), counts);
  ProgressDisplay display(ProgressDisplay::choose(given.has(kJsonProgress), given.has(kQuiet)));
  display.show_tiles(counts);
  run.progress = display.callback();
  PartsCost cost;
  SCARP_TRY(const PyramidReport& report,
            finish_parts(job, parts_folder(*given[kPlan], given[kParts], job), set, run, &cost));
  display.finish();
  if (!given.has(kQuiet)) {
    print_warnings(warnings_of_levels(job.plan, report));
    if (const auto changed = find_changed(job)) print_warnings({*changed + ": the set shows it as it was then"});
  }
  const double seconds = seconds_since(start);
  if (given[kReport]) {
    Json json{{"command", command_line}, {"plan", *given[kPlan]}};
    add_tiles(json, job, *given[kOutput], report);
    json["model"] = compare_model(job, report, cost);
    json["seconds"] = seconds;
    SCARP_RETURN_IF_ERROR(write_report(json, *given[kReport], given.has(kOverwrite), *given[kOutput]));
  }
  if (given.has(kQuiet)) return {};
  return print_summary(make_tile_summary(job, *given[kOutput], report, seconds) + summarize_model(job, report, cost));
}

}  // namespace scarp::cli
