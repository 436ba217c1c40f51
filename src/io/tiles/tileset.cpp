// tileset.json and subtrees: https://github.com/CesiumGS/3d-tiles, version 1.1, implicit tiling.
#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <cstring>
#include <set>
#include <utility>

#include "io/mesh/file_bytes.h"
#include "io/mesh/glb_json.h"
#include "io/tiles/grid_json.h"
#include "io/tiles3d.h"
#include "scarp/version.h"

namespace scarp::io {
namespace {

constexpr double kPi = 3.141592653589793;
/// Levels of a subtree: 341 tiles.
constexpr int kSubtreeLevels = 5;
constexpr const char* kClass = "tile";
constexpr const char* kSphere = "TILE_BOUNDING_SPHERE";

/// The index of a tile in its level of a subtree: the interleaved bits of x and y, x first.
std::uint32_t interleave(std::uint32_t x, std::uint32_t y) {
  std::uint32_t code = 0;
  for (int bit = 0; bit < kSubtreeLevels; ++bit)
    code |= ((x >> bit) & 1) << (2 * bit) | ((y >> bit) & 1) << (2 * bit + 1);
  return code;
}

/// A bit array, lowest bit of each byte first.
class Bits {
 public:
  explicit Bits(std::size_t size) : bytes_((size + 7) / 8) {}
  void set(std::size_t at) {
    bytes_[at / 8] |= static_cast<std::uint8_t>(1 << (at % 8));
    ++count_;
  }
  std::size_t count() const { return count_; }
  const std::vector<std::uint8_t>& bytes() const { return bytes_; }

 private:
  std::vector<std::uint8_t> bytes_;
  std::size_t count_ = 0;
};

/// A binary chunk whose views start at multiples of 8.
class Views {
 public:
  std::size_t add(const std::vector<std::uint8_t>& bytes) {
    views_.push_back({{"buffer", 0}, {"byteOffset", bytes_.size()}, {"byteLength", bytes.size()}});
    bytes_.insert(bytes_.end(), bytes.begin(), bytes.end());
    bytes_.resize((bytes_.size() + 7) / 8 * 8);
    return views_.size() - 1;
  }
  std::size_t add_numbers(const std::vector<double>& numbers) {
    std::vector<std::uint8_t> bytes(8 * numbers.size());
    std::uint8_t* at = bytes.data();
    for (const double number : numbers) store_number(at, number);
    return add(bytes);
  }
  const Json& json() const { return views_; }
  const std::vector<std::uint8_t>& bytes() const { return bytes_; }

 private:
  Json views_ = Json::array();
  std::vector<std::uint8_t> bytes_;
};

std::vector<std::uint8_t> join_subtree(std::string json, const std::vector<std::uint8_t>& binary) {
  json.resize((json.size() + 7) / 8 * 8, ' ');
  std::vector<std::uint8_t> bytes(24 + json.size() + binary.size());
  std::uint8_t* at = bytes.data();
  store_number(at, std::uint32_t{0x74627573});
  store_number(at, std::uint32_t{1});
  store_number(at, std::uint64_t{json.size()});
  store_number(at, std::uint64_t{binary.size()});
  std::memcpy(at, json.data(), json.size());
  if (!binary.empty()) std::memcpy(at + json.size(), binary.data(), binary.size());
  return bytes;
}

/// The subtree below a tile: its existing tiles, and their facts.
std::vector<std::uint8_t> encode_subtree(TileId root, const FactsByTile& tiles, bool is_flat) {
  constexpr std::size_t kTiles = ((std::size_t{1} << (2 * kSubtreeLevels)) - 1) / 3;
  constexpr std::size_t kChildren = std::size_t{1} << (2 * kSubtreeLevels);
  Bits there(kTiles), below(kChildren);
  std::vector<double> lows, highs, spheres, horizons;
  std::vector<std::pair<std::uint32_t, const TileFacts*>> row;
  std::size_t first = 0;
  for (int depth = 0; depth <= kSubtreeLevels; ++depth) {
    const int z = root.z + depth;
    const std::uint32_t side = std::uint32_t{1} << depth, west = root.x << depth, south = root.y << depth;
    row.clear();
    for (std::uint32_t y = 0; y < side; ++y) {
      const auto end = tiles.lower_bound({z, south + y, west + side});
      for (auto tile = tiles.lower_bound({z, south + y, west}); tile != end; ++tile)
        row.emplace_back(interleave(std::get<2>(tile->first) - west, y), &tile->second);
    }
    std::sort(row.begin(), row.end());
    for (const auto& [place, facts] : row) {
      if (depth == kSubtreeLevels) {
        below.set(place);
        continue;
      }
      there.set(first + place);
      lows.push_back(facts->min_height);
      highs.push_back(facts->max_height);
      spheres.insert(spheres.end(), facts->sphere.begin(), facts->sphere.end());
      horizons.insert(horizons.end(), facts->horizon_point.begin(), facts->horizon_point.end());
    }
    first += std::size_t{1} << (2 * depth);
  }
  Views views;
  const auto bits = [&](const Bits& which) {
    if (which.count() == 0) return Json{{"constant", 0}};
    return Json{{"bitstream", views.add(which.bytes())}, {"availableCount", which.count()}};
  };
  Json json;
  const Json available = bits(there);
  json["tileAvailability"] = available;
  json["contentAvailability"] = Json::array({available});
  json["childSubtreeAvailability"] = bits(below);
  Json properties = {{"min_height", {{"values", views.add_numbers(lows)}}},
                     {"max_height", {{"values", views.add_numbers(highs)}}},
                     {"sphere", {{"values", views.add_numbers(spheres)}}}};
  if (!is_flat) properties["horizon_point"] = {{"values", views.add_numbers(horizons)}};
  json["propertyTables"] =
      Json::array({{{"class", kClass}, {"count", there.count()}, {"properties", std::move(properties)}}});
  json["tileMetadata"] = 0;
  json["buffers"] = Json::array({{{"byteLength", views.bytes().size()}}});
  json["bufferViews"] = views.json();
  return join_subtree(print_json(json), views.bytes());
}

std::string content_name(std::uint32_t root) { return fmt::format("{}/{{level}}/{{x}}/{{y}}.glb", root); }
std::string subtree_name(std::uint32_t root) { return fmt::format("subtrees/{}/{{level}}/{{x}}/{{y}}.subtree", root); }

/// The semantics of heights above the ellipsoid do not apply to a local grid.
Json describe_classes(bool is_flat) {
  const auto number = [&](const char* type, const char* semantic) {
    Json json{{"type", type}, {"componentType", "FLOAT64"}, {"required", true}};
    if (!is_flat || std::string_view(semantic) == kSphere) json["semantic"] = semantic;
    return json;
  };
  Json sphere = number("SCALAR", kSphere);
  sphere["array"] = true;
  sphere["count"] = 4;
  Json properties = {{"min_height", number("SCALAR", "TILE_MINIMUM_HEIGHT")},
                     {"max_height", number("SCALAR", "TILE_MAXIMUM_HEIGHT")},
                     {"sphere", std::move(sphere)}};
  if (!is_flat) properties["horizon_point"] = number("VEC3", "TILE_HORIZON_OCCLUSION_POINT");
  return {{"id", "terrain"}, {"classes", {{kClass, {{"properties", properties}}}}}};
}

Json describe_root(std::uint32_t root, Json volume, double error, const PyramidPlan& plan) {
  return {{"boundingVolume", std::move(volume)},
          {"geometricError", error},
          {"refine", "REPLACE"},
          {"content", {{"uri", content_name(root)}}},
          {"implicitTiling",
           {{"subdivisionScheme", "QUADTREE"},
            {"subtreeLevels", kSubtreeLevels},
            {"availableLevels", plan.max_zoom() + 1},
            {"subtrees", {{"uri", subtree_name(root)}}}}}};
}

/// The box of a local grid: its square, as high as its tiles.
Json describe_square(const PyramidPlan& plan, double low, double high) {
  const LocalRaster& raster = plan.grid.local;
  const double half = static_cast<double>(raster.side) / 2, east = half * raster.cell_x, north = half * raster.cell_y;
  const double x = east - static_cast<double>(raster.centre_col()) * raster.cell_x,
               y = north - static_cast<double>(raster.centre_row()) * raster.cell_y;
  return {{"box", {x, y, (low + high) / 2, east, 0, 0, 0, north, 0, 0, 0, (high - low) / 2}}};
}

void describe_plane(const PyramidPlan& plan, const LayerFacts& facts, Json& scarp) {
  if (!facts.plane) scarp.erase("ellipsoid");
  scarp["grid"] = describe_grid(plan.grid);
  scarp["units"] = {{"horizontal", facts.units}, {"vertical", "metre"}};
  if (!facts.plane) return;
  const PlaneOnGlobe& plane = *facts.plane;
  scarp["crs"] = plane.crs;
  scarp["convergence"] = plane.convergence;
  scarp["scale"] = {plane.scale_x, plane.scale_y};
  scarp["off_globe"] = {{"along", plane.off_along}, {"height", plane.off_height}};
}

std::vector<std::uint8_t> encode_tileset_json(const PyramidPlan& plan, const PyramidReport& report,
                                              const FactsByTile& tiles, const LayerFacts& facts) {
  const bool is_flat = plan.grid.is_flat();
  double low = is_flat ? INFINITY : 0, high = is_flat ? -INFINITY : 0, root_error = 0;
  for (const auto& [id, tile] : tiles) {
    low = std::min(low, tile.min_height);
    high = std::max(high, tile.max_height);
  }
  Json levels = Json::array();
  for (std::size_t z = 0; z < report.levels.size(); ++z) {
    const double bound = report.levels[z].bound + lattice_error(plan, static_cast<int>(z));
    root_error = std::max(root_error, std::ldexp(bound, static_cast<int>(z)));
    Json level{
        {"max_error", plan.levels[z].max_error},         {"lattice_step", lattice_steps(plan, static_cast<int>(z))[2]},
        {"node_error", report.levels[z].node_error},     {"bound", bound},
        {"source_error", report.levels[z].source_error}, {"tiles", report.levels[z].tiles}};
    if (plan.max_tile_bytes > 0) {
      level["tiles_coarser"] = report.levels[z].coarser;
      level["tiles_oversized"] = report.levels[z].oversized;
    }
    levels.push_back(std::move(level));
  }
  const auto region = [&](double west, double east) {
    return Json{{"region", {west, -kPi / 2, east, kPi / 2, low, high}}};
  };
  const double a = plan.ellipsoid.semi_major, b = semi_minor(plan.ellipsoid);
  Json asset = {{"version", "1.1"}};
  if (!facts.version.empty()) asset["tilesetVersion"] = facts.version;
  if (!facts.attribution.empty()) asset["copyright"] = facts.attribution;
  asset["extras"]["scarp"] = {
      {"generator", std::string("scarp ") + version()},
      {"maximumScreenSpaceError", 2},
      {"heights_above", facts.heights_above},
      {"ellipsoid", {a, b}},
      {"cells", plan.cells},
      {"background", plan.background},
      {"bounds", {plan.covered.west, plan.covered.south, plan.covered.east, plan.covered.north}},
      {"levels", std::move(levels)}};
  if (!facts.vertical.empty()) asset["extras"]["scarp"]["vertical"] = facts.vertical;
  // The error of drawing nothing: the size of the planet, or of the plane.
  const double nothing = std::max(is_flat ? plan.grid.tile_width(0, a) : a, 2 * root_error);
  Json root;
  if (is_flat) {
    describe_plane(plan, facts, asset["extras"]["scarp"]);
    root = describe_root(0, describe_square(plan, low, high), root_error, plan);
    if (facts.plane) root["transform"] = facts.plane->transform;
  } else {
    root = {
        {"boundingVolume", region(-kPi, kPi)},
        {"geometricError", nothing},  // without triangles
        {"refine", "REPLACE"},
        {"children",
         {describe_root(0, region(-kPi, 0), root_error, plan), describe_root(1, region(0, kPi), root_error, plan)}}};
  }
  Json tileset = {{"asset", std::move(asset)},
                  {"schema", describe_classes(is_flat)},
                  {"geometricError", nothing},
                  {"root", std::move(root)}};
  if (!facts.body.empty()) {
    tileset["extensionsUsed"] = {"3DTILES_ellipsoid"};
    tileset["extensions"]["3DTILES_ellipsoid"] = {{"body", facts.body}, {"radii", {a, a, b}}};
  }
  const std::string text = tileset.dump(1) + "\n";
  return {text.begin(), text.end()};
}

}  // namespace

std::vector<NamedFile> encode_tileset(const PyramidPlan& plan, const PyramidReport& report, const FactsByTile& tiles,
                                      const LayerFacts& facts) {
  std::vector<NamedFile> files;
  files.push_back({"tileset.json", encode_tileset_json(plan, report, tiles, facts)});
  for (const auto& [key, tile] : tiles) {
    const auto& [z, y, x] = key;
    if (z % kSubtreeLevels != 0) continue;
    const std::uint32_t root = x >> z;
    files.push_back({fmt::format("subtrees/{}/{}/{}/{}.subtree", root, z, x - (root << z), y),
                     encode_subtree({z, x, y}, tiles, plan.grid.is_flat())});
  }
  return files;
}

}  // namespace scarp::io
