#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <optional>

#include "commands/commands.h"
#include "scarp/tile_set.h"
#include "session/options/tile_options.h"
#include "session/plan/tile_plan.h"
#include "session/reports/tile_check_report.h"
#include "session/table/option_table.h"
#include "session/text/clock.h"
#include "session/text/json_text.h"
#include "session/text/paths.h"
#include "session/text/text.h"
#include "terminal/progress_display.h"

namespace scarp::cli {
namespace {

using enum OptionId;

/// Memory for the source: a larger raster stays in its file.
constexpr std::uint64_t kSourceBytes = std::uint64_t{1} << 30;

/// The place of the plane on the globe, if it has one. Borrows `plane`.
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

/// Fails for raster options without a raster, or with a plan that determines them.
Result<void> check_unused(const GivenOptions& given) {
  if (given[kSource] && lower_extension(*given[kSource]) != ".json") return {};
  constexpr std::array kFree{kSource, kGrid, kJson, kThreads, kQuiet, kJsonProgress};
  for (const OptionRow* row : given.given()) {
    if (std::ranges::count(kFree, row->id) > 0) continue;
    return fail(ErrorKind::kUsage,
                given.has(kSource) ? fmt::format("{} is for rasters: {} has decided it", row->title(), *given[kSource])
                                   : fmt::format("{} is for the raster of {}: give that too", row->title(), kSource));
  }
  return {};
}

Result<OpenedJob> open_source(const GivenOptions& given, const TileSetReader& set, const TileGrid& of_set,
                              const ProgressCallback& progress, int threads) {
  if (lower_extension(*given[kSource]) == ".json") {
    SCARP_TRY(auto&& job, read_tile_job(*given[kSource]));
    return open_job(std::move(job), kSourceBytes, threads);
  }
  GivenOptions tiles = given.as(kTile);
  tiles.set(kInput, std::vector{*given[kSource]});
  if (!given.has(kGrid)) tiles.set(kGrid, std::string(of_set.name()));
  if (of_set.is_flat()) tiles.set(kOf, "3dtiles");
  const std::string declared = find_vertical(set);
  if (!declared.empty() && !given.first_of({kVertical, kGeoid})) tiles.set(kVertical, declared);
  return open_tiles(tiles, progress, kSourceBytes);
}

}  // namespace

Result<void> run_tile_check(const GivenOptions& given, const std::string& command_line) {
  const Clock::time_point start = Clock::now();
  TileCheckOptions options;
  SCARP_TRY(const int threads, given.threads());
  options.run.threads = threads;
  SCARP_RETURN_IF_ERROR(check_unused(given));
  SCARP_TRY(const auto& set, open_tile_set(*given[kInput]));
  const TileGrid of_set = find_grid(*set);
  SCARP_TRY(const auto kind, parse_grid(given));
  if (kind) {
    if (of_set.is_flat())
      return fail(ErrorKind::kUsage,
                  fmt::format("{} is for sets that do not name theirs, and those of a local grid do", kGrid));
    options.grid = TileGrid{.kind = *kind};
  }
  ProgressDisplay display(ProgressDisplay::choose(given.has(kJsonProgress), given.has(kQuiet)));
  OpenedJob opened;
  if (given[kSource]) {
    SCARP_TRY(opened, open_source(given, *set, of_set, display.callback(), threads));
    const PyramidPlan& plan = opened.job.plan;
    const LocalRaster &mine = plan.grid.local, &theirs = of_set.local;
    if (mine.cols != theirs.cols || mine.rows != theirs.rows || mine.cell_x != theirs.cell_x ||
        mine.cell_y != theirs.cell_y)
      return fail(ErrorKind::kUsage, fmt::format("the local grid of {} is that of another raster than {}: their rows, "
                                                 "columns or cells differ",
                                                 *given[kInput], *given[kSource]));
    options.nodes.source = &opened.raster->nodes();
    options.nodes.covered = plan.covered;
    options.ellipsoid = plan.ellipsoid;
    if (opened.raster->plane()) options.nodes.place = place_of(*opened.raster->plane(), theirs);
    const bool is_plan = lower_extension(*given[kSource]) == ".json";
    if (is_plan || given.has(kCells)) options.nodes.cells = plan.cells;
    if (is_plan || given.has(kBackground)) options.nodes.background = plan.background;
  }
  options.run.progress = display.callback();
  SCARP_TRY(const TileCheck& check, check_tiles(*set, options));
  display.finish();
  if (given.has(kJson)) {
    Json report{{"command", command_line}, {"set", *given[kInput]}};
    add_tile_check(report, check);
    report["seconds"] = seconds_since(start);
    SCARP_RETURN_IF_ERROR(print_to_stdout(to_text(report)));
  } else if (!given.has(kQuiet)) {
    SCARP_RETURN_IF_ERROR(print_to_stdout(make_check_summary(*given[kInput], check, seconds_since(start))));
  }
  if (check.holds()) return {};
  return fail(ErrorKind::kPromise, describe_faults(*given[kInput], check));
}

}  // namespace scarp::cli
