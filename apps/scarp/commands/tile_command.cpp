#include "commands/tile_command.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <filesystem>
#include <utility>
#include <vector>

#include "options/option_table.h"
#include "reports/json.h"
#include "reports/report.h"
#include "scarp/globe_place.h"
#include "scarp/tile_set.h"
#include "terminal/clock.h"
#include "terminal/progress_display.h"
#include "terminal/text.h"

namespace scarp::cli {
namespace {

constexpr Choice<Effort> kEfforts[] = {{"fast", Effort::kFast}, {"normal", Effort::kNormal}, {"high", Effort::kHigh}};
constexpr Choice<int> kCells[] = {{"16", 16}, {"32", 32}, {"64", 64}, {"128", 128}, {"256", 256}};
constexpr Choice<Vertical> kVerticals[] = {
    {"auto", Vertical::kAuto}, {"egm96", Vertical::kEgm96}, {"ellipsoid", Vertical::kEllipsoid}};

/// Metres between samples, the geometric mean of both ways.
double cell_of(const RasterInfo& info) { return std::sqrt(info.cell_x_m * info.cell_y_m); }

std::string format_metres(double metres) { return format_number(metres) + " m"; }

Json describe_levels(const PyramidPlan& plan, const PyramidReport& report) {
  Json levels = Json::array();
  for (std::size_t z = 0; z < plan.levels.size(); ++z) {
    const LevelSummary& level = report.levels[z];
    levels.push_back({{"zoom", z},
                      {"tiles", level.tiles},
                      {"triangles", level.triangles},
                      {"bytes", level.bytes},
                      {"geometric_error", plan.levels[z].geometric_error},
                      {"asked", plan.levels[z].max_error},
                      {"tiles_over", level.over},
                      {"node_error", level.node_error},
                      {"bound", level.bound}});
  }
  return levels;
}

std::string make_summary(const std::string& input, const std::string& output, const PyramidPlan& plan,
                         const PyramidReport& report, const std::string& vertical, double seconds) {
  LevelSummary all;
  for (const LevelSummary& level : report.levels) {
    all.tiles += level.tiles;
    all.triangles += level.triangles;
    all.bytes += level.bytes;
  }
  std::string text = fmt::format("{} -> {}\n", base_name(input), output);
  text += fmt::format("  heights above  {}\n", vertical);
  text += fmt::format("  tiles          {}, levels 0 to {}, {}, {}\n", format_count(all.tiles), plan.max_zoom(),
                      format_plural(all.triangles, "triangle"), format_bytes(all.bytes));
  text += "  level      tiles  triangles/tile  bytes/tile      asked   at nodes  with the earth's curve\n";
  for (std::size_t z = 0; z < plan.levels.size(); ++z) {
    const LevelSummary& level = report.levels[z];
    const std::uint64_t tiles = std::max<std::uint64_t>(level.tiles, 1);
    text += fmt::format("  {:5} {:>10} {:>15} {:>11} {:>10} {:>10} {:>23}\n", z, format_count(level.tiles),
                        format_count(level.triangles / tiles), format_count(level.bytes / tiles),
                        format_metres(plan.levels[z].max_error), format_metres(level.node_error),
                        format_metres(level.bound));
  }
  text += fmt::format("  time           {} s\n", format_seconds(seconds));
  return text;
}

std::vector<std::string> warnings_of(const OwnedHeightField& field, const PyramidPlan& plan,
                                     const PyramidReport& report) {
  std::vector<std::string> warnings = field.info.warnings;
  // Degrees are what tiles are made in.
  std::erase_if(warnings, [](const std::string& one) { return one.find("x and y are degrees") != std::string::npos; });
  std::string over;
  std::uint64_t tiles = 0;
  for (std::size_t z = 0; z < plan.levels.size(); ++z) {
    if (report.levels[z].over == 0) continue;
    over += fmt::format("{}{}", over.empty() ? "" : ", ", z);
    tiles += report.levels[z].over;
  }
  if (tiles > 0)
    warnings.push_back(
        fmt::format("{} of the levels {} did not keep the max error asked, as the table shows: next to a "
                    "cliff, the raster's own edge above the background included, positions in 32767ths "
                    "of a tile are too coarse",
                    format_plural(tiles, "tile"), over));
  return warnings;
}

}  // namespace

TileCommand::TileCommand(CLI::App& program) : command_(add_command(program, kTile)) {
  add_arguments(*command_, OptionId::kInput, raster_.paths, OptionId::kOutput, output_);
  add_option(*command_, OptionId::kBand, raster_.band);
  add_numbers(*command_, OptionId::kExtent, raster_.extent, 4);
  add_option(*command_, OptionId::kResolution, raster_.resolution);
  add_option(*command_, OptionId::kDecode, raster_.decode);
  add_option(*command_, OptionId::kZScale, raster_.z_scale);
  add_option(*command_, OptionId::kZOffset, raster_.z_offset);
  add_option(*command_, OptionId::kVertical, vertical_);
  add_option(*command_, OptionId::kReport, report_);
  add_flag(*command_, OptionId::kOverwrite, overwrite_);
  add_option(*command_, OptionId::kEffort, effort_);
  add_option(*command_, OptionId::kMaxError, max_error_);
  add_option(*command_, OptionId::kQuality, quality_);
  add_option(*command_, OptionId::kZoom, zoom_);
  add_option(*command_, OptionId::kCells, cells_);
  add_option(*command_, OptionId::kNodata, raster_.nodata);
  add_option(*command_, OptionId::kBackground, background_);
  add_option(*command_, OptionId::kThreads, threads_);
  add_flag(*command_, OptionId::kQuiet, quiet_);
  add_flag(*command_, OptionId::kJsonProgress, json_progress_);
}

Result<PyramidSettings> TileCommand::parse_settings() const {
  PyramidSettings settings;
  if (max_error_) {
    const Result<double> error = parse_number("--max-error", *max_error_);
    if (!error) return tl::unexpected(error.error());
    if (!(*error > 0)) return fail(ErrorKind::kUsage, fmt::format("--max-error {} must be above 0", *max_error_));
    settings.max_error = *error;
  }
  if (quality_) {
    const Result<double> quality = parse_number("--quality", *quality_);
    if (!quality) return tl::unexpected(quality.error());
    settings.quality = *quality;
  }
  if (zoom_) {
    const Result<std::uint64_t> zoom = parse_count("--zoom", *zoom_, 0);
    if (!zoom) return tl::unexpected(zoom.error());
    settings.max_zoom = static_cast<int>(std::min<std::uint64_t>(*zoom, kMaxTileLevel + 1));
  }
  if (cells_) {
    const Result<int> cells = choose("--cells", *cells_, kCells);
    if (!cells) return tl::unexpected(cells.error());
    settings.cells = *cells;
  }
  if (effort_) {
    const Result<Effort> effort = choose("--effort", *effort_, kEfforts);
    if (!effort) return tl::unexpected(effort.error());
    settings.effort = *effort;
  }
  if (background_) {
    const Result<double> height = parse_number("--background", *background_);
    if (!height) return tl::unexpected(height.error());
    settings.background = static_cast<float>(*height);
  }
  return settings;
}

Result<OwnedHeightField> TileCommand::read_raster(const ProgressCallback& progress) const {
  Result<ReadOptions> options = raster_.parse();
  if (!options) return tl::unexpected(options.error());
  options->crs = "source";
  options->run.progress = progress;
  auto field = read_height_field(raster_.path(), *options);
  if (!field) return tl::unexpected(raster_.explain(field.error()));
  return field;
}

Result<void> TileCommand::run(const std::string& command_line) const {
  const Clock::time_point start = Clock::now();
  Result<PyramidSettings> settings = parse_settings();
  if (!settings) return tl::unexpected(settings.error());
  const Result<Vertical> vertical = choose("--vertical", vertical_.value_or("auto"), kVerticals);
  if (!vertical) return tl::unexpected(vertical.error());
  const Result<int> threads = parse_threads(threads_);
  if (!threads) return tl::unexpected(threads.error());
  std::vector<PlannedOutput> outputs;
  if (report_) outputs.push_back({"--report", *report_});
  if (auto checked = check_outputs(outputs, files_read(*command_), overwrite_); !checked) return checked;

  ProgressDisplay display(ProgressDisplay::choose(json_progress_, quiet_));
  const Result<OwnedHeightField> field = read_raster(display.callback());
  if (!field) return tl::unexpected(field.error());
  const Result<RasterOnGlobe> globe = place_on_globe(field->info, field->cols, field->rows, *vertical, raster_.path());
  if (!globe) return tl::unexpected(globe.error());
  settings->ellipsoid = globe->ellipsoid;
  const Result<DegreeBox> covered = degrees_covered(*field, globe->place.affine, globe->to_degrees.get());
  if (!covered) return tl::unexpected(covered.error());
  auto nodes = make_node_source(*field, globe->place);
  if (!nodes) return tl::unexpected(nodes.error());
  std::unique_ptr<NodeSource> raised;
  // The geoid lies within 110 m of the ellipsoid.
  const double reserve = globe->zero ? 110 : 0;
  if (globe->zero) raised = make_raised_source(**nodes, globe->zero);
  const Result<PyramidPlan> plan =
      plan_pyramid({*covered, cell_of(field->info), field->info.min - reserve, field->info.max + reserve,
                    globe->to_degrees ? 0 : std::sqrt(field->info.cell_x * field->info.cell_y)},
                   *settings);
  if (!plan) return tl::unexpected(plan.error());

  auto set = create_tile_set(output_, TileFormat::kQuantizedMesh, overwrite_);
  if (!set) return tl::unexpected(set.error());
  TileSetSink sink(**set, quantized_mesh_encoder(plan->ellipsoid));
  Run run;
  run.threads = *threads;
  run.progress = display.callback();
  const Result<PyramidReport> report = make_pyramid(*plan, raised ? *raised : **nodes, sink, run);
  if (!report) return tl::unexpected(report.error());
  if (!report->has_heights)
    return fail(ErrorKind::kUsage,
                fmt::format("no node of level {} lies in {}: give a larger --zoom", plan->max_zoom(), raster_.path()));
  LayerFacts facts;
  facts.name = base_name(raster_.path());
  facts.description = fmt::format("heights above {}", globe->vertical);
  facts.version = sink.version();
  if (auto put = (*set)->put_file("layer.json", encode_layer_json(*plan, *report, facts)); !put) return put;
  if (auto finished = (*set)->finish(); !finished) return finished;
  display.finish();
  if (!quiet_) print_warnings(warnings_of(*field, *plan, *report));
  const double seconds = seconds_since(start);
  if (report_) {
    const Json json{
        {"command", command_line},     {"input", raster_.paths},       {"output", output_},
        {"vertical", globe->vertical}, {"max_zoom", plan->max_zoom()}, {"levels", describe_levels(*plan, *report)},
        {"seconds", seconds}};
    if (auto written = write_report(json, *report_, overwrite_, output_); !written) return written;
  }
  if (quiet_) return {};
  return print_summary(make_summary(raster_.path(), output_, *plan, *report, globe->vertical, seconds));
}

}  // namespace scarp::cli
