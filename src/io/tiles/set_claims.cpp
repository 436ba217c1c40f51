#include "io/tiles/set_claims.h"

#include <fmt/format.h>

#include <algorithm>
#include <limits>
#include <string_view>
#include <utility>

#include "io/tiles/grid_json.h"
#include "io/tiles/json_members.h"
#include "io/tiles/subtree_claims.h"

namespace scarp::io {
namespace {

std::optional<Json> read_json(const TileSetReader& set, const std::string& name, SetClaims& claims) {
  const std::vector<std::string> files = set.files();
  if (!std::binary_search(files.begin(), files.end(), name)) {
    claims.faults.push_back(fmt::format("{} is missing: clients ask for it first", name));
    return {};
  }
  const auto bytes = set.read_file(name);
  if (!bytes) {
    claims.faults.push_back(bytes.error().message);
    return {};
  }
  auto json = parse_json({reinterpret_cast<const char*>(bytes->data()), bytes->size()});
  if (json && json->is_object()) return json;
  claims.faults.push_back(fmt::format("{} is no JSON object", name));
  return {};
}

/// Reads Scarp's own metadata about levels and nodes.
void read_own(const Json* scarp, SetClaims& claims) {
  if (const auto cells = find_number(scarp, "cells"); cells && *cells >= 1 && *cells <= 65536)
    claims.cells = static_cast<int>(*cells);
  claims.background = find_number(scarp, "background");
  const Json* const axes = find_member(scarp, "ellipsoid");
  if (axes != nullptr && axes->is_array() && axes->size() == 2 && (*axes)[0].is_number() && (*axes)[1].is_number()) {
    const double a = (*axes)[0].get<double>(), b = (*axes)[1].get<double>();
    if (a >= 1 && a <= 1e9 && b > a / 2 && b <= a) {
      claims.ellipsoid.emplace();
      claims.ellipsoid->semi_major = a;
      claims.ellipsoid->inverse_flattening = a == b ? 0 : a / (a - b);
    }
  }
  if (const Json* const grid = find_member(scarp, "grid")) {
    const auto read = parse_grid(*grid);
    if (!read) claims.faults.emplace_back("the set names a grid that makes no sense");
    claims.grid = read.value_or(claims.grid);
  }
  const Json* const vertical = find_member(scarp, "vertical");
  if (vertical != nullptr && vertical->is_string()) claims.vertical = vertical->get<std::string>();
  const Json* const units = find_member(find_member(scarp, "units"), "horizontal");
  if (units != nullptr && units->is_string()) claims.units = units->get<std::string>();
  const Json* const levels = find_member(scarp, "levels");
  if (levels == nullptr || !levels->is_array()) return;
  for (const Json& level : *levels) {
    claims.node_errors.push_back(find_number(&level, "node_error"));
    claims.bounds.push_back(find_number(&level, "bound"));
    claims.source_errors.push_back(find_number(&level, "source_error"));
  }
}

std::optional<std::uint32_t> find_place(const Json& range, const char* key) {
  const auto count = find_count(&range, key);
  return count && *count < std::numeric_limits<std::uint32_t>::max() ? std::optional(static_cast<std::uint32_t>(*count))
                                                                     : std::nullopt;
}

void read_ranges(const Json& available, const TileGrid& grid, SetClaims& claims) {
  for (std::size_t z = 0; z < available.size(); ++z) {
    claims.levels.emplace_back();
    const auto refuse = [&] {
      claims.faults.push_back(
          fmt::format("layer.json announces tiles of level {} that make no sense or that the grid has not", z));
    };
    if (z > static_cast<std::size_t>(kMaxTileLevel) || !available[z].is_array()) {
      if (!available[z].empty()) refuse();
      continue;
    }
    for (const Json& range : available[z]) {
      const auto x = find_place(range, "startX"), y = find_place(range, "startY"), end_x = find_place(range, "endX"),
                 end_y = find_place(range, "endY");
      const int level = static_cast<int>(z);
      if (!x || !y || !end_x || !end_y || *x > *end_x || *y > *end_y || !grid.has({level, *end_x, *end_y})) {
        refuse();
      } else {
        claims.levels.back().push_back({*x, *y, *end_x, *end_y});
      }
    }
  }
}

void read_projection(const Json& layer, SetClaims& claims) {
  const Json* const projection = find_member(&layer, "projection");
  if (projection == nullptr) return;
  const auto grid = projection->is_string() ? TileGrid::find_projection(projection->get<std::string>()) : std::nullopt;
  if (!grid) claims.faults.push_back("layer.json names another projection than EPSG:4326 and EPSG:3857");
  claims.grid = grid.value_or(TileGrid{});
}

/// Checks the URL templates of tiles, without which clients stop.
void read_addresses(const Json& layer, SetClaims& claims) {
  const Json* const tiles = find_member(&layer, "tiles");
  const bool has_some = tiles != nullptr && tiles->is_array() && !tiles->empty();
  const auto names_files = [](const Json& one) {
    return one.is_string() && one.get<std::string>().find("{z}/{x}/{y}.terrain") != std::string::npos;
  };
  if (!has_some || !std::all_of(tiles->begin(), tiles->end(), names_files))
    claims.faults.push_back("layer.json does not name its files: its \"tiles\" need \"{z}/{x}/{y}.terrain\"");
  const Json* const scheme = find_member(&layer, "scheme");
  if (scheme != nullptr && *scheme != "tms")
    claims.faults.push_back("layer.json names another scheme than \"tms\", which counts y from the south");
}

const Json* find_own(const Json& tileset) {
  return find_member(find_member(find_member(&tileset, "asset"), "extras"), "scarp");
}

void read_layer(const TileSetReader& set, SetClaims& claims) {
  const auto layer = read_json(set, "layer.json", claims);
  if (!layer) {
    claims.announces_all = false;
    return;
  }
  const Json* const format = find_member(&*layer, "format");
  if (format == nullptr || *format != "quantized-mesh-1.0")
    claims.faults.push_back("layer.json does not name the format \"quantized-mesh-1.0\"");
  read_addresses(*layer, claims);
  read_projection(*layer, claims);
  const Json* const extensions = find_member(&*layer, "extensions");
  claims.has_water_mask = extensions != nullptr && extensions->is_array() &&
                          std::find(extensions->begin(), extensions->end(), "watermask") != extensions->end();
  const Json* const available = find_member(&*layer, "available");
  if (find_member(&*layer, "metadataAvailability") != nullptr) claims.announces_all = false;
  if (available != nullptr && available->is_array()) {
    read_ranges(*available, claims.grid, claims);
  } else {
    if (claims.announces_all) claims.faults.push_back("layer.json announces no tiles: it has no \"available\"");
    claims.announces_all = false;
  }
  read_own(find_member(&*layer, "scarp"), claims);
}

/// Empty unless it has exactly `count` numbers.
std::vector<double> find_numbers(const Json* object, const char* key, std::size_t count) {
  const Json* const found = find_member(object, key);
  if (found == nullptr || !found->is_array() || found->size() != count) return {};
  std::vector<double> numbers;
  for (const Json& one : *found) {
    if (!one.is_number()) return {};
    numbers.push_back(one.get<double>());
  }
  return numbers;
}

ClaimedRoot read_root(const Json& tile) {
  ClaimedRoot root;
  const Json* const volume = find_member(&tile, "boundingVolume");
  for (const auto& [name, count] : {std::pair{"region", 6}, std::pair{"box", 12}}) {
    std::vector<double> numbers = find_numbers(volume, name, static_cast<std::size_t>(count));
    if (numbers.empty()) continue;
    root.volume = name;
    root.numbers = std::move(numbers);
  }
  root.refine = find_text(&tile, "refine");
  root.geometric_error = find_number(&tile, "geometricError");
  root.has_transform = find_member(&tile, "transform") != nullptr;
  root.transform = find_numbers(&tile, "transform", 16);
  if (const Json* const tiling = find_member(&tile, "implicitTiling")) {
    root.is_implicit = true;
    root.levels = find_count(tiling, "availableLevels");
  }
  return root;
}

void read_roots(const Json& tileset, SetClaims& claims) {
  std::vector<const Json*> tiles;
  if (const Json* const root = find_member(&tileset, "root")) tiles.push_back(root);
  for (std::size_t k = 0; k < tiles.size(); ++k) {
    claims.roots.push_back(read_root(*tiles[k]));
    const Json* const children = find_member(tiles[k], "children");
    if (children == nullptr || !children->is_array()) continue;
    for (const Json& child : *children) tiles.push_back(&child);
  }
}

void read_tileset(const TileSetReader& set, SetClaims& claims) {
  const auto tileset = read_json(set, "tileset.json", claims);
  if (!tileset) {
    claims.announces_all = false;
    return;
  }
  read_own(find_own(*tileset), claims);
  read_subtrees(set, *tileset, claims);
  claims.geometric_error = find_number(&*tileset, "geometricError");
  read_roots(*tileset, claims);
  const Json* const off = find_member(find_own(*tileset), "off_globe");
  const auto along = find_number(off, "along"), height = find_number(off, "height");
  if (along && height) claims.off_globe = {*along, *height};
}

/// Reads the claims about the set as a whole.
SetClaims read_head(const TileSetReader& set) {
  SetClaims claims;
  const bool is_glb = set.format() == TileFormat::kGlb;
  const auto json = read_json(set, is_glb ? "tileset.json" : "layer.json", claims);
  if (json) read_own(is_glb ? find_own(*json) : find_member(&*json, "scarp"), claims);
  if (json && !is_glb) read_projection(*json, claims);
  return claims;
}

}  // namespace

}  // namespace scarp::io

namespace scarp {

TileGrid find_grid(const TileSetReader& set) { return io::read_head(set).grid; }

std::string find_vertical(const TileSetReader& set) { return io::read_head(set).vertical; }

io::SetClaims io::read_set_claims(const TileSetReader& set) {
  SetClaims claims;
  if (set.format() == TileFormat::kGlb) {
    read_tileset(set, claims);
  } else {
    read_layer(set, claims);
  }
  return claims;
}

}  // namespace scarp
