#include "commands/tile_command.h"

#include <fmt/format.h>

#include <utility>
#include <vector>

#include "commands/counted_set.h"
#include "options/option_table.h"
#include "reports/report.h"
#include "reports/tile_report.h"
#include "terminal/clock.h"
#include "terminal/progress_display.h"
#include "terminal/text.h"

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
  const Result<int> threads = parse_threads(threads_);
  if (!threads) return tl::unexpected(threads.error());
  std::vector<PlannedOutput> outputs;
  if (report_) outputs.push_back({"--report", *report_});
  if (auto checked = check_outputs(outputs, files_read(*command_), overwrite_); !checked) return checked;

  ProgressDisplay display(ProgressDisplay::choose(json_progress_, quiet_));
  const Result<OpenedJob> opened = tiles_.open(display.callback());
  if (!opened) return tl::unexpected(opened.error());
  const TileJob& job = opened->job;
  auto container = create_tile_set(output_, job.format, overwrite_);
  if (!container) return tl::unexpected(container.error());
  TileCounts counts;
  display.show_tiles(counts);
  CountedSet set(std::move(*container), counts);
  const std::unique_ptr<TileSetSink> sink = make_tile_sink(job.format, set, job.plan);
  Run run;
  run.threads = *threads;
  run.progress = display.callback();
  Result<PyramidReport> report = make_pyramid(job.plan, opened->raster->nodes(), *sink, run);
  if (!report) return tl::unexpected(report.error());
  if (auto same = check_rasters(job); !same) return same;
  if (auto checked = check_heights(job, *report); !checked) return checked;
  if (auto put = sink->put_files(*report, job.facts); !put) return put;
  if (auto finished = set.finish(); !finished) return finished;
  display.finish();
  if (!quiet_) {
    print_warnings(warnings_of_raster(*opened->raster));
    print_warnings(warnings_of_levels(job.plan, *report));
  }
  const double seconds = seconds_since(start);
  if (report_) {
    const Json json{{"command", command_line},
                    {"input", tiles_.raster.paths},
                    {"output", output_},
                    {"vertical", job.facts.heights_above},
                    {"ellipsoid", {job.plan.ellipsoid.semi_major, semi_minor(job.plan.ellipsoid)}},
                    {"max_zoom", job.plan.max_zoom()},
                    {"levels", describe_levels(job.plan, *report)},
                    {"seconds", seconds}};
    if (auto written = write_report(json, *report_, overwrite_, output_); !written) return written;
  }
  if (quiet_) return {};
  return print_summary(make_tile_summary(job, output_, *report, seconds));
}

}  // namespace scarp::cli
