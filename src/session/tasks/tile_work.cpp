#include "session/tasks/tile_work.h"

#include <fmt/format.h>

#include <utility>

#include "scarp/tile.h"
#include "scarp/tile_job.h"
#include "session/options/points_options.h"
#include "session/reports/tile_report.h"
#include "session/tasks/counted_set.h"
#include "session/text/paths.h"

namespace scarp::cli {

Result<void> check_container(const TileJob& job, const std::string& output) {
  const std::string ending = lower_extension(output);
  if (!job.plan.grid.is_flat() || (ending != ".pmtiles" && ending != ".mbtiles")) return {};
  return fail(ErrorKind::kUsage,
              fmt::format("{}: {} knows tiles of the globe alone: keep a local grid in a folder or a "
                          ".3tz",
                          output, ending));
}

Result<MadeTiles> make_tiles(const GivenOptions& tiles, const std::string& output, bool overwrite, const Run& run,
                             TileCounts& counts) {
  SCARP_RETURN_IF_ERROR(check_set_name(output));
  SCARP_RETURN_IF_ERROR(check_kind_of_input(tiles));
  std::unique_ptr<PointsRaster> points;
  if (are_points_meant(tiles)) {
    SCARP_TRY(points, PointsRaster::make(tiles, {run.progress}));
  }
  SCARP_TRY(auto opened, open_tiles(points ? points->options(tiles) : tiles, run.progress));
  const TileJob& job = opened.job;
  SCARP_RETURN_IF_ERROR(check_container(job, output));
  SCARP_TRY(auto encoder, open_tile_encoder(job));
  SCARP_TRY(auto container, create_tile_set(output, job.format, overwrite));
  CountedSet set(std::move(container), counts);
  const std::unique_ptr<TileSetSink> sink = make_tile_sink(job.format, set, job.plan, std::move(encoder));
  SCARP_TRY(PyramidReport report, make_pyramid(job.plan, opened.raster->nodes(), *sink, run));
  SCARP_RETURN_IF_ERROR(check_rasters(job));
  SCARP_RETURN_IF_ERROR(check_heights(job, report));
  SCARP_RETURN_IF_ERROR(sink->put_files(report, job.facts));
  SCARP_RETURN_IF_ERROR(set.finish());
  std::vector<std::string> warnings = points ? points->warnings() : std::vector<std::string>();
  for (std::string& warning : warnings_of_raster(*opened.raster)) warnings.push_back(std::move(warning));
  warnings.insert(warnings.end(), opened.warnings.begin(), opened.warnings.end());
  for (std::string& warning : warnings_of_levels(job.plan, report)) warnings.push_back(std::move(warning));
  return MadeTiles{std::move(points), std::move(opened), std::move(report), std::move(warnings)};
}

}  // namespace scarp::cli
