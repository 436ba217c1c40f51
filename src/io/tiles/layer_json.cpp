#include <algorithm>
#include <nlohmann/json.hpp>
#include <utility>

#include "scarp/tile_set.h"
#include "scarp/version.h"

namespace scarp {
namespace {

using Json = nlohmann::ordered_json;

/// Tiles of a level from x to end_x and from y to end_y.
struct TileRange {
  std::uint32_t x = 0, y = 0, end_x = 0, end_y = 0;
};

/// A level's tiles, sorted by row and column, as rectangles.
std::vector<TileRange> find_ranges(const std::vector<std::uint64_t>& tiles) {
  std::vector<TileRange> ranges, open;
  for (std::size_t k = 0; k < tiles.size();) {
    const auto y = static_cast<std::uint32_t>(tiles[k] >> 32);
    std::vector<TileRange> row;
    while (k < tiles.size() && static_cast<std::uint32_t>(tiles[k] >> 32) == y) {
      const auto x = static_cast<std::uint32_t>(tiles[k]);
      if (!row.empty() && row.back().end_x + 1 == x) {
        row.back().end_x = x;
      } else {
        row.push_back({x, y, x, y});
      }
      ++k;
    }
    // Extends a run upwards if the previous row has an equal run.
    for (TileRange& run : row) {
      const auto below = std::find_if(open.begin(), open.end(), [&](const TileRange& one) {
        return one.x == run.x && one.end_x == run.end_x && one.end_y + 1 == y;
      });
      if (below == open.end()) continue;
      run.y = below->y;
      open.erase(below);
    }
    ranges.insert(ranges.end(), open.begin(), open.end());
    open = std::move(row);
  }
  ranges.insert(ranges.end(), open.begin(), open.end());
  return ranges;
}

}  // namespace

std::vector<std::uint8_t> encode_layer_json(const PyramidPlan& plan, const PyramidReport& report,
                                            const LayerFacts& facts) {
  io::Json layer{{"tilejson", "2.1.0"},
                 {"name", facts.name},
                 {"description", facts.description},
                 {"version", facts.version},
                 {"format", "quantized-mesh-1.0"},
                 {"attribution", facts.attribution},
                 {"schema", "tms"},
                 {"tiles", {"{z}/{x}/{y}.terrain?v={version}"}},
                 {"projection", plan.grid.projection()},
                 {"bounds", {plan.covered.west, plan.covered.south, plan.covered.east, plan.covered.north}},
                 {"minzoom", 0},
                 {"maxzoom", plan.max_zoom()},
                 {"extensions", {"octvertexnormals"}}};
  if (plan.has_water_mask) layer["extensions"].push_back("watermask");
  io::Json available = io::Json::array(), levels = io::Json::array();
  for (std::size_t z = 0; z < report.tiles.size(); ++z) {
    io::Json ranges = io::Json::array();
    for (const TileRange& range : find_ranges(report.tiles[z])) {
      ranges.push_back({{"startX", range.x}, {"startY", range.y}, {"endX", range.end_x}, {"endY", range.end_y}});
    }
    available.push_back(std::move(ranges));
    io::Json level{{"geometric_error", plan.levels[z].geometric_error},
                   {"max_error", plan.levels[z].max_error},
                   {"quantum", plan.levels[z].quantum},
                   {"tiles", report.tiles[z].size()}};
    if (!report.levels.empty()) {
      level["node_error"] = report.levels[z].node_error;
      level["bound"] = report.levels[z].bound;
      level["source_error"] = report.levels[z].source_error;
      if (plan.max_tile_bytes > 0) {
        level["tiles_coarser"] = report.levels[z].coarser;
        level["tiles_oversized"] = report.levels[z].oversized;
      }
    }
    levels.push_back(std::move(level));
  }
  layer["available"] = std::move(available);
  layer["scarp"] = io::Json{{"generator", std::string("scarp ") + version()},
                            {"heights_above", facts.heights_above},
                            {"ellipsoid", {plan.ellipsoid.semi_major, semi_minor(plan.ellipsoid)}},
                            {"cells", plan.cells},
                            {"background", plan.background},
                            {"levels", std::move(levels)}};
  if (!facts.vertical.empty()) layer["scarp"]["vertical"] = facts.vertical;
  const std::string text = layer.dump(1) + "\n";
  return {text.begin(), text.end()};
}

}  // namespace scarp
