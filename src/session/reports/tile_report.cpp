#include "session/reports/tile_report.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <optional>
#include <utility>

#include "session/text/json_text.h"
#include "session/text/text.h"
#include "tiles/water/tile_waters.h"

namespace scarp::cli {
namespace {

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
                      {"tiles_coarser", level.coarser},
                      {"tiles_oversized", level.oversized},
                      {"lines_left_out", level.lines_left_out},
                      {"node_error", level.node_error},
                      {"bound", level.bound},
                      {"source_error", level.source_error}});
  }
  return levels;
}

Json describe_waters(const TileJob& job) {
  if (!job.plan.waters) return nullptr;
  Json lakes = Json::array(), rivers = Json::array();
  for (const tiles::TileLake& lake : job.plan.waters->lakes)
    lakes.push_back({{"name", lake.name}, {"level", lake.level}});
  for (const tiles::TileRiver& river : job.plan.waters->rivers) rivers.push_back({{"name", river.name}});
  return {{"lakes", std::move(lakes)}, {"rivers", std::move(rivers)}};
}

}  // namespace

std::string format_length(const TileJob& job, double length) {
  return format_number(length) + unit_behind(job.facts.units);
}

std::string waters_line(const TileJob& job) {
  if (!job.plan.waters) return "";
  double low = INFINITY, high = -INFINITY;
  std::uint64_t lakes = 0;
  for (const tiles::TileLake& lake : job.plan.waters->lakes) {
    if (std::isnan(lake.level)) continue;
    ++lakes;
    low = std::min(low, lake.level);
    high = std::max(high, lake.level);
  }
  std::string text = fmt::format("  water          {}", format_plural(lakes, "lake"));
  if (lakes > 0 && low == high) text += fmt::format(" at {}", format_metres(low));
  if (low < high) text += fmt::format(" at {} to {}", format_metres(low), format_metres(high));
  return text + fmt::format(", {}; bounds are relative to nodes with water\n",
                            format_plural(job.plan.waters->rivers.size(), "river"));
}

std::string grid_lines(const TileJob& job) {
  if (!job.plan.grid.is_flat()) return "";
  const LocalRaster& raster = job.plan.grid.local;
  const std::string width = format_length(job, raster.cell_x), height = format_length(job, raster.cell_y);
  std::string text = fmt::format("  grid           local, 3D Tiles: {} x {} samples, cells of {}{}\n", raster.cols,
                                 raster.rows, width, width == height ? "" : " x " + height);
  if (!job.facts.plane) return text + "  on the globe   nowhere: the set has no transform\n";
  const PlaneOnGlobe& plane = *job.facts.plane;
  text += fmt::format(
      "  on the globe   by a plane at its centre{}, turned by {:.4f} degrees, scale {:.6f}; off by up to {} along "
      "the ground, {} in height\n",
      job.facts.body.empty() ? "" : " on " + job.facts.body, plane.convergence, plane.scale_x,
      format_metres(plane.off_along), format_metres(plane.off_height));
  return text;
}

void add_tiles(Json& json, const TileJob& job, const std::string& output, const PyramidReport& report) {
  json["output"] = output;
  json["vertical"] = job.facts.heights_above;
  json["ellipsoid"] = {job.plan.ellipsoid.semi_major, semi_minor(job.plan.ellipsoid)};
  json["grid"] = job.plan.grid.name();
  if (const auto& plane = job.facts.plane)
    json["plane"] = {{"crs", plane->crs},
                     {"convergence", plane->convergence},
                     {"scale", {plane->scale_x, plane->scale_y}},
                     {"off_along", plane->off_along},
                     {"off_height", plane->off_height}};
  json["water"] = describe_waters(job);
  json["filled"] = job.filled;
  json["max_zoom"] = job.plan.max_zoom();
  json["levels"] = describe_levels(job.plan, report);
}

std::string make_tile_summary(const TileJob& job, const std::string& output, const PyramidReport& report,
                              double seconds, const std::string& points_line) {
  const PyramidPlan& plan = job.plan;
  LevelSummary all;
  for (const LevelSummary& level : report.levels) {
    all.tiles += level.tiles;
    all.triangles += level.triangles;
    all.bytes += level.bytes;
  }
  std::string text = fmt::format("{} -> {}\n", job.facts.name, output) + points_line;
  text += fmt::format("  heights above  {}\n", job.facts.heights_above);
  text += grid_lines(job);
  if (job.filled > 0)
    text += fmt::format("  filled         {}{}\n", format_plural(job.filled, "missing sample"),
                        job.reading.void_side > 0 ? " in enclosed voids; --nodata-policy background leaves them" : "");
  text += waters_line(job);
  text += fmt::format("  tiles          {}, levels 0 to {}, {}, {}\n", format_count(all.tiles), plan.max_zoom(),
                      format_plural(all.triangles, "triangle"), format_bytes(all.bytes));
  text += fmt::format("  level      tiles  triangles/tile  bytes/tile      asked   at nodes  {:>22}  at samples\n",
                      plan.grid.is_flat() ? "in space" : "with the earth's curve");
  for (std::size_t z = 0; z < plan.levels.size(); ++z) {
    const LevelSummary& level = report.levels[z];
    const std::uint64_t tiles = std::max<std::uint64_t>(level.tiles, 1);
    text += fmt::format("  {:5} {:>10} {:>15} {:>11} {:>10} {:>10} {:>23} {:>11}\n", z, format_count(level.tiles),
                        format_count(level.triangles / tiles), format_count(level.bytes / tiles),
                        format_length(job, plan.levels[z].max_error), format_length(job, level.node_error),
                        format_length(job, level.bound),
                        std::isnan(level.source_error) ? "not known" : format_length(job, level.source_error));
  }
  text += fmt::format("  time           {} s\n", format_seconds(seconds));
  return text;
}

namespace {

struct Compared {
  const char* name;
  double planned, took;
};

std::vector<Compared> compare(const TileEstimate& estimate, const PyramidReport& report, const PartsCost& cost) {
  LevelSummary all;
  for (const LevelSummary& level : report.levels) {
    all.tiles += level.tiles;
    all.bytes += level.bytes;
  }
  const auto number = [](std::uint64_t count) { return static_cast<double>(count); };
  return {{"tiles", number(estimate.tiles), number(all.tiles)},
          {"bytes", number(estimate.bytes), number(all.bytes)},
          {"core_seconds", estimate.core_seconds, cost.core_seconds},
          {"memory", number(estimate.memory), number(cost.memory)},
          {"parts", number(estimate.parts), number(cost.parts)}};
}

}  // namespace

Json compare_model(const TileJob& job, const PyramidReport& report, const PartsCost& cost) {
  if (!job.estimate) return nullptr;
  Json json;
  for (const Compared& one : compare(*job.estimate, report, cost)) {
    json[one.name] = {{"planned", one.planned}, {"took", one.took}};
    json[one.name]["ratio"] = one.planned > 0 ? Json(one.took / one.planned) : Json(nullptr);
  }
  return json;
}

std::string summarize_model(const TileJob& job, const PyramidReport& report, const PartsCost& cost) {
  if (!job.estimate) return "";
  std::string text;
  for (const Compared& one : compare(*job.estimate, report, cost)) {
    if (one.planned > 0)
      text +=
          fmt::format("{}{} {:.2f}", text.empty() ? "  took/planned   " : ", ",
                      std::string_view(one.name) == "core_seconds" ? "core time" : one.name, one.took / one.planned);
  }
  return text + "\n";
}

std::vector<std::string> warnings_of_raster(const GlobeRaster& raster) {
  std::vector<std::string> warnings = raster.warnings();
  // Tiles are always in degrees.
  std::erase_if(warnings, [](const std::string& one) { return one.find("x and y are degrees") != std::string::npos; });
  return warnings;
}

namespace {

/// The number of tiles that `count` counts, and their levels as "9, 10"; nothing if there are none.
std::optional<std::pair<std::string, std::string>> count_tiles(const PyramidReport& report,
                                                               std::uint64_t LevelSummary::*count,
                                                               const char* what = "tile") {
  std::string levels;
  std::uint64_t tiles = 0;
  for (std::size_t z = 0; z < report.levels.size(); ++z) {
    if (report.levels[z].*count == 0) continue;
    levels += fmt::format("{}{}", levels.empty() ? "" : ", ", z);
    tiles += report.levels[z].*count;
  }
  if (tiles == 0) return std::nullopt;
  return std::pair{format_plural(tiles, what), levels};
}

constexpr std::string_view kCliffs =
    "next to a cliff, the raster's own edge above the background included, positions in 32767ths of a tile are too "
    "coarse";

/// For a plan that binds samples: the errors at nodes and at samples on the finest level above its max error, and the
/// remedy.
std::string explain_over(const PyramidPlan& plan, const PyramidReport& report) {
  std::size_t z = report.levels.size() - 1;
  while (report.levels[z].over == 0) --z;
  const LevelSummary& level = report.levels[z];
  const double asked = plan.levels[z].max_error;
  const std::string kept =
      fmt::format("level {} has {} at nodes and {} at samples where {} were asked", z, format_metres(level.node_error),
                  format_metres(level.source_error), format_metres(asked));
  // Closer nodes reduce errors of samples between them, but not at a cliff that is too steep for the positions.
  if (level.node_error <= asked)
    return kept + ". Nodes are too far apart for such samples: give a larger --zoom or --max-error";
  return fmt::format("{}. At nodes that is {}: give a larger --max-error", kept, kCliffs);
}

}  // namespace

std::vector<std::string> warnings_of_levels(const PyramidPlan& plan, const PyramidReport& report) {
  std::vector<std::string> warnings;
  if (const auto over = count_tiles(report, &LevelSummary::over))
    warnings.push_back(fmt::format("{} of the levels {} did not keep the max error asked, as the table shows: {}",
                                   over->first, over->second,
                                   plan.binds_samples ? explain_over(plan, report) : std::string(kCliffs)));
  if (const auto coarser = count_tiles(report, &LevelSummary::coarser))
    warnings.push_back(
        fmt::format("{} of the levels {} have a larger max error inside, as the table shows, so as to "
                    "keep within --max-tile-bytes {}",
                    coarser->first, coarser->second, plan.max_tile_bytes));
  if (const auto oversized = count_tiles(report, &LevelSummary::oversized))
    warnings.push_back(
        fmt::format("{} of the levels {} are larger than --max-tile-bytes {}: what neighbours share "
                    "alone takes more",
                    oversized->first, oversized->second, plan.max_tile_bytes));
  if (const auto left_out = count_tiles(report, &LevelSummary::lines_left_out, "piece"))
    warnings.push_back(
        fmt::format("{} of the lines, of the levels {}, are no edges of the mesh: in 32767ths of a tile "
                    "they would turn triangles over",
                    left_out->first, left_out->second));
  return warnings;
}

Result<void> check_heights(const TileJob& job, const PyramidReport& report) {
  if (report.has_heights) return {};
  return fail(ErrorKind::kUsage, fmt::format("no node of level {} lies in {}: give a larger --zoom",
                                             job.plan.max_zoom(), job.rasters.front().path));
}

}  // namespace scarp::cli
