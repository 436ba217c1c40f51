#include "session/plan/tile_plan.h"

#include <fmt/format.h>

#include <algorithm>
#include <utility>

#include "scarp/lines.h"
#include "scarp/tile.h"
#include "session/plan/conflicts.h"
#include "session/text/text.h"

namespace scarp::cli {
namespace {

using enum OptionId;

/// Warns if the land around missing samples is far from the background's height.
std::vector<std::string> warn_of_walls(const GlobeRaster& raster, const PyramidPlan& plan) {
  const VoidCount voids = raster.voids();
  const double background = plan.background, wall = std::max(voids.least - background, background - voids.most);
  constexpr double kHigh = 10;  // times the max error
  if (voids.left == 0 || !(wall > kHigh * plan.levels.back().max_error)) return {};
  return {
      fmt::format("{} at the raster's edge or in voids of more than {} samples a side get the height {} ({}), "
                  "up to {} m from the land around them, which makes walls: {} fill interpolates them",
                  format_plural(voids.left, "missing sample"), kVoidSide, format_number(background), kBackground,
                  format_number(wall), kNodataPolicy)};
}

void add_plane(const GlobeRaster& raster, LayerFacts& facts) {
  if (!raster.plane()) return;
  facts.units = raster.plane()->units;
  facts.plane = raster.plane()->globe;
}

/// The format of tiles of a grid, which may still be unknown. Fails with kUsage for conflicting options.
Result<TileFormat> choose_format(const GivenOptions& given, std::optional<GridKind> grid_of_tiles) {
  SCARP_TRY(const TileFormat kept, parse_tile_format(given, grid_of_tiles));
  const bool is_known = given.has(kOf) || grid_of_tiles;
  SCARP_RETURN_IF_ERROR(check_conflicts(given, grid_of_tiles, is_known ? std::optional(kept) : std::nullopt));
  return kept;
}

}  // namespace

Result<OpenedJob> open_job(TileJob job, std::uint64_t memory, int threads) {
  SCARP_RETURN_IF_ERROR(check_rasters(job));
  ReadOptions options = job.reading;
  options.run.memory.limit = memory;
  options.run.threads = threads;
  SCARP_TRY(auto raster, GlobeRaster::open(mosaics_of(job), options, job.datum, job.plan.grid.kind));
  raster->add_waters(job.plan);
  return OpenedJob{std::move(raster), std::move(job)};
}

Result<OpenedJob> open_tiles(const GivenOptions& given, const ProgressCallback& progress, std::uint64_t memory) {
  SCARP_TRY(PyramidSettings settings, parse_tile_settings(given));
  SCARP_TRY(const Datum datum, parse_datum(given));
  SCARP_TRY(ReadOptions options, parse_tile_reading(given));
  SCARP_TRY(const WaterFiles waters, parse_waters(given));
  SCARP_TRY(const std::optional<GridKind> kind, parse_grid(given));
  // checks only the options; without --grid the rest depends on the raster
  SCARP_RETURN_IF_ERROR(choose_format(given, kind));
  SCARP_TRY(auto image, parse_tile_drape(given));
  OpenedJob opened;
  TileJob& job = opened.job;
  job.drape = std::move(image);
  job.reading = options;
  job.datum = datum;
  if (given[kGeoid]) job.geoid = stamp_of(*given[kGeoid]);
  options.with_range = true;
  options.run.progress = progress;
  options.run.memory.limit = memory;
  const std::vector<std::vector<std::string>> mosaics = find_mosaics(given.inputs());
  auto globe = GlobeRaster::open(mosaics, options, datum, kind);
  if (!globe) return tl::unexpected(explain_reading(given, globe.error()));
  opened.raster = std::move(*globe);
  if (settings.binds_samples && opened.raster->grid(settings.cells).is_flat()) {  // nodes are samples
    settings.binds_samples = false;
    if (!given[kCells]) settings.cells = PyramidSettings{}.cells;
  }
  settings.grid = opened.raster->grid(settings.cells);
  SCARP_TRY(const TileFormat kept, choose_format(given, settings.grid.kind));
  job.format = kept;
  settings.has_siblings = kept == TileFormat::kGlb;
  // Nodata of a plane at an arbitrary height is not sea.
  if (settings.grid.is_flat() && !given[kBackground])
    settings.background = static_cast<float>(opened.raster->info().min);
  settings.ellipsoid = opened.raster->place().ellipsoid;
  if (settings.binds_samples && !opened.raster->nodes().has_samples())
    return fail(
        ErrorKind::kUsage,
        fmt::format("{} samples is for one raster or mosaic: of several the visible samples are not known", kBound));
  if (!given.all(kBreaklines).empty() && !opened.raster->place().body.empty())
    return fail(
        ErrorKind::kUsage,
        fmt::format("{} is for tiles of the earth: the ellipsoid of the lines is not known elsewhere", kBreaklines));
  for (const std::string& file : given.all(kBreaklines)) {
    SCARP_TRY(const auto lines, read_lines(file, {.crs = "EPSG:4326", .ignore_z = true}));
    for (const Line& line : lines.lines) {
      settings.lines.emplace_back();
      for (const auto& point : line.points) settings.lines.back().push_back({point[0], point[1]});
    }
    opened.warnings.insert(opened.warnings.end(), lines.warnings.begin(), lines.warnings.end());
  }
  SCARP_TRY(job.plan, plan_pyramid(opened.raster->facts(), settings));
  std::vector<std::string> paths;
  for (const std::vector<std::string>& mosaic : mosaics) {
    job.mosaics.push_back(static_cast<std::uint32_t>(mosaic.size()));
    paths.insert(paths.end(), mosaic.begin(), mosaic.end());
  }
  stamp_rasters(job, paths);
  job.waters = waters;
  job.plan.has_water_mask = given.has(kWaterMask);
  SCARP_RETURN_IF_ERROR(find_waters(job, *opened.raster));
  for (std::string& one : warn_of_walls(*opened.raster, job.plan)) opened.warnings.push_back(std::move(one));
  job.filled = opened.raster->voids().filled;
  if (!given[kGeoid] && given[kVertical] != Given("auto"))
    job.facts.vertical = vertical_word(given[kVertical].value_or(""));
  job.facts.heights_above = opened.raster->heights_above();
  job.facts.body = opened.raster->place().body;
  add_plane(*opened.raster, job.facts);
  job.facts.name = base_name(given.input());
  job.facts.description = fmt::format("heights above {}", job.facts.heights_above);
  return opened;
}

Result<OpenedJob> follow_tiles(const GivenOptions& given, const TileJob& earlier, const ProgressCallback& progress) {
  ReadOptions options = earlier.reading;
  TileJob now;
  options.with_range = true;
  options.run.progress = progress;
  const std::vector<std::vector<std::string>> mosaics = find_mosaics(given.inputs());
  auto globe = GlobeRaster::open(mosaics, options, earlier.datum, earlier.plan.grid.kind);
  if (!globe) return tl::unexpected(explain_reading(given, globe.error()));
  OpenedJob opened;
  opened.raster = std::move(*globe);
  PyramidSettings settings;
  settings.cells = earlier.plan.cells;
  settings.max_zoom = earlier.plan.max_zoom();
  settings.max_error = earlier.plan.levels.back().max_error;
  settings.background = earlier.plan.background;
  settings.ellipsoid = earlier.plan.ellipsoid;
  settings.grid = earlier.plan.grid;
  if (settings.grid.local != opened.raster->grid(settings.cells).local)
    return fail(ErrorKind::kUsage,
                fmt::format("{} has other rows, columns or cells than the raster of the earlier plan, "
                            "whose grid is local: make the set anew",
                            given.input()));
  SCARP_TRY(now.plan, plan_pyramid(opened.raster->facts(), settings));
  std::vector<std::string> paths;
  for (const std::vector<std::string>& mosaic : mosaics) {
    now.mosaics.push_back(static_cast<std::uint32_t>(mosaic.size()));
    paths.insert(paths.end(), mosaic.begin(), mosaic.end());
  }
  stamp_rasters(now, paths);
  now.waters = earlier.waters;
  SCARP_RETURN_IF_ERROR(find_waters(now, *opened.raster));
  if (!earlier.geoid.path.empty()) now.geoid = stamp_of(earlier.geoid.path);
  if (earlier.drape) now.drape = stamp_drape(earlier.drape->path(), earlier.drape->format);
  now.facts = earlier.facts;
  now.filled = opened.raster->voids().filled;
  now.facts.heights_above = opened.raster->heights_above();
  now.facts.body = opened.raster->place().body;
  add_plane(*opened.raster, now.facts);
  now.facts.name = base_name(given.input());
  now.facts.description = fmt::format("heights above {}", now.facts.heights_above);
  SCARP_TRY(opened.job, follow_job(earlier, std::move(now)));
  return opened;
}

}  // namespace scarp::cli
