// Laws of 3D Tiles: neighbours share vertices exactly, bounds hold in space, and subtrees list the tiles.
#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdint>
#include <cstring>
#include <limits>
#include <map>
#include <set>
#include <tuple>
#include <vector>

#include "io/mesh/file_bytes.h"
#include "io/mesh/glb_json.h"
#include "io/mesh/meshopt_codec.h"
#include "io/tiles3d.h"
#include "jobs/tile_texture.h"
#include "laws/sanitized.h"
#include "scarp/tile.h"
#include "scarp/tile_job.h"

namespace scarp::tiles3d_laws_test {
namespace {

using Point = std::array<double, 3>;
using Key = std::tuple<int, std::uint32_t, std::uint32_t>;  // level, row, column

constexpr double kRadians = 3.14159265358979323846 / 180;

Point minus(const Point& a, const Point& b) { return {a[0] - b[0], a[1] - b[1], a[2] - b[2]}; }
double times(const Point& a, const Point& b) { return a[0] * b[0] + a[1] * b[1] + a[2] * b[2]; }
double length(const Point& a) { return std::sqrt(times(a, a)); }

/// Waves and steps with noise, around the globe or within a box.
class Land final : public NodeSource {
 public:
  explicit Land(DegreeBox covered, double relief = 900) : covered_(covered), relief_(relief) {}
  static DegreeBox degrees_at(std::int64_t per_turn, std::int64_t col, std::int64_t row) {
    col = ((col % per_turn) + per_turn) % per_turn;
    if (row == 0 || row == per_turn / 2) col = 0;
    const double lon = -180 + 360.0 * static_cast<double>(col) / static_cast<double>(per_turn);
    const double lat = 90 - 360.0 * static_cast<double>(row) / static_cast<double>(per_turn);
    return {lon, lat, lon, lat};
  }
  float at(std::int64_t per_turn, std::int64_t col, std::int64_t row) const {
    const auto [lon, lat, east, north] = degrees_at(per_turn, col, row);
    const bool is_inside =
        lon >= covered_.west && lon <= covered_.east && lat >= covered_.south && lat <= covered_.north;
    if (!is_inside) return std::numeric_limits<float>::quiet_NaN();
    const double wave = std::sin(lon * 0.9) * std::cos(lat * 1.3) + 0.3 * std::sin(lon * 17 + lat * 11);
    return static_cast<float>(relief_ * (wave / 2 + (std::fmod(lon * 53 + lat * 17 + 1e4, 7) < 0.4 ? 0.3 : 0)));
  }
  Result<void> read(const NodeWindow& window, std::span<float> out) const override {
    std::size_t k = 0;
    for (int j = 0; j < window.rows; ++j) {
      for (int i = 0; i < window.cols; ++i) out[k++] = at(window.per_turn, window.col + i, window.row + j);
    }
    return {};
  }

 private:
  DegreeBox covered_;
  double relief_;
};

/// A GLB tile as decoded by clients, rotated back to z up.
struct Decoded {
  std::vector<Point> positions;
  std::vector<std::array<float, 3>> normals;
  std::vector<std::array<double, 2>> places;  ///< in a texture, in pixels from its upper left corner
  std::vector<std::uint32_t> triangles, west, south, east, north;
};

class TileReader {
 public:
  explicit TileReader(const std::vector<std::uint8_t>& glb) {
    const std::size_t size = io::load_number<std::uint32_t>(glb.data() + 12);
    json_ = io::Json::parse(glb.begin() + 20, glb.begin() + 20 + static_cast<std::ptrdiff_t>(size));
    binary_ = std::span(glb).subspan(28 + size);
    EXPECT_EQ(io::load_number<std::uint32_t>(glb.data() + 8), glb.size());
  }
  const io::Json& json() const { return json_; }

  Decoded decode() {
    const io::Json& primitive = json_["meshes"][0]["primitives"][0];
    const io::Json& matrix = json_["nodes"][0]["matrix"];
    const double scale = matrix[0];
    EXPECT_EQ(scale, matrix[5]);
    EXPECT_EQ(scale, matrix[10]);
    Decoded tile;
    const io::Json& positions = json_["accessors"][primitive["attributes"]["POSITION"].get<std::size_t>()];
    const bool is_short = positions["componentType"] == 5123;
    const std::vector<std::uint8_t> items = bytes_of(positions);
    // The decoded value is number / 65535 times the scale, so the scale is 65535 steps.
    const double step = is_short ? scale / 65535 : scale;
    EXPECT_EQ(std::ldexp(1.0, std::ilogb(step)), step) << "no power of two";
    for (std::size_t v = 0; v < positions["count"]; ++v) {
      Point at{};
      for (std::size_t k = 0; k < 3; ++k) {
        const double number = is_short ? static_cast<double>(io::load_number<std::uint16_t>(&items[8 * v + 2 * k]))
                                       : static_cast<double>(io::load_number<float>(&items[12 * v + 4 * k]));
        EXPECT_GE(number, positions["min"][k].get<double>());
        EXPECT_LE(number, positions["max"][k].get<double>());
        at[k] = matrix[12 + k].get<double>() + step * number;
      }
      tile.positions.push_back({at[0], -at[2], at[1]});
    }
    const io::Json& normals = json_["accessors"][primitive["attributes"]["NORMAL"].get<std::size_t>()];
    const bool is_bytes = normals["componentType"] == 5120;
    const std::vector<std::uint8_t> ways = bytes_of(normals);
    for (std::size_t v = 0; v < normals["count"]; ++v) {
      std::array<float, 3> way{};
      for (std::size_t k = 0; k < 3; ++k) {
        way[k] = is_bytes ? static_cast<float>(static_cast<std::int8_t>(ways[4 * v + k])) / 127
                          : io::load_number<float>(&ways[12 * v + 4 * k]);
      }
      tile.normals.push_back({way[0], -way[2], way[1]});
    }
    if (primitive["attributes"].contains("TEXCOORD_0")) {
      const io::Json& places = json_["accessors"][primitive["attributes"]["TEXCOORD_0"].get<std::size_t>()];
      EXPECT_TRUE(places["normalized"].get<bool>());
      const std::vector<std::uint8_t> shares = bytes_of(places);
      for (std::size_t v = 0; v < places["count"]; ++v)
        tile.places.push_back({io::load_number<std::uint16_t>(&shares[4 * v]) / 65535.0,
                               io::load_number<std::uint16_t>(&shares[4 * v + 2]) / 65535.0});
    }
    tile.triangles = indices_of(primitive["indices"]);
    const io::Json& edges = primitive["extensions"]["CESIUM_tile_edges"];
    tile.west = indices_of(edges["left"]);
    tile.south = indices_of(edges["bottom"]);
    tile.east = indices_of(edges["right"]);
    tile.north = indices_of(edges["top"]);
    return tile;
  }

 private:
  std::vector<std::uint32_t> indices_of(const io::Json& accessor) {
    const io::Json& described = json_["accessors"][accessor.get<std::size_t>()];
    const std::vector<std::uint8_t> items = bytes_of(described);
    EXPECT_EQ(described["componentType"], 5123);
    std::vector<std::uint32_t> indices;
    for (std::size_t k = 0; k < described["count"]; ++k)
      indices.push_back(io::load_number<std::uint16_t>(&items[2 * k]));
    return indices;
  }
  std::vector<std::uint8_t> bytes_of(const io::Json& accessor) {
    const io::Json& view = json_["bufferViews"][accessor["bufferView"].get<std::size_t>()];
    std::vector<std::uint8_t> items;
    if (view.contains("extensions")) {
      const io::Json& packed = view["extensions"]["EXT_meshopt_compression"];
      io::MeshoptStream stream;
      stream.bytes = binary_.subspan(packed["byteOffset"], packed["byteLength"]);
      stream.mode = packed["mode"] == "ATTRIBUTES" ? io::MeshoptMode::kAttributes : io::MeshoptMode::kTriangles;
      stream.filter = packed.contains("filter") ? io::MeshoptFilter::kOctahedral : io::MeshoptFilter::kNone;
      stream.count = packed["count"];
      stream.stride = packed["byteStride"];
      EXPECT_EQ(io::decode_meshopt(stream, items), nullptr);
    } else {
      const auto bytes = binary_.subspan(view["byteOffset"], view["byteLength"]);
      items.assign(bytes.begin(), bytes.end());
    }
    const std::size_t offset = accessor.contains("byteOffset") ? accessor["byteOffset"].get<std::size_t>() : 0;
    items.erase(items.begin(), items.begin() + static_cast<std::ptrdiff_t>(offset));
    return items;
  }

  io::Json json_;
  std::span<const std::uint8_t> binary_;
};

Decoded decode(const std::vector<std::uint8_t>& glb) { return TileReader(glb).decode(); }

/// A set in memory.
class Kept final : public TileSetWriter {
 public:
  Result<void> put_tile(TileId id, std::span<const std::uint8_t> bytes) override {
    tiles[{id.z, id.y, id.x}].assign(bytes.begin(), bytes.end());
    return {};
  }
  Result<void> put_file(const std::string& name, std::span<const std::uint8_t> bytes) override {
    files[name].assign(bytes.begin(), bytes.end());
    return {};
  }
  Result<void> finish() override { return {}; }
  std::map<Key, std::vector<std::uint8_t>> tiles;
  std::map<std::string, std::vector<std::uint8_t>> files;
};

struct Made {
  PyramidPlan plan;
  PyramidReport report;
  Kept set;
};

PyramidPlan plan_of(const DegreeBox& covered, int finest, int cells) {
  PyramidSettings settings;
  settings.cells = cells;
  settings.max_zoom = finest;
  settings.has_siblings = true;
  const Result<PyramidPlan> plan = plan_pyramid({covered, 1, -1000, 1200}, settings);
  EXPECT_TRUE(plan) << plan.error().message;
  return *plan;
}

Made make_set(const DegreeBox& covered, int threads) {
  Made made;
  made.plan = plan_of(covered, 7, 16);
  const auto sink = make_tile_sink(TileFormat::kGlb, made.set, made.plan);
  Run run;
  run.threads = threads;
  const auto report = make_pyramid(made.plan, Land(covered), *sink, run);
  EXPECT_TRUE(report) << report.error().message;
  made.report = *report;
  PyramidReport told = made.report;
  EXPECT_TRUE(sink->put_files(told, {}));
  for (std::size_t z = 0; z < told.levels.size(); ++z)
    EXPECT_EQ(told.levels[z].bound, made.report.levels[z].bound + io::lattice_error(made.plan, static_cast<int>(z)));
  return made;
}

const DegreeBox kIsland{10.3, 34.1, 31.9, 50.2};

/// Exact place and normal.
using EdgeVertex = std::pair<Point, std::array<float, 3>>;

std::vector<EdgeVertex> edge_of(const Decoded& tile, const std::vector<std::uint32_t>& vertices) {
  std::vector<EdgeVertex> edge;
  for (const std::uint32_t v : vertices) edge.emplace_back(tile.positions[v], tile.normals[v]);
  return edge;
}

/// A neighbour's list is reversed.
std::vector<EdgeVertex> edge_back(const Decoded& tile, const std::vector<std::uint32_t>& vertices) {
  return edge_of(tile, {vertices.rbegin(), vertices.rend()});
}

void expect_same_edges(const DegreeBox& covered, int least) {
  const Made made = make_set(covered, 2);
  std::map<Key, Decoded> tiles;
  for (const auto& [key, bytes] : made.set.tiles) tiles[key] = decode(bytes);
  int edges = 0;
  for (const auto& [key, here] : tiles) {
    const auto [z, y, x] = key;
    if (const auto east = tiles.find({z, y, (x + 1) % (2u << z)}); east != tiles.end()) {
      EXPECT_EQ(edge_of(here, here.east), edge_back(east->second, east->second.west)) << z << " " << x << " " << y;
      ++edges;
    }
    if (const auto north = tiles.find({z, y + 1, x}); north != tiles.end()) {
      EXPECT_EQ(edge_of(here, here.north), edge_back(north->second, north->second.south)) << z << " " << x << " " << y;
      ++edges;
    }
    const std::array round{here.west, here.north, here.east, here.south};
    for (std::size_t side = 0; side < 4; ++side) {
      EXPECT_GE(round[side].size(), 2u);
      EXPECT_EQ(round[side].back(), round[(side + 1) % 4].front()) << "not clockwise";
    }
  }
  EXPECT_GT(edges, least);
}

TEST(tiles3d_laws, neighbours_share_vertices_to_the_bit) { expect_same_edges(kIsland, 300); }
TEST(tiles3d_laws, neighbours_share_vertices_around_the_antimeridian_and_at_poles) {
  expect_same_edges({170, -90, 180, -80}, 50);
  if (!testing::kIsSanitized) expect_same_edges({-180, 80, 180, 90}, 300);
}

TEST(tiles3d_laws, a_tile_has_four_children_or_none) {
  const Made made = make_set(kIsland, 2);
  std::map<Key, int> children;
  for (const auto& [key, bytes] : made.set.tiles) {
    const auto [z, y, x] = key;
    if (z > 0) ++children[{z - 1, y / 2, x / 2}];
  }
  for (const auto& [key, count] : children) {
    EXPECT_EQ(count, 4);
    EXPECT_EQ(made.set.tiles.count(key), 1u);
  }
  EXPECT_GT(children.size(), 50u);
}

TEST(tiles3d_laws, threads_change_nothing) {
  const Made one = make_set(kIsland, 1), three = make_set(kIsland, 3);
  EXPECT_EQ(one.set.tiles, three.set.tiles);
  EXPECT_EQ(one.set.files, three.set.files);
}

TEST(tiles3d_laws, uncompressed_tiles_have_the_same_triangles) {
  const PyramidPlan plan = plan_of({-180, -90, 180, 90}, 9, 64);
  for (const TileId id : {TileId{0, 1, 0}, TileId{5, 30, 16}, TileId{9, 511, 300}}) {
    const PyramidPlan coarse = plan_of({-180, -90, 180, 90}, id.z, 64);
    const auto tile = make_tile(coarse, id, Land({-180, -90, 180, 90}));
    ASSERT_TRUE(tile) << tile.error().message;
    const io::EarthTile placed = io::place_on_earth(*tile, plan);
    io::TileGlbOptions plain;
    plain.compress = false;
    const auto packed = io::encode_tile_glb(placed), unpacked = io::encode_tile_glb(placed, plain);
    ASSERT_TRUE(packed && unpacked);
    const Decoded one = decode(*packed), other = decode(*unpacked);
    const auto triangles_of = [](const Decoded& from) {
      std::multiset<std::array<Point, 3>> triangles;
      for (std::size_t k = 0; k < from.triangles.size(); k += 3) {
        std::array<Point, 3> corners{};
        for (std::size_t c = 0; c < 3; ++c) corners[c] = from.positions[from.triangles[k + c]];
        // At a pole, two corners of a triangle coincide: uses the least of the triangle's three orders.
        std::array<Point, 3> least = corners;
        for (int turn = 0; turn < 2; ++turn) {
          std::rotate(corners.begin(), corners.begin() + 1, corners.end());
          least = std::min(least, corners);
        }
        triangles.insert(least);
      }
      return triangles;
    };
    EXPECT_EQ(triangles_of(one), triangles_of(other));
    EXPECT_EQ(triangles_of(one).size(), tile->triangles.size() / 3);
    if (io::kHasMeshoptCodec) {
      EXPECT_LT(2 * packed->size(), unpacked->size());
    }
  }
}

/// Distance to a triangle in space (Ericson's regions).
double distance_to(const Point& p, const Point& a, const Point& b, const Point& c) {
  const Point ab = minus(b, a), ac = minus(c, a);
  const auto at = [&](double s, double t) {
    Point q{};
    for (std::size_t k = 0; k < 3; ++k) q[k] = a[k] + s * ab[k] + t * ac[k];
    return length(minus(p, q));
  };
  const Point ap = minus(p, a), bp = minus(p, b), cp = minus(p, c);
  const double d1 = times(ab, ap), d2 = times(ac, ap), d3 = times(ab, bp), d4 = times(ac, bp), d5 = times(ab, cp),
               d6 = times(ac, cp);
  if (d1 <= 0 && d2 <= 0) return at(0, 0);
  if (d3 >= 0 && d4 <= d3) return at(1, 0);
  if (d6 >= 0 && d5 <= d6) return at(0, 1);
  const double vc = d1 * d4 - d3 * d2, vb = d5 * d2 - d1 * d6, va = d3 * d6 - d5 * d4;
  if (vc <= 0 && d1 >= 0 && d3 <= 0) return at(d1 / (d1 - d3), 0);
  if (vb <= 0 && d2 >= 0 && d6 <= 0) return at(0, d2 / (d2 - d6));
  if (va <= 0 && d4 >= d3 && d5 >= d6) {
    const double w = (d4 - d3) / ((d4 - d3) + (d5 - d6));
    return at(1 - w, w);
  }
  const double all = va + vb + vc;
  return at(vb / all, vc / all);
}

Point place(double lon, double lat, double height) {
  const double a = 6378137, f = 1 / 298.257223563, e2 = f * (2 - f), s = std::sin(lat * kRadians);
  const double n = a / std::sqrt(1 - e2 * s * s), c = std::cos(lat * kRadians);
  return {(n + height) * c * std::cos(lon * kRadians), (n + height) * c * std::sin(lon * kRadians),
          (n * (1 - e2) + height) * s};
}

TEST(tiles3d_laws, every_node_is_within_the_bound_of_the_decoded_triangles) {
  for (const TileId id : {TileId{0, 0, 0}, TileId{2, 1, 3}, TileId{5, 33, 20}, TileId{8, 300, 150}, TileId{9, 3, 400},
                          TileId{12, 4711, 2900}, TileId{16, 70001, 40000}}) {
    const PyramidPlan plan = plan_of({-180, -90, 180, 90}, id.z, 32);
    const Land land({-180, -90, 180, 90});
    const auto tile = make_tile(plan, id, land);
    ASSERT_TRUE(tile) << tile.error().message;
    const Decoded mesh = decode(*io::encode_tile_glb(io::place_on_earth(*tile, plan)));
    const double bound = tile->bound() + io::lattice_error(plan, id.z);
    EXPECT_LE(io::lattice_error(plan, id.z), plan.levels[static_cast<std::size_t>(id.z)].max_error / 32);
    const std::int64_t steps = plan.cells, per_turn = steps << (id.z + 1);
    double worst = 0;
    for (std::int64_t j = 0; j <= steps; ++j) {
      for (std::int64_t i = 0; i <= steps; ++i) {
        const std::int64_t col = std::int64_t{id.x} * steps + i,
                           row = ((std::int64_t{1} << id.z) - 1 - id.y) * steps + j;
        const DegreeBox at = Land::degrees_at(per_turn, col, row);
        const Point node = place(at.west, at.south, land.at(per_turn, col, row));
        double nearest = std::numeric_limits<double>::infinity();
        for (std::size_t k = 0; k < mesh.triangles.size() && nearest > 0; k += 3) {
          nearest = std::min(nearest,
                             distance_to(node, mesh.positions[mesh.triangles[k]], mesh.positions[mesh.triangles[k + 1]],
                                         mesh.positions[mesh.triangles[k + 2]]));
        }
        worst = std::max(worst, nearest);
      }
    }
    EXPECT_LE(worst, bound) << id.z;
    EXPECT_GE(worst, bound / 50) << "the bound says little: " << id.z;
  }
}

bool is_set(std::span<const std::uint8_t> bits, std::size_t at) { return (bits[at / 8] >> (at % 8) & 1) != 0; }

/// Reads a subtree by the specification.
class SubtreeReader {
 public:
  explicit SubtreeReader(const std::vector<std::uint8_t>& bytes) {
    EXPECT_EQ(std::memcmp(bytes.data(), "subt", 4), 0);
    const auto json = io::load_number<std::uint64_t>(&bytes[8]), binary = io::load_number<std::uint64_t>(&bytes[16]);
    EXPECT_EQ(json % 8, 0u);
    EXPECT_EQ(24 + json + binary, bytes.size());
    json_ = io::Json::parse(bytes.begin() + 24, bytes.begin() + 24 + static_cast<std::ptrdiff_t>(json));
    binary_ = std::span(bytes).subspan(24 + json);
  }
  std::vector<bool> bits(const io::Json& availability, std::size_t size) const {
    std::vector<bool> all(size);
    if (availability.contains("constant")) {
      all.assign(size, availability["constant"] == 1);
      return all;
    }
    const auto bytes = view(availability["bitstream"]);
    EXPECT_EQ(bytes.size(), (size + 7) / 8);
    for (std::size_t k = 0; k < size; ++k) all[k] = is_set(bytes, k);
    EXPECT_EQ(std::count(all.begin(), all.end(), true), availability["availableCount"].get<std::ptrdiff_t>());
    return all;
  }
  std::vector<double> numbers(const char* property) const {
    const auto bytes = view(json_["propertyTables"][0]["properties"][property]["values"]);
    std::vector<double> all;
    for (std::size_t k = 0; k < bytes.size(); k += 8) all.push_back(io::load_number<double>(&bytes[k]));
    return all;
  }
  const io::Json& json() const { return json_; }

 private:
  std::span<const std::uint8_t> view(const io::Json& number) const {
    const io::Json& described = json_["bufferViews"][number.get<std::size_t>()];
    EXPECT_EQ(described["byteOffset"].get<std::size_t>() % 8, 0u);
    return binary_.subspan(described["byteOffset"], described["byteLength"]);
  }
  io::Json json_;
  std::span<const std::uint8_t> binary_;
};

TEST(tiles3d_laws, subtrees_tell_what_is_there_and_what_it_is_like) {
  const Made made = make_set(kIsland, 2);
  const io::Json tileset = io::Json::parse(made.set.files.at("tileset.json"));
  std::map<Key, io::TileFacts> told;
  for (std::uint32_t root = 0; root < 2; ++root) {
    std::vector<Key> pending{{0, 0, 0}};
    while (!pending.empty()) {
      const auto [z, y, x] = pending.back();
      pending.pop_back();
      const std::string name = "subtrees/" + std::to_string(root) + "/" + std::to_string(z) + "/" + std::to_string(x) +
                               "/" + std::to_string(y) + ".subtree";
      ASSERT_EQ(made.set.files.count(name), 1u) << name;
      const SubtreeReader subtree(made.set.files.at(name));
      const std::vector<bool> there = subtree.bits(subtree.json()["tileAvailability"], 341),
                              content = subtree.bits(subtree.json()["contentAvailability"][0], 341),
                              below = subtree.bits(subtree.json()["childSubtreeAvailability"], 1024);
      EXPECT_EQ(there, content);
      const auto low = subtree.numbers("min_height"), high = subtree.numbers("max_height"),
                 sphere = subtree.numbers("sphere"), horizon = subtree.numbers("horizon_point");
      std::size_t row = 0, first = 0;
      for (int depth = 0; depth <= 5; ++depth) {
        for (std::uint32_t code = 0; code < 1u << (2 * depth); ++code) {
          if (!(depth == 5 ? below[code] : there[first + code])) continue;
          std::uint32_t dx = 0, dy = 0;
          for (int bit = 0; bit < depth; ++bit) {
            dx |= (code >> (2 * bit) & 1) << bit;
            dy |= (code >> (2 * bit + 1) & 1) << bit;
          }
          const std::uint32_t tile_x = (x << depth) + dx, tile_y = (y << depth) + dy;
          if (depth == 5) {
            pending.emplace_back(z + 5, tile_y, tile_x);
            continue;
          }
          io::TileFacts facts{low[row], high[row], {}, {}};
          std::copy_n(&sphere[4 * row], 4, facts.sphere.begin());
          std::copy_n(&horizon[3 * row], 3, facts.horizon_point.begin());
          ++row;
          told[{z + depth, tile_y, tile_x + (root << (z + depth))}] = facts;
        }
        first += std::size_t{1} << (2 * depth);
      }
      EXPECT_EQ(row, low.size());
      EXPECT_EQ(subtree.json()["propertyTables"][0]["count"], row);
    }
  }
  ASSERT_EQ(told.size(), made.set.tiles.size());
  const double low = tileset["root"]["boundingVolume"]["region"][4],
               high = tileset["root"]["boundingVolume"]["region"][5];
  for (const auto& [key, bytes] : made.set.tiles) {
    ASSERT_EQ(told.count(key), 1u);
    const io::TileFacts& facts = told[key];
    EXPECT_EQ(facts, *io::read_tile_facts(bytes));
    EXPECT_LE(low, facts.min_height);
    EXPECT_GE(high, facts.max_height);
    for (const Point& at : decode(bytes).positions)
      EXPECT_LE(length(minus(at, {facts.sphere[0], facts.sphere[1], facts.sphere[2]})), facts.sphere[3]);
    for (const double value : facts.horizon_point) EXPECT_TRUE(std::isfinite(value));
  }
  // The proven error of each level is at most the error given to clients.
  const double error = tileset["root"]["children"][0]["geometricError"];
  for (std::size_t z = 0; z < made.report.levels.size(); ++z) {
    EXPECT_GE(std::ldexp(error, -static_cast<int>(z)),
              made.report.levels[z].bound + io::lattice_error(made.plan, static_cast<int>(z)));
  }
}

/// An image whose colours encode the place of each pixel's middle.
class PlaceImage final : public io::GlobeImage {
 public:
  explicit PlaceImage(double per_degree) : per_degree_(per_degree) {}
  DegreeBox covered() const override { return {-180, -90, 180, 90}; }
  std::array<double, 2> per_degree() const override { return {per_degree_, per_degree_}; }
  Result<std::optional<Picture>> read(const DegreeBox& box, int side,
                                      const std::array<std::uint8_t, 3>&) const override {
    asked = box;
    Picture picture{side, side, std::vector<std::uint8_t>(3 * static_cast<std::size_t>(side * side), 200)};
    return std::optional(std::move(picture));
  }
  mutable DegreeBox asked = {};

 private:
  double per_degree_;
};

TEST(tiles3d_laws, a_texture_has_a_pixel_more_on_each_side_and_as_many_as_the_image_and_clients_need) {
  const PyramidPlan plan = plan_of({-180, -90, 180, 90}, 6, 16);
  for (const auto& [per_degree, z, side] : std::vector<std::tuple<double, int, int>>{{1, 6, 256},
                                                                                     {100, 6, 512},
                                                                                     {100, 5, 512},
                                                                                     {100, 0, 512},
                                                                                     {300, 6, 1024},
                                                                                     {300, 5, 512},
                                                                                     {1e5, 6, 2048},
                                                                                     {0.5, 0, 256}}) {
    const PlaceImage image(per_degree);
    const TileId id{z, 1, 0};
    const auto texture = jobs::make_tile_texture(image, ImageFormat::kJpeg, plan, id);
    ASSERT_TRUE(texture && *texture);
    EXPECT_EQ((*texture)->side, side) << per_degree << " " << z;
    const DegreeBox tile = plan.grid.bounds_of(id);
    const double pixel = (tile.east - tile.west) / (side - 2);
    EXPECT_NEAR(image.asked.west, tile.west - pixel, 1e-9);
    EXPECT_NEAR(image.asked.north, tile.north + pixel, 1e-9);
    EXPECT_NEAR(image.asked.east - image.asked.west, side * pixel, 1e-9);
  }
}

TEST(tiles3d_laws, vertices_lie_in_the_texture_where_they_lie_in_the_tile) {
  const PyramidPlan plan = plan_of({-180, -90, 180, 90}, 3, 16);
  const auto tile = make_tile(plan, {3, 5, 4}, Land({-180, -90, 180, 90}));
  ASSERT_TRUE(tile);
  const io::EarthTile placed = io::place_on_earth(*tile, plan);
  for (const bool compress : {true, false}) {
    io::TileGlbOptions options;
    options.compress = compress;
    options.texture = io::TileTexture{{1, 2, 3}, ImageFormat::kPng, 256};
    const auto glb = io::encode_tile_glb(placed, options);
    ASSERT_TRUE(glb) << glb.error().message;
    TileReader reader(*glb);
    const Decoded decoded = reader.decode();
    EXPECT_EQ(reader.json()["images"][0]["mimeType"], "image/png");
    ASSERT_EQ(decoded.places.size(), tile->u.size());
    // Vertices have another order in the file: compares sets.
    std::multiset<std::pair<int, int>> found, wanted;
    const auto thousandths = [](double pixels) { return static_cast<int>(std::floor(pixels * 50 + 0.5)); };
    for (const auto& [u, v] : decoded.places) {
      const double x = (u * 256 - 1) / 254 * 32767, y = 32767 - (v * 256 - 1) / 254 * 32767;
      found.insert({thousandths(x / 1000), thousandths(y / 1000)});
      EXPECT_GE(u * 256, 1 - 0.01);
      EXPECT_LE(v * 256, 255 + 0.01);
    }
    for (std::size_t v = 0; v < tile->u.size(); ++v)
      wanted.insert({thousandths(tile->u[v] / 1000.0), thousandths(tile->v[v] / 1000.0)});
    EXPECT_EQ(found, wanted);
    EXPECT_EQ(io::encode_tile_glb(placed, options).value(), *glb);
  }
}

TEST(tiles3d_laws, facts_are_read_from_nothing_else) {
  const PyramidPlan plan = plan_of({-180, -90, 180, 90}, 0, 16);
  const auto tile = make_tile(plan, {0, 0, 0}, Land({-180, -90, 180, 90}));
  ASSERT_TRUE(tile);
  const std::vector<std::uint8_t> good = *io::encode_tile_glb(io::place_on_earth(*tile, plan));
  ASSERT_TRUE(io::read_tile_facts(good));
  for (std::size_t size = 0; size < 700; ++size) EXPECT_FALSE(io::read_tile_facts(std::span(good).first(size)));
  std::vector<std::uint8_t> other = good;
  const char name[] = "horizon_point";
  const auto at = std::search(other.begin(), other.end(), name, name + 13);
  ASSERT_NE(at, other.end());
  *at = 'x';
  EXPECT_FALSE(io::read_tile_facts(other));
}

}  // namespace
}  // namespace scarp::tiles3d_laws_test
