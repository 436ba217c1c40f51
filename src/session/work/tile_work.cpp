#include "session/work/tile_work.h"

#include <fmt/format.h>

#include <utility>

#include "session/reports/tile_report.h"
#include "session/text/paths.h"
#include "session/work/counted_set.h"

namespace scarp::cli {

Result<void> check_container(const TileJob& job, const std::string& output) {
  const std::string ending = lower_extension(output);
  if (!job.plan.grid.is_flat() || (ending != ".pmtiles" && ending != ".mbtiles")) return {};
  return fail(ErrorKind::kUsage,
              fmt::format("{}: {} knows tiles of the globe alone: keep a local grid in a folder or a "
                          ".3tz",
                          output, ending));
}

Result<MadeTiles> make_tiles(const TileArguments& tiles, const std::string& output, bool overwrite, const Run& run,
                             TileCounts& counts) {
  if (auto named = check_set_name(output); !named) return tl::unexpected(named.error());
  auto opened = open_tiles(tiles, run.progress);
  if (!opened) return tl::unexpected(opened.error());
  const TileJob& job = opened->job;
  if (auto fits = check_container(job, output); !fits) return tl::unexpected(fits.error());
  auto encoder = open_tile_encoder(job);
  if (!encoder) return tl::unexpected(encoder.error());
  auto container = create_tile_set(output, job.format, overwrite);
  if (!container) return tl::unexpected(container.error());
  CountedSet set(std::move(*container), counts);
  const std::unique_ptr<TileSetSink> sink = make_tile_sink(job.format, set, job.plan, std::move(*encoder));
  Result<PyramidReport> report = make_pyramid(job.plan, opened->raster->nodes(), *sink, run);
  if (!report) return tl::unexpected(report.error());
  if (auto same = check_rasters(job); !same) return tl::unexpected(same.error());
  if (auto checked = check_heights(job, *report); !checked) return tl::unexpected(checked.error());
  if (auto put = sink->put_files(*report, job.facts); !put) return tl::unexpected(put.error());
  if (auto finished = set.finish(); !finished) return tl::unexpected(finished.error());
  std::vector<std::string> warnings = warnings_of_raster(*opened->raster);
  warnings.insert(warnings.end(), opened->warnings.begin(), opened->warnings.end());
  for (std::string& warning : warnings_of_levels(job.plan, *report)) warnings.push_back(std::move(warning));
  return MadeTiles{std::move(*opened), std::move(*report), std::move(warnings)};
}

}  // namespace scarp::cli
