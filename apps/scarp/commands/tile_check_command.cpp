#include "commands/tile_check_command.h"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <optional>

#include "session/reports/tile_check_report.h"
#include "session/table/option_table.h"
#include "session/text/clock.h"
#include "session/text/json_text.h"
#include "session/text/paths.h"
#include "session/text/text.h"
#include "terminal/progress_display.h"

namespace scarp::cli {
namespace {

/// Limit for the source: one that is larger stays in its file.
constexpr std::uint64_t kSourceBytes = std::uint64_t{1} << 30;

/// Nothing for a raster without a place on the globe. Borrows the plane.
std::optional<CheckedPlace> place_of(const RasterOnPlane& plane, const LocalRaster& raster) {
  if (!plane.samples) return {};
  const RasterOnGlobe& globe = *plane.samples;
  return CheckedPlace{[&globe, rows = raster.rows](double east, double north) {
                        const std::array<double, 6>& a = globe.place.affine;
                        const double row = rows - 1 - north;
                        std::array<double, 3> at{a[0] + a[1] * east + a[2] * row, a[3] + a[4] * east + a[5] * row, 0};
                        globe.to_degrees->apply({&at[0], 1}, {&at[1], 1});
                        if (globe.zero != nullptr) globe.zero->find({&at[0], 1}, {&at[1], 1}, {&at[2], 1});
                        return at;
                      },
                      globe.ellipsoid};
}

}  // namespace

TileCheckCommand::TileCheckCommand(CLI::App& program) : command_(add_command(program, kTileCheck)) {
  add_option(*command_, OptionId::kInput, set_);
  add_option(*command_, OptionId::kSource, source_);
  tiles_.add_nodes_to(*command_);
  add_option(*command_, OptionId::kGrid, tiles_.grid);
  add_flag(*command_, OptionId::kJson, json_);
  add_option(*command_, OptionId::kThreads, threads_);
  add_flag(*command_, OptionId::kQuiet, quiet_);
  add_flag(*command_, OptionId::kJsonProgress, json_progress_);
}

Result<void> TileCheckCommand::check_unused() const {
  if (source_ && lower_extension(*source_) != ".json") return {};
  for (const CLI::Option* option : command_->get_options()) {
    const std::string name = option->get_name();
    constexpr std::array kFree{"--source", "--grid", "--json", "--num-threads", "--quiet", "--json-progress"};
    if (option->count() == 0 || name.rfind("--", 0) != 0 || std::ranges::count(kFree, name) > 0) continue;
    return fail(ErrorKind::kUsage, source_ ? fmt::format("{} is for rasters: {} has decided it", name, *source_)
                                           : fmt::format("{} is for the raster of --source: give that too", name));
  }
  return {};
}

Result<OpenedJob> TileCheckCommand::open_source(const TileSetReader& set, const TileGrid& of_set,
                                                const ProgressCallback& progress, int threads) const {
  if (lower_extension(*source_) == ".json") {
    SCARP_TRY(auto&& job, read_tile_job(*source_));
    return open_job(std::move(job), kSourceBytes, threads);
  }
  TileArguments tiles = tiles_;
  tiles.raster.paths = {*source_};
  if (!tiles.grid) tiles.grid = std::string(of_set.name());
  if (of_set.is_flat()) tiles.format = "3dtiles";
  const std::string said = find_vertical(set);
  if (!said.empty() && !tiles.vertical && !tiles.geoid) tiles.vertical = said;
  return open_tiles(tiles, progress, kSourceBytes);
}

Result<void> TileCheckCommand::run(const std::string& command_line) const {
  const Clock::time_point start = Clock::now();
  TileCheckOptions options;
  SCARP_TRY(const int threads, parse_threads(threads_));
  options.run.threads = threads;
  SCARP_RETURN_IF_ERROR(check_unused());
  SCARP_TRY(const auto& set, open_tile_set(set_));
  const TileGrid of_set = find_grid(*set);
  if (tiles_.grid) {
    SCARP_TRY(const GridKind kind, parse_grid(*tiles_.grid, false));
    if (of_set.is_flat())
      return fail(ErrorKind::kUsage, "--grid is for sets that do not name theirs, and those of a local grid do");
    options.grid = TileGrid{.kind = kind};
  }
  ProgressDisplay display(ProgressDisplay::choose(json_progress_, quiet_));
  OpenedJob opened;
  if (source_) {
    SCARP_TRY(opened, open_source(*set, of_set, display.callback(), threads));
    const PyramidPlan& plan = opened.job.plan;
    const LocalRaster &mine = plan.grid.local, &theirs = of_set.local;
    if (mine.cols != theirs.cols || mine.rows != theirs.rows || mine.cell_x != theirs.cell_x ||
        mine.cell_y != theirs.cell_y)
      return fail(ErrorKind::kUsage, fmt::format("the local grid of {} is that of another raster than {}: their rows, "
                                                 "columns or cells differ",
                                                 set_, *source_));
    options.nodes.source = &opened.raster->nodes();
    options.nodes.covered = plan.covered;
    options.ellipsoid = plan.ellipsoid;
    if (opened.raster->plane()) options.nodes.place = place_of(*opened.raster->plane(), theirs);
    const bool is_plan = lower_extension(*source_) == ".json";
    if (is_plan || tiles_.cells) options.nodes.cells = plan.cells;
    if (is_plan || tiles_.background) options.nodes.background = plan.background;
  }
  options.run.progress = display.callback();
  SCARP_TRY(const TileCheck& check, check_tiles(*set, options));
  display.finish();
  if (json_) {
    Json report{{"command", command_line}, {"set", set_}};
    add_tile_check(report, check);
    report["seconds"] = seconds_since(start);
    SCARP_RETURN_IF_ERROR(print_to_stdout(to_text(report)));
  } else if (!quiet_) {
    SCARP_RETURN_IF_ERROR(print_to_stdout(make_check_summary(set_, check, seconds_since(start))));
  }
  if (check.holds()) return {};
  return fail(ErrorKind::kPromise, describe_faults(set_, check));
}

}  // namespace scarp::cli
