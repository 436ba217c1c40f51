// Laws of the check of sets: a good set passes with every node, and each planted fault is found with the name of its
// tile.
#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdint>
#include <cstring>
#include <functional>
#include <limits>
#include <map>
#include <memory>
#include <string>
#include <tuple>
#include <vector>

#include "io/gzip.h"
#include "io/tiles3d.h"
#include "laws/sanitized.h"
#include "scarp/io.h"
#include "scarp/tile.h"
#include "scarp/tile_job.h"
#include "scarp/tile_set.h"

namespace scarp::tile_check_laws_test {
namespace {

using Bytes = std::vector<std::uint8_t>;
using Key = std::tuple<int, std::uint32_t, std::uint32_t>;

/// A set in memory.
class Shelf final : public TileSetReader, public TileSetWriter {
 public:
  explicit Shelf(TileFormat format) : format_(format) {}

  Result<void> put_tile(TileId id, std::span<const std::uint8_t> bytes) override {
    const auto z = static_cast<std::size_t>(id.z);
    if (levels_.size() <= z) levels_.resize(z + 1);
    const std::uint64_t place = std::uint64_t{id.y} << 32 | id.x;
    levels_[z].insert(std::lower_bound(levels_[z].begin(), levels_[z].end(), place), place);
    held[{id.z, id.x, id.y}].assign(bytes.begin(), bytes.end());
    return {};
  }
  Result<void> put_file(const std::string& name, std::span<const std::uint8_t> bytes) override {
    texts[name].assign(bytes.begin(), bytes.end());
    return {};
  }
  Result<void> finish() override { return {}; }
  void drop(TileId id) { std::erase(levels_[static_cast<std::size_t>(id.z)], std::uint64_t{id.y} << 32 | id.x); }

  TileFormat format() const override { return format_; }
  const std::vector<std::vector<std::uint64_t>>& tiles() const override { return levels_; }
  std::vector<std::string> files() const override {
    std::vector<std::string> names;
    for (const auto& [name, text] : texts) names.push_back(name);
    return names;
  }
  Result<Bytes> read_tile(TileId id) const override { return held.at({id.z, id.x, id.y}); }
  Result<Bytes> read_file(const std::string& name) const override { return texts.at(name); }

  std::map<Key, Bytes> held;
  std::map<std::string, Bytes> texts;

 private:
  TileFormat format_;
  std::vector<std::vector<std::uint64_t>> levels_;
};

/// Waves, noise, cliffs and voids in a box of degrees, possibly across the antimeridian.
class Land final : public NodeSource {
 public:
  Land(DegreeBox box, double relief, double noise, bool has_voids)
      : box_(box), relief_(relief), noise_(noise), has_voids_(has_voids) {}

  Result<void> read(const NodeWindow& window, std::span<float> out) const override {
    std::size_t k = 0;
    for (std::int64_t row = window.row; row < window.row + window.rows; ++row) {
      for (std::int64_t col = window.col; col < window.col + window.cols; ++col)
        out[k++] = at(window.is_pole(row) ? 0 : window.longitude(col), window.latitude(row), window.is_pole(row));
    }
    return {};
  }

 private:
  float at(double longitude, double latitude, bool is_pole) const {
    if (longitude < box_.west - 1e-9) longitude += 360;
    const bool is_beside = longitude > box_.east + 1e-9 && !is_pole;
    if (is_beside || latitude < box_.south - 1e-9 || latitude > box_.north + 1e-9) return NAN;
    const double noise = std::fmod(std::abs(std::sin(longitude * 12.9898 + latitude * 78.233) * 43758.5453), 1.0);
    if (has_voids_ && noise > 0.97) return NAN;
    const double step = std::fmod(longitude * 3 + latitude + 1e4, 2.0) < 0.3 ? relief_ / 4 : 0;
    return static_cast<float>(relief_ * (0.5 + 0.4 * std::sin(longitude) * std::cos(latitude * 1.3)) + step +
                              noise_ * noise);
  }

  DegreeBox box_;
  double relief_, noise_;
  bool has_voids_;
};

struct Made {
  Made(TileFormat format, DegreeBox box, double relief, double noise, bool has_voids, Effort effort, int finest = 6,
       const TileGrid& grid = {})
      : land(box, relief, noise, has_voids), shelf(format) {
    PyramidSettings settings;
    settings.cells = 16;
    settings.max_zoom = finest;
    settings.effort = effort;
    settings.has_siblings = format == TileFormat::kGlb;
    settings.background = 12.5f;
    settings.grid = grid;
    plan = *plan_pyramid({box, 1, 0, 1.5 * relief + noise}, settings);
    const auto sink = make_tile_sink(format, shelf, plan);
    auto report = make_pyramid(plan, land, *sink);
    EXPECT_TRUE(report) << report.error().message;
    EXPECT_TRUE(sink->put_files(*report, {}));
    options.nodes.source = &land;
    options.nodes.covered = box;
  }

  TileCheck check(int threads = 2) const {
    TileCheckOptions chosen = options;
    chosen.run.threads = threads;
    auto checked = check_tiles(shelf, chosen);
    EXPECT_TRUE(checked) << checked.error().message;
    return *checked;
  }
  /// A tile of the finest level with heights and neighbours.
  TileId inner_tile() const {
    const auto& finest = shelf.tiles().back();
    const std::uint64_t place = finest[finest.size() / 2];
    return {plan.max_zoom(), static_cast<std::uint32_t>(place), static_cast<std::uint32_t>(place >> 32)};
  }
  Bytes& bytes_of(TileId id) { return shelf.held.at({id.z, id.x, id.y}); }

  Land land;
  Shelf shelf;
  PyramidPlan plan;
  TileCheckOptions options;
};

std::string described(const TileCheck& check) {
  std::string text;
  for (const TileFault& fault : check.described)
    text += std::string(name_of(fault.kind)) + ": " + fault.sentence + "\n";
  return text;
}

const DegreeBox kIsland{10.3, 34.1, 31.9, 50.2}, kAcross{171.2, -20, 187.7, -8}, kPolar{-180, 71, 180, 90};
constexpr TileGrid kMercator{GridKind::kMercator};

struct Compared {
  std::uint64_t edges = 0, nodes = 0;
};

Compared expect_made_well(TileFormat format, const TileGrid& grid = {}) {
  Compared compared;
  for (const DegreeBox& box : {kIsland, kAcross, kPolar}) {
    const bool is_usual = format == TileFormat::kQuantizedMesh && grid.roots() == 2;
    if (testing::kIsSanitized && (box.west == kAcross.west || (!is_usual && box.west == kPolar.west))) continue;
    const bool is_high = box.west == kIsland.west && !testing::kIsSanitized;
    const Effort effort = is_high ? Effort::kHigh : Effort::kNormal;
    // Tiles of the same size on either grid.
    const int finest = (box.north == 90 ? 5 : 6) + (grid.roots() == 1);
    const Made made(format, box, 900, 40, true, effort, finest, grid);
    const TileCheck check = made.check();
    EXPECT_TRUE(check.holds()) << described(check);
    EXPECT_GT(check.levels.back().edges, 20u);
    for (const CheckedLevel& level : check.levels) {
      compared.edges += level.edges;
      EXPECT_TRUE(level.promised_bound && level.distance);
      // Errors reach the guaranteed ones somewhere, so nodes were really checked.
      if (format == TileFormat::kQuantizedMesh && &level == &check.levels.back()) {
        EXPECT_NEAR(level.node_error.value_or(-1), level.promised_node_error.value_or(-2), 1e-6);
      }
    }
    compared.nodes += check.nodes;
  }
  return compared;
}

TEST(tile_check, sets_that_were_made_well_hold_at_every_node) {
  const Compared terrain = expect_made_well(TileFormat::kQuantizedMesh), glb = expect_made_well(TileFormat::kGlb);
  EXPECT_GT(terrain.edges + glb.edges, testing::kIsSanitized ? 100u : 400u);
  EXPECT_GT(terrain.nodes + glb.nodes, testing::kIsSanitized ? 250'000u : 1'000'000u);
}

TEST(tile_check, sets_of_mercator_that_were_made_well_hold_at_every_node) {
  const Compared web = expect_made_well(TileFormat::kQuantizedMesh, kMercator);
  EXPECT_GT(web.edges, testing::kIsSanitized ? 50u : 200u);
  EXPECT_GT(web.nodes, testing::kIsSanitized ? 125'000u : 500'000u);
}

TEST(tile_check, threads_change_nothing) {
  const Made made(TileFormat::kQuantizedMesh, kIsland, 900, 40, true, Effort::kFast);
  const TileCheck one = made.check(1), three = made.check(3);
  EXPECT_EQ(one.nodes, three.nodes);
  EXPECT_EQ(one.faults, three.faults);
  for (std::size_t z = 0; z < one.levels.size(); ++z) {
    EXPECT_EQ(one.levels[z].edges, three.levels[z].edges);
    EXPECT_EQ(one.levels[z].distance, three.levels[z].distance);
    EXPECT_EQ(one.levels[z].node_error, three.levels[z].node_error);
    EXPECT_EQ(one.levels[z].sag, three.levels[z].sag);
  }
}

/// Changes a tile of quantized-mesh: unpacks and repacks it.
void change(Bytes& tile, const std::function<void(Bytes&)>& how) {
  Bytes bytes = *io::decompress_gzip(tile, 1 << 24);
  how(bytes);
  tile = *io::compress_gzip(bytes);
}

template <class T>
void put_number(Bytes& bytes, std::size_t at, T value) {
  std::memcpy(bytes.data() + at, &value, sizeof value);
}
template <class T>
T number_at(const Bytes& bytes, std::size_t at) {
  T value;
  std::memcpy(&value, bytes.data() + at, sizeof value);
  return value;
}

// Offsets in quantized-mesh.
constexpr std::size_t kCentre = 0, kLow = 24, kHigh = 28, kRadius = 56, kHorizonAt = 64, kCount = 88, kVertices = 92;

struct Planted {
  const char* what;
  TileFaultKind kind;
  std::function<void(Bytes&)> how;
};

std::size_t indices_at(const Bytes& bytes) { return kVertices + 6 * number_at<std::uint32_t>(bytes, kCount) + 4; }
std::size_t edges_at(const Bytes& bytes) {
  return indices_at(bytes) + 6 * number_at<std::uint32_t>(bytes, indices_at(bytes) - 4);
}

/// Lifts a vertex that is on no edge by `steps` steps.
void lift_inner_vertex(Bytes& bytes, int steps) {
  const auto mesh = *decode_quantized_mesh(bytes, "tile");
  for (std::size_t v = 0; v + 1 < mesh.u.size(); ++v) {
    const auto is_inner = [](std::uint16_t place) { return place > 0 && place < 32767; };
    if (!is_inner(mesh.u[v]) || !is_inner(mesh.v[v]) || mesh.h[v] < steps) continue;
    const std::size_t h = kVertices + 4 * mesh.u.size();
    std::int32_t before = 0;
    for (std::size_t k = 0; k < mesh.h.size(); ++k) {
      const std::int32_t height = mesh.h[k] - (k == v ? steps : 0), delta = height - before;
      put_number(bytes, h + 2 * k, static_cast<std::uint16_t>((delta << 1) ^ (delta >> 31)));
      before = height;
    }
    return;
  }
  FAIL() << "no vertex to lift";
}

const Planted kPlanted[] = {
    {"another range", TileFaultKind::kBorder,
     [](Bytes& b) {
       put_number(b, kLow, number_at<float>(b, kLow) + 1);
       put_number(b, kHigh, number_at<float>(b, kHigh) + 1);
     }},
    {"other normals", TileFaultKind::kBorder,
     [](Bytes& b) {
       const auto mesh = *decode_quantized_mesh(b, "tile");
       for (std::size_t at = b.size() - 2 * mesh.u.size(); at < b.size(); ++at) b[at] ^= 64;
     }},
    {"a range upside down", TileFaultKind::kHeader,
     [](Bytes& b) { put_number(b, kLow, number_at<float>(b, kHigh) + 1); }},
    {"a small sphere", TileFaultKind::kHeader,
     [](Bytes& b) { put_number(b, kRadius, 0.99 * number_at<double>(b, kRadius)); }},
    {"a huge sphere", TileFaultKind::kHeader,
     [](Bytes& b) { put_number(b, kRadius, 50 * number_at<double>(b, kRadius)); }},
    {"a centre elsewhere", TileFaultKind::kHeader,
     [](Bytes& b) { put_number(b, kCentre, -number_at<double>(b, kCentre)); }},
    {"a horizon point too low", TileFaultKind::kHorizon,
     [](Bytes& b) {
       for (std::size_t k = 0; k < 3; ++k)
         put_number(b, kHorizonAt + 8 * k, 0.9999 * number_at<double>(b, kHorizonAt + 8 * k));
     }},
    {"a triangle turned over", TileFaultKind::kCoverage,
     [](Bytes& b) {
       // The second triangle, which adds only one corner.
       const std::size_t at = indices_at(b);
       const auto mesh = *decode_quantized_mesh(b, "tile");
       std::vector<std::uint32_t> corners = mesh.triangles;
       std::swap(corners[corners.size() - 1], corners[corners.size() - 2]);
       std::uint32_t highest = 0;
       for (std::size_t k = 0; k < corners.size(); ++k) {
         put_number(b, at + 2 * k, static_cast<std::uint16_t>(highest - corners[k]));
         if (corners[k] == highest) ++highest;
       }
     }},
    {"an edge list that is wrong", TileFaultKind::kEdgeList,
     [](Bytes& b) {
       const auto mesh = *decode_quantized_mesh(b, "tile");
       const std::size_t at = edges_at(b) + 4;
       const auto inner = std::find_if(mesh.u.begin(), mesh.u.end(), [](std::uint16_t u) { return u > 0; });
       put_number(b, at, static_cast<std::uint16_t>(inner - mesh.u.begin()));
     }},
    {"cut off", TileFaultKind::kFile, [](Bytes& b) { b.resize(b.size() / 2); }},
    {"a vertex in the air", TileFaultKind::kBound, [](Bytes& b) { lift_inner_vertex(b, 16000); }},
};

void expect_finds_planted(const TileGrid& grid) {
  const Made good(TileFormat::kQuantizedMesh, kIsland, 900, 40, false, Effort::kNormal, 6, grid);
  ASSERT_TRUE(good.check().holds());
  const TileId id = good.inner_tile();
  const std::string name = tile_name(TileFormat::kQuantizedMesh, id);
  // Under sanitizers all faults once: the bytes of the tiles of both grids are read alike.
  const std::size_t step = testing::kIsSanitized && grid.roots() == 1 ? 3 : 1;
  for (std::size_t k = 0; k < std::size(kPlanted); k += step) {
    const Planted& fault = kPlanted[k];
    Made made = good;
    made.options.nodes.source = &made.land;
    change(made.bytes_of(id), fault.how);
    const TileCheck check = made.check();
    EXPECT_GT(check.faults[static_cast<std::size_t>(fault.kind)], 0u) << fault.what << "\n" << described(check);
    EXPECT_NE(described(check).find(name), std::string::npos) << fault.what << "\n" << described(check);
  }
}

TEST(tile_check, finds_what_is_planted_in_a_tile) { expect_finds_planted({}); }
TEST(tile_check, finds_what_is_planted_in_a_tile_of_mercator) { expect_finds_planted(kMercator); }

TEST(tile_check, finds_a_set_whose_projection_is_not_that_of_its_tiles) {
  Made made(TileFormat::kQuantizedMesh, kIsland, 900, 40, false, Effort::kFast, 5, kMercator);
  made.options.nodes.source = nullptr;
  Bytes& layer = made.shelf.texts.at("layer.json");
  std::string text(layer.begin(), layer.end());
  text.replace(text.find("EPSG:3857"), 9, "EPSG:4326");
  layer.assign(text.begin(), text.end());
  const TileCheck check = made.check();
  // Vertices lie outside their spheres, and a root is missing.
  EXPECT_GT(check.faults[static_cast<std::size_t>(TileFaultKind::kHeader)], 0u) << described(check);
  EXPECT_GT(check.faults[static_cast<std::size_t>(TileFaultKind::kAvailability)], 0u) << described(check);
  made.options.grid = kMercator;
  EXPECT_TRUE(made.check().holds()) << described(made.check());
}

TEST(tile_check, finds_tiles_that_are_missing_or_not_announced_or_packed_otherwise) {
  const Made good(TileFormat::kQuantizedMesh, kIsland, 900, 40, false, Effort::kFast);
  const TileId id = good.inner_tile();
  const auto expect = [](const Made& made, TileFaultKind kind, const std::string& words) {
    TileCheckOptions options;
    options.most_faults = 10;
    const auto check = check_tiles(made.shelf, options);
    ASSERT_TRUE(check);
    EXPECT_GT(check->faults[static_cast<std::size_t>(kind)], 0u) << words;
    EXPECT_NE(described(*check).find(words), std::string::npos) << words << "\n" << described(*check);
  };
  Made made = good;
  made.shelf.drop(id);
  expect(made, TileFaultKind::kAvailability, tile_name(TileFormat::kQuantizedMesh, id) + " is announced, but missing");
  made = good;
  made.shelf.drop({id.z - 1, id.x / 2, id.y / 2});
  expect(made, TileFaultKind::kAvailability,
         tile_name(TileFormat::kQuantizedMesh, id) + " is there without its parent");
  made = good;
  made.shelf.drop({0, 1, 0});
  expect(made, TileFaultKind::kAvailability, "0/1/0.terrain is missing");
  made = good;
  ASSERT_TRUE(made.shelf.put_tile({id.z, 1, 1}, made.bytes_of(id)));
  expect(made, TileFaultKind::kAvailability, "6/1/1.terrain is there, but not announced");
  made = good;
  made.shelf.texts.erase("layer.json");
  expect(made, TileFaultKind::kAvailability, "layer.json is missing");
  made = good;
  made.bytes_of(id) = *io::decompress_gzip(made.bytes_of(id), 1 << 24);
  expect(made, TileFaultKind::kContainer, tile_name(TileFormat::kQuantizedMesh, id) + " is not in gzip");
}

TEST(tile_check, finds_what_is_planted_in_3d_tiles) {
  const Made good(TileFormat::kGlb, kIsland, 900, 40, false, Effort::kNormal, 5);
  ASSERT_TRUE(good.check().holds()) << described(good.check());
  const TileId id = good.inner_tile();
  const std::string name = tile_name(TileFormat::kGlb, id);
  const auto expect = [](const Made& made, TileFaultKind kind, const std::string& words) {
    const TileCheck check = made.check();
    EXPECT_GT(check.faults[static_cast<std::size_t>(kind)], 0u) << words << "\n" << described(check);
    EXPECT_NE(described(check).find(words), std::string::npos) << words << "\n" << described(check);
  };
  Made made = good;
  made.options.nodes.source = nullptr;
  made.shelf.drop(id);
  expect(made, TileFaultKind::kAvailability, name);
  // A subtree's bits and numbers.
  made = good;
  made.options.nodes.source = nullptr;
  Bytes& subtree = made.shelf.texts.at("subtrees/1/0/0/0.subtree");
  const std::size_t binary = 24 + number_at<std::uint64_t>(subtree, 8);
  subtree[binary] ^= 2;
  expect(made, TileFaultKind::kAvailability, "subtrees/1/0/0/0.subtree is missing, damaged, or is not of 5 levels");
  made = good;
  made.options.nodes.source = nullptr;
  const std::string text(made.shelf.texts.at("tileset.json").begin(), made.shelf.texts.at("tileset.json").end());
  std::string less = text;
  const std::size_t at = less.find("\"children\""), error = less.find("\"geometricError\": ", at) + 18;
  less.insert(error, "1e-9, \"before\": ");
  made.shelf.texts.at("tileset.json").assign(less.begin(), less.end());
  expect(made, TileFaultKind::kTileset, "clients take");
  // A tile from another place.
  made = good;
  const std::uint64_t first = made.shelf.tiles().back().front();
  made.bytes_of(id) = made.bytes_of({id.z, static_cast<std::uint32_t>(first), static_cast<std::uint32_t>(first >> 32)});
  expect(made, TileFaultKind::kBorder, name);
  expect(made, TileFaultKind::kHeader, name);
  made.bytes_of(id).resize(100);
  expect(made, TileFaultKind::kFile, name);
}

TEST(tile_check, finds_lists_of_edges_that_go_the_other_way_round) {
  const Made good(TileFormat::kGlb, kIsland, 900, 40, false, Effort::kFast, 5);
  ASSERT_TRUE(good.check().holds());
  const TileId id = good.inner_tile();
  const io::EarthTile placed = io::place_on_earth(*make_tile(good.plan, id, good.land), good.plan);
  for (const auto edge : {&io::EarthTile::west, &io::EarthTile::north, &io::EarthTile::east, &io::EarthTile::south}) {
    Made made = good;
    io::EarthTile turned = placed;
    std::reverse((turned.*edge).begin(), (turned.*edge).end());
    made.bytes_of(id) = *io::encode_tile_glb(turned);
    const TileCheck check = made.check();
    EXPECT_EQ(check.count(), 1u) << described(check);
    EXPECT_EQ(check.faults[static_cast<std::size_t>(TileFaultKind::kEdgeList)], 1u) << described(check);
    EXPECT_NE(described(check).find("does not go from"), std::string::npos) << described(check);
  }
}

TEST(tile_check, finds_skirts_that_hang_badly) {
  const Made good(TileFormat::kGlb, kIsland, 900, 40, false, Effort::kFast, 5);
  const TileId id = good.inner_tile();
  const io::EarthTile placed = io::place_on_earth(*make_tile(good.plan, id, good.land), good.plan);
  const auto expect = [&](const io::EarthTile& tile, const char* words) {
    Made made = good;
    made.bytes_of(id) = *io::encode_tile_glb(tile);
    const TileCheck check = made.check();
    EXPECT_EQ(check.count(), 1u) << described(check);
    EXPECT_NE(described(check).find(words), std::string::npos) << described(check);
  };
  io::EarthTile changed = placed;
  changed.feet[1][1] = changed.offsets[changed.north[1]];
  expect(changed, "does not hang down");
  changed = placed;
  changed.feet[2].pop_back();
  expect(changed, "leaves out a part of an edge");
  // Like tiles from other programs.
  changed = placed;
  changed.feet = {};
  Made made = good;
  made.bytes_of(id) = *io::encode_tile_glb(changed);
  EXPECT_TRUE(made.check().holds());
}

TEST(tile_check, skirts_hang_where_a_tile_is_beside_and_are_no_part_of_the_surface) {
  const Made made(TileFormat::kGlb, kPolar, 900, 40, false, Effort::kFast, 4);
  for (const TileId id : {TileId{4, 3, 15}, TileId{4, 0, 14}, TileId{0, 1, 0}}) {
    const Bytes& bytes = made.shelf.held.at({id.z, id.x, id.y});
    const auto tile = io::decode_tile_glb(bytes, "tile");
    ASSERT_TRUE(tile) << tile.error().message;
    const bool is_at_pole = id.y + 1 == 1u << id.z, has_both_poles = id.z == 0;
    std::size_t tops = tile->west.size() + tile->east.size();
    if (!has_both_poles) tops += tile->south.size() + (is_at_pole ? 0 : tile->north.size());
    EXPECT_EQ(tile->skirt.size(), 2 * tops);
    EXPECT_EQ(tile->skirt_triangles.size(), 6 * (tops - (has_both_poles ? 2 : is_at_pole ? 3 : 4)));
    const double depth = io::skirt_depth(made.plan, id.z);
    EXPECT_GE(depth, 5 * made.plan.levels[static_cast<std::size_t>(id.z)].max_error);
    for (std::size_t k = 0; k < tile->skirt.size(); k += 2) {
      const auto &top = tile->skirt[k], &foot = tile->skirt[k + 1];
      EXPECT_NEAR(std::hypot(top[0] - foot[0], top[1] - foot[1], top[2] - foot[2]), depth, 2 * tile->step);
    }
    const auto mesh = decode_mesh(bytes, "tile.glb");
    ASSERT_TRUE(mesh) << mesh.error().message;
    EXPECT_EQ(mesh->triangles.size(), tile->triangles.size());
  }
}

TEST(tile_check, a_tile_of_glb_is_read_as_it_was_placed) {
  const Made made(TileFormat::kGlb, kAcross, 4000, 300, false, Effort::kFast, 4);
  for (const auto& [key, bytes] : made.shelf.held) {
    const auto& [z, x, y] = key;
    if (z < made.plan.block_level) continue;
    const auto tile = make_tile(made.plan, {z, x, y}, made.land);
    ASSERT_TRUE(tile);
    const io::EarthTile placed = io::place_on_earth(*tile, made.plan);
    const auto read = io::decode_tile_glb(bytes, "tile");
    ASSERT_TRUE(read) << read.error().message;
    std::vector<std::array<double, 3>> want, have = read->positions;
    for (const auto& offset : placed.offsets) {
      std::array<double, 3> at{};
      for (std::size_t k = 0; k < 3; ++k)
        at[k] = placed.steps[k] * static_cast<double>(placed.origin[k] + std::int64_t{offset[k]});
      want.push_back(at);
    }
    std::sort(want.begin(), want.end());
    std::sort(have.begin(), have.end());
    EXPECT_EQ(want, have);
    EXPECT_EQ(read->triangles.size(), placed.triangles.size());
    EXPECT_EQ(read->west.size(), placed.west.size());
    EXPECT_EQ(read->north.back(), read->east.front());
    EXPECT_EQ(read->facts, placed.facts);
  }
}

}  // namespace
}  // namespace scarp::tile_check_laws_test
