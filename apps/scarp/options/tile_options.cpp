#include "options/tile_options.h"

#include <fmt/format.h>

#include <CLI/CLI.hpp>
#include <algorithm>
#include <utility>

#include "options/option_table.h"

namespace scarp::cli {
namespace {

constexpr Choice<Effort> kTileEfforts[] = {
    {"fast", Effort::kFast}, {"normal", Effort::kNormal}, {"high", Effort::kHigh}};
constexpr Choice<int> kCells[] = {{"16", 16}, {"32", 32}, {"64", 64}, {"128", 128}, {"256", 256}};
constexpr Choice<Vertical> kVerticals[] = {
    {"auto", Vertical::kAuto}, {"egm96", Vertical::kEgm96}, {"ellipsoid", Vertical::kEllipsoid}};

constexpr Choice<TileFormat> kTileFormats[] = {{"qm", TileFormat::kQuantizedMesh}, {"3dtiles", TileFormat::kGlb}};

}  // namespace

Result<OpenedJob> open_job(TileJob job, std::uint64_t memory, int threads) {
  if (auto same = check_rasters(job); !same) return tl::unexpected(same.error());
  ReadOptions options = job.reading;
  options.run.memory.limit = memory;
  options.run.threads = threads;
  auto raster = GlobeRaster::open(job.rasters.front().path, options, job.vertical);
  if (!raster) return tl::unexpected(raster.error());
  return OpenedJob{std::move(*raster), std::move(job)};
}

void TileArguments::add_to(CLI::App& command) {
  if (command.get_name() != "serve") add_option(command, OptionId::kOf, format);
  add_option(command, OptionId::kBand, raster.band);
  add_numbers(command, OptionId::kExtent, raster.extent, 4);
  add_option(command, OptionId::kResolution, raster.resolution);
  add_option(command, OptionId::kDecode, raster.decode);
  add_option(command, OptionId::kZScale, raster.z_scale);
  add_option(command, OptionId::kZOffset, raster.z_offset);
  add_option(command, OptionId::kVertical, vertical);
  add_option(command, OptionId::kEffort, effort);
  add_option(command, OptionId::kMaxError, max_error);
  add_option(command, OptionId::kQuality, quality);
  add_option(command, OptionId::kZoom, zoom);
  add_option(command, OptionId::kCells, cells);
  add_option(command, OptionId::kNodata, raster.nodata);
  add_option(command, OptionId::kBackground, background);
}

Result<PyramidSettings> TileArguments::parse_settings() const {
  PyramidSettings settings;
  settings.effort = default_effort;
  if (max_error) {
    const Result<double> error = parse_number("--max-error", *max_error);
    if (!error) return tl::unexpected(error.error());
    if (!(*error > 0)) return fail(ErrorKind::kUsage, fmt::format("--max-error {} must be above 0", *max_error));
    settings.max_error = *error;
  }
  if (quality) {
    const Result<double> number = parse_number("--quality", *quality);
    if (!number) return tl::unexpected(number.error());
    settings.quality = *number;
  }
  if (zoom) {
    const Result<std::uint64_t> level = parse_count("--zoom", *zoom, 0);
    if (!level) return tl::unexpected(level.error());
    settings.max_zoom = static_cast<int>(std::min<std::uint64_t>(*level, kMaxTileLevel + 1));
  }
  if (cells) {
    const Result<int> count = choose("--cells", *cells, kCells);
    if (!count) return tl::unexpected(count.error());
    settings.cells = *count;
  }
  if (effort) {
    const Result<Effort> chosen = choose("--effort", *effort, kTileEfforts);
    if (!chosen) return tl::unexpected(chosen.error());
    settings.effort = *chosen;
  }
  if (background) {
    const Result<double> height = parse_number("--background", *background);
    if (!height) return tl::unexpected(height.error());
    settings.background = static_cast<float>(*height);
  }
  return settings;
}

Result<OpenedJob> TileArguments::open(const ProgressCallback& progress, std::uint64_t memory) const {
  Result<PyramidSettings> settings = parse_settings();
  if (!settings) return tl::unexpected(settings.error());
  const Result<Vertical> above = choose("--vertical", vertical.value_or("auto"), kVerticals);
  if (!above) return tl::unexpected(above.error());
  Result<ReadOptions> options = raster.parse();
  if (!options) return tl::unexpected(options.error());
  const Result<TileFormat> kept = choose("--of", format.value_or("qm"), kTileFormats);
  if (!kept) return tl::unexpected(kept.error());
  OpenedJob opened;
  TileJob& job = opened.job;
  job.format = *kept;
  settings->has_siblings = *kept == TileFormat::kGlb;
  job.reading = *options;
  job.vertical = *above;
  options->with_range = true;
  options->run.progress = progress;
  options->run.memory.limit = memory;
  auto globe = GlobeRaster::open(raster.path(), *options, *above);
  if (!globe) return tl::unexpected(raster.explain(globe.error()));
  opened.raster = std::move(*globe);
  settings->ellipsoid = opened.raster->place().ellipsoid;
  auto plan = plan_pyramid(opened.raster->facts(), *settings);
  if (!plan) return tl::unexpected(plan.error());
  job.plan = std::move(*plan);
  for (const std::string& path : raster.paths) job.rasters.push_back(stamp_of(path));
  job.heights_above = opened.raster->place().vertical;
  job.facts.name = base_name(raster.path());
  job.facts.description = fmt::format("heights above {}", job.heights_above);
  return opened;
}

}  // namespace scarp::cli
