#include <utility>
#include <vector>

#include "commands/commands.h"
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
namespace {
using enum OptionId;
}

Result<void> run_tile(const GivenOptions& given, const std::string& command_line) {
  const Clock::time_point start = Clock::now();
  SCARP_TRY(const int threads, given.threads());
  std::vector<PlannedOutput> outputs;
  if (given.has(kReport)) outputs.push_back({name_of(kReport), *given[kReport]});
  SCARP_RETURN_IF_ERROR(check_outputs(outputs, given.files_read(), given.has(kOverwrite)));

  ProgressDisplay display(ProgressDisplay::choose(given.has(kJsonProgress), given.has(kQuiet)));
  TileCounts counts;
  display.show_tiles(counts);
  Run run;
  run.threads = threads;
  run.progress = display.callback();
  SCARP_TRY(const MadeTiles& made, make_tiles(given, *given[kOutput], given.has(kOverwrite), run, counts));
  display.finish();
  if (!given.has(kQuiet)) print_warnings(made.warnings);
  const TileJob& job = made.opened.job;
  const double seconds = seconds_since(start);
  if (given[kReport]) {
    Json json{{"command", command_line}, {"input", given.inputs()}};
    if (made.points) json["points"] = describe(*made.points);
    add_tiles(json, job, *given[kOutput], made.report);
    json["warnings"] = made.warnings;
    json["seconds"] = seconds;
    SCARP_RETURN_IF_ERROR(write_report(json, *given[kReport], given.has(kOverwrite), *given[kOutput]));
  }
  if (given.has(kQuiet)) return {};
  const std::string points = made.points ? points_line(*made.points) : "";
  return print_summary(make_tile_summary(job, *given[kOutput], made.report, seconds, points));
}

}  // namespace scarp::cli
