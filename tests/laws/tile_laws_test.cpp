// Laws of tiles, of every grid: two neighbours decode to the same edge, and a tile's bound is that of all its nodes.
#include <gtest/gtest.h>
#include <rapidcheck/gtest.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdint>
#include <limits>
#include <map>
#include <mutex>
#include <set>
#include <tuple>
#include <vector>

#include "laws/sanitized.h"
#include "scarp/measure.h"
#include "scarp/tile.h"
#include "tiles/coarse_nodes.h"
#include "tiles/globe.h"
#include "tiles/node_scan.h"
#include "tiles/sine.h"
#include "tiles/tile_mesh_parts.h"

namespace scarp::tile_laws_test {
namespace {

constexpr float kNone = std::numeric_limits<float>::quiet_NaN();

/// Heights from a hash of a node's place, on waves: steep, flat, with steps and voids, all round the globe.
class AnyLand final : public NodeSource {
 public:
  AnyLand(std::uint32_t seed, double relief, double noise, bool has_voids, DegreeBox covered)
      : seed_(seed), relief_(relief), noise_(noise), has_voids_(has_voids), covered_(covered) {}

  float at(const NodeWindow& window, std::int64_t col, std::int64_t row) const {
    col = ((col % window.per_turn) + window.per_turn) % window.per_turn;
    if (window.is_pole(row)) col = 0;
    const double lon = window.longitude(col), lat = window.latitude(row);
    if (lon < covered_.west || lon > covered_.east || lat < covered_.south || lat > covered_.north) return kNone;
    const std::uint32_t hash =
        mix(static_cast<std::uint32_t>(col) * 2654435761u ^ mix(static_cast<std::uint32_t>(row) + seed_));
    if (has_voids_ &&
        mix(static_cast<std::uint32_t>(col / 9) * 31u + static_cast<std::uint32_t>(row / 7) + seed_) % 11 == 0)
      return kNone;
    const double wave = sine_of_degrees(std::fmod(lon * 977 + seed_ % 360, 720)).sine *
                        sine_of_degrees(std::fmod(lat * 1201, 720)).cosine;
    const double step = std::fmod(lon * 53 + lat * 17 + 1e4, 7) < 0.4 ? relief_ / 3 : 0;
    return static_cast<float>(relief_ / 2 * wave + step + noise_ * (hash % 1024) / 1024.0);
  }
  Result<void> read(const NodeWindow& window, std::span<float> out) const override {
    std::size_t k = 0;
    for (int j = 0; j < window.rows; ++j) {
      for (int i = 0; i < window.cols; ++i) out[k++] = at(window, window.col + i, window.row + j);
    }
    return {};
  }

 private:
  static std::uint32_t mix(std::uint32_t x) {
    x ^= x >> 16;
    x *= 0x7feb352du;
    x ^= x >> 15;
    x *= 0x846ca68bu;
    return x ^ (x >> 16);
  }

  std::uint32_t seed_;
  double relief_, noise_;
  bool has_voids_;
  DegreeBox covered_;
};

constexpr TileGrid kGrids[] = {{GridKind::kGeographic}, {GridKind::kMercator}};

TileGrid any_grid() { return kGrids[*rc::gen::inRange<std::size_t>(0, 2)]; }

PyramidPlan plan_of(double relief, double noise, int finest, int cells, Effort effort, const TileGrid& grid = {},
                    double share = 0.25) {
  SourceFacts source{{-180, -90, 180, 90}, 1, -relief, relief + noise};
  PyramidSettings settings;
  settings.cells = cells;
  settings.max_zoom = finest;
  settings.effort = effort;
  settings.grid = grid;
  settings.max_error = share * grid.geometric_error(finest);
  const Result<PyramidPlan> plan = plan_pyramid(source, settings);
  EXPECT_TRUE(plan) << plan.error().message;
  return *plan;
}

QuantizedMesh decode(const TerrainTile& tile, const TileGrid& grid = {}) {
  const auto decoded = decode_quantized_mesh(encode_quantized_mesh(tile, {}, grid), "tile");
  EXPECT_TRUE(decoded) << decoded.error().message;
  return *decoded;
}

/// A vertex on an edge as clients see it: place along the edge, height in single precision, normal.
using EdgeVertex = std::tuple<std::uint16_t, float, std::array<std::uint8_t, 2>>;

std::vector<EdgeVertex> edge_of(const QuantizedMesh& mesh, const std::vector<std::uint32_t>& vertices,
                                const std::vector<std::uint16_t>& along) {
  std::vector<EdgeVertex> edge;
  for (const std::uint32_t v : vertices)
    edge.emplace_back(along[v], static_cast<float>(mesh.height(v)) + 0.0f, mesh.normals[v]);
  return edge;
}

/// Single precision of 0 is the one exception: there clients may differ by 1.5e-11 m.
std::vector<EdgeVertex> without_dust(std::vector<EdgeVertex> edge) {
  for (auto& [place, height, normal] : edge) {
    if (std::abs(height) < 1e-10f) height = 0;
  }
  return edge;
}

/// Where the rows of nodes of a tile lie in the degrees between its ends, as steps: by the library's own mathematics.
std::vector<double> lines_of(TileId id, std::int32_t steps, const TileGrid& grid) {
  constexpr double kPi = 3.141592653589793;
  std::vector<double> degrees, lines;
  for (std::int32_t row = 0; row <= steps; ++row) {
    const double part = (grid.rows(id.z) - 1.0 - id.y + static_cast<double>(row) / steps) / grid.rows(id.z);
    degrees.push_back(grid.has_poles() ? 90 - 180 * part : std::atan(std::sinh(kPi * (1 - 2 * part))) * 180 / kPi);
  }
  for (const double degree : degrees)
    lines.push_back((degrees.front() - degree) / (degrees.front() - degrees.back()) * steps);
  return lines;
}

/// Largest error at the nodes of a decoded tile, by brute force: every node in every triangle around it.
double brute_force(const QuantizedMesh& mesh, TileId id, std::int32_t steps, const NodeSource& source, float background,
                   const TileGrid& grid) {
  std::vector<float> nodes(static_cast<std::size_t>(steps + 1) * static_cast<std::size_t>(steps + 1));
  EXPECT_TRUE(source.read(grid.window_of(id, steps), nodes));
  const std::vector<double> lines = lines_of(id, steps, grid);
  const auto first_row = [&](double line) {
    return static_cast<std::int32_t>(std::lower_bound(lines.begin(), lines.end(), line - 1e-9) - lines.begin());
  };
  std::vector<double> worst(nodes.size(), -1);
  for (std::size_t k = 0; k < mesh.triangles.size(); k += 3) {
    std::array<double, 3> x{}, y{}, z{};
    for (std::size_t c = 0; c < 3; ++c) {
      const std::uint32_t v = mesh.triangles[k + c];
      x[c] = mesh.u[v] * static_cast<double>(steps) / 32767;
      y[c] = steps - mesh.v[v] * static_cast<double>(steps) / 32767;
      z[c] = mesh.height(v);
    }
    const double area = (x[1] - x[0]) * (y[2] - y[0]) - (x[2] - x[0]) * (y[1] - y[0]);
    const auto [left, right] = std::minmax({x[0], x[1], x[2]});
    const auto [top, bottom] = std::minmax({y[0], y[1], y[2]});
    for (std::int32_t j = first_row(top); j <= steps && lines[static_cast<std::size_t>(j)] <= bottom + 1e-9; ++j) {
      const double line = lines[static_cast<std::size_t>(j)];
      for (auto i = static_cast<std::int32_t>(std::ceil(left - 1e-9)); i <= right + 1e-9; ++i) {
        const double b = ((i - x[0]) * (y[2] - y[0]) - (x[2] - x[0]) * (line - y[0])) / area;
        const double c = ((x[1] - x[0]) * (line - y[0]) - (i - x[0]) * (y[1] - y[0])) / area;
        if (b < -1e-9 || c < -1e-9 || b + c > 1 + 1e-9) continue;
        const auto at = static_cast<std::size_t>(j * (steps + 1) + i);
        const double node = std::isnan(nodes[at]) ? double{background} : double{nodes[at]};
        worst[at] = std::max(worst[at], std::abs(z[0] + b * (z[1] - z[0]) + c * (z[2] - z[0]) - node));
      }
    }
  }
  EXPECT_GE(*std::min_element(worst.begin(), worst.end()), 0) << "a node without a triangle";
  return *std::max_element(worst.begin(), worst.end());
}

std::int32_t nodes_of(const PyramidPlan& plan, int z) { return plan.cells << (plan.max_zoom() - z); }

Effort any_effort() { return *rc::gen::element(Effort::kFast, Effort::kNormal, Effort::kHigh); }

AnyLand any_land(double& relief, double& noise) {
  relief = *rc::gen::element(0.0, 40.0, 900.0, 6000.0);
  noise = *rc::gen::element(0.0, 3.0, 200.0);
  return {*rc::gen::arbitrary<std::uint32_t>(), relief, noise, *rc::gen::arbitrary<bool>(), {-180, -90, 180, 90}};
}

RC_GTEST_PROP(tile_laws, neighbours_decode_to_the_same_edge, ()) {
  double relief = 0, noise = 0;
  const AnyLand land = any_land(relief, noise);
  const int finest = *rc::gen::inRange(2, 9), z = std::max(0, finest - *rc::gen::inRange(0, 3));
  const TileGrid grid = any_grid();
  const PyramidPlan plan = plan_of(relief, noise, finest, 32, any_effort(), grid);
  const std::uint32_t across = grid.columns(z), down = grid.rows(z);
  const auto x = *rc::gen::inRange<std::uint32_t>(0, across), y = *rc::gen::inRange<std::uint32_t>(0, down);
  const auto tile = make_tile(plan, {z, x, y}, land);
  RC_ASSERT(tile.has_value());
  const QuantizedMesh here = decode(*tile, grid);
  // The eastern neighbour of the last column is the first.
  const auto east = make_tile(plan, {z, (x + 1) % across, y}, land);
  RC_ASSERT(east.has_value());
  const QuantizedMesh there = decode(*east, grid);
  RC_ASSERT(without_dust(edge_of(here, here.east, here.v)) == without_dust(edge_of(there, there.west, there.v)));
  if (y + 1 < down) {
    const auto north = make_tile(plan, {z, x, y + 1}, land);
    RC_ASSERT(north.has_value());
    const QuantizedMesh above = decode(*north, grid);
    RC_ASSERT(without_dust(edge_of(here, here.north, here.u)) == without_dust(edge_of(above, above.south, above.u)));
  } else if (grid.has_poles()) {
    for (const std::uint32_t v : here.north) RC_ASSERT(here.h[v] == here.h[here.north[0]]);
  }
}

RC_GTEST_PROP(tile_laws, the_bound_is_that_of_all_nodes_as_clients_decode_them, ()) {
  double relief = 0, noise = 0;
  const AnyLand land = any_land(relief, noise);
  const int finest = *rc::gen::inRange(1, 9), z = std::max(0, finest - *rc::gen::inRange(0, 3));
  const TileGrid grid = any_grid();
  const PyramidPlan plan = plan_of(relief, noise, finest, 32, any_effort(), grid);
  const TileId id{z, *rc::gen::inRange<std::uint32_t>(0, grid.columns(z)),
                  *rc::gen::inRange<std::uint32_t>(0, grid.rows(z))};
  const auto tile = make_tile(plan, id, land);
  RC_ASSERT(tile.has_value());
  const double error = brute_force(decode(*tile, grid), id, nodes_of(plan, z), land, plan.background, grid);
  RC_ASSERT(error <= tile->node_error * (1 + 1e-9) + 1e-6);
  RC_ASSERT(tile->node_error <= plan.levels[static_cast<std::size_t>(z)].max_error);
}

/// Nodes at which the tile's decoded triangles err, by the judge of finished meshes.
Measurement judge(const TerrainTile& tile, const TileNodes& nodes, double limit) {
  std::vector<float> heights;
  for (std::int32_t row = 0; row <= nodes.steps(); ++row)
    heights.insert(heights.end(), nodes.from(0, row), nodes.from(0, row) + nodes.steps() + 1);
  HeightField field;
  field.samples = heights.data();
  field.cols = field.rows = nodes.steps() + 1;
  field.frame = grid_frame(field.rows);
  MeasureOptions options;
  options.topology = false;
  options.collect_above = limit;
  return *measure(field, decoded(tile, nodes.steps()), options);
}

RC_GTEST_PROP(tile_laws, the_scan_of_nodes_finds_what_the_judge_finds, ()) {
  double relief = 0, noise = 0;
  const AnyLand land = any_land(relief, noise);
  const int finest = *rc::gen::inRange(1, 9), z = std::max(0, finest - *rc::gen::inRange(0, 4));
  const PyramidPlan plan = plan_of(relief, noise, finest, 32, any_effort());
  const TileId id{z, *rc::gen::inRange<std::uint32_t>(0, std::uint32_t{2} << z),
                  *rc::gen::inRange<std::uint32_t>(0, std::uint32_t{1} << z)};
  const std::int32_t steps = nodes_of(plan, z);
  const TileNodes nodes = *TileNodes::read(plan, id, steps, normal_reach(steps), land);
  TerrainTile tile = *make_tile(plan, id, land);
  // Some vertices go astray, so that nodes around them are beyond the limit.
  const double limit = plan.levels[static_cast<std::size_t>(z)].max_error;
  const auto far = static_cast<std::int32_t>(3 * limit / tile.quantum);
  const auto astray = *rc::gen::inRange(0, 5);
  for (int k = 0; k < astray; ++k) tile.heights[*rc::gen::inRange<std::size_t>(0, tile.heights.size())] += far;
  const NodeErrors errors = scan_nodes(tile, nodes, limit);
  const Measurement judged = judge(tile, nodes, limit);
  RC_ASSERT(errors.uncovered == 0u);
  RC_ASSERT(std::abs(errors.largest - judged.max_error) <= 1e-9 * (1 + judged.max_error));
  // Both name the worst node of a triangle; one that is that of two triangles may be named once or twice.
  const auto places = [](const auto& nodes) {
    std::set<std::pair<std::int32_t, std::int32_t>> all;
    for (const auto& node : nodes) all.insert({node.row, node.col});
    return all;
  };
  RC_ASSERT(places(errors.worst) == places(judged.offenders));
  tile.triangles.resize(tile.triangles.size() - 3);
  // The judge forgives a node that lies beside a triangle by less than a 256th of a step.
  RC_ASSERT(scan_nodes(tile, nodes, limit).uncovered >= judge(tile, nodes, limit).uncovered);
}

RC_GTEST_PROP(tile_laws, a_limit_of_bytes_changes_the_interior_alone_and_the_bound_stays_true, ()) {
  double relief = 0, noise = 0;
  const AnyLand land = any_land(relief, noise);
  const int finest = *rc::gen::inRange(2, 9), z = std::max(0, finest - *rc::gen::inRange(0, 3));
  PyramidPlan plan = plan_of(relief, noise, finest, 32, any_effort());
  const TileId id{z, *rc::gen::inRange<std::uint32_t>(0, std::uint32_t{2} << z),
                  *rc::gen::inRange<std::uint32_t>(0, std::uint32_t{1} << z)};
  const TileEncoder encode = [](const TerrainTile& tile) { return encode_quantized_mesh(tile); };
  const auto free = make_kept_tile(plan, id, land, encode);
  RC_ASSERT(free.has_value());
  plan.max_tile_bytes = *rc::gen::inRange<std::uint64_t>(1, free->bytes.size() + 100);
  const auto kept = make_kept_tile(plan, id, land, encode);
  RC_ASSERT(kept.has_value());
  const double asked = plan.levels[static_cast<std::size_t>(z)].max_error;
  RC_ASSERT(kept->tile.max_error >= asked);
  if (free->bytes.size() <= plan.max_tile_bytes) RC_ASSERT(kept->bytes == free->bytes);
  // What does not fit has nothing left to leave out.
  if (kept->bytes.size() > plan.max_tile_bytes) {
    plan.max_tile_bytes = 1;
    const auto least = make_kept_tile(plan, id, land, encode);
    RC_ASSERT(least.has_value());
    RC_ASSERT(kept->bytes == least->bytes);
  }
  const QuantizedMesh whole = decode(free->tile), small = decode(kept->tile);
  RC_ASSERT(without_dust(edge_of(whole, whole.west, whole.v)) == without_dust(edge_of(small, small.west, small.v)));
  RC_ASSERT(without_dust(edge_of(whole, whole.south, whole.u)) == without_dust(edge_of(small, small.south, small.u)));
  RC_ASSERT(without_dust(edge_of(whole, whole.east, whole.v)) == without_dust(edge_of(small, small.east, small.v)));
  RC_ASSERT(without_dust(edge_of(whole, whole.north, whole.u)) == without_dust(edge_of(small, small.north, small.u)));
  const double error = brute_force(small, id, nodes_of(plan, z), land, plan.background, plan.grid);
  RC_ASSERT(error <= kept->tile.node_error * (1 + 1e-9) + 1e-6);
  RC_ASSERT(kept->tile.node_error <= kept->tile.max_error);
}

/// Lines around a tile, through it, along its edges and through its corners.
std::vector<DegreeLine> any_lines(TileId id) {
  const DegreeBox box = TileGrid{}.bounds_of(id);
  const auto any_place = [](double from, double to) {
    const int kind = *rc::gen::inRange(0, 8);
    return kind == 0 ? from : kind == 1 ? to : from + (to - from) * (*rc::gen::inRange(-600, 1601) / 1000.0);
  };
  std::vector<DegreeLine> lines(*rc::gen::inRange<std::size_t>(1, 5));
  for (DegreeLine& line : lines) {
    line.resize(*rc::gen::inRange<std::size_t>(2, 7));
    for (auto& [longitude, latitude] : line) {
      longitude = any_place(box.west, box.east);
      latitude = std::clamp(any_place(box.south, box.north), -90.0, 90.0);
    }
  }
  return lines;
}

/// Whether no edge of the mesh passes the straight way from one node of the level to another, but by rounding.
bool is_chain_of_edges(const QuantizedMesh& mesh, const std::array<TileLines::Node, 2>& step, int cells) {
  std::array<double, 4> way{};
  for (std::size_t k = 0; k < 2; ++k) {
    way[2 * k] = step[k][0] * 32767.0 / cells;
    way[2 * k + 1] = 32767 - step[k][1] * 32767.0 / cells;
  }
  const double dx = way[2] - way[0], dy = way[3] - way[1], length = std::hypot(dx, dy),
               slack = 3 + 32767.0 / cells / 32;
  for (std::size_t k = 0; k < mesh.triangles.size(); ++k) {
    const std::uint32_t a = mesh.triangles[k], b = mesh.triangles[k % 3 == 2 ? k - 2 : k + 1];
    const auto beside = [&](std::uint32_t v) {
      return (dx * (mesh.v[v] - way[1]) - dy * (mesh.u[v] - way[0])) / length;
    };
    const auto along = [&](std::uint32_t v) {
      return (dx * (mesh.u[v] - way[0]) + dy * (mesh.v[v] - way[1])) / length;
    };
    if (!(std::min(beside(a), beside(b)) < -slack && std::max(beside(a), beside(b)) > slack)) continue;
    const double share = beside(a) / (beside(a) - beside(b)), at = along(a) + share * (along(b) - along(a));
    if (at > slack && at < length - slack) return false;
  }
  return true;
}

RC_GTEST_PROP(tile_laws, lines_are_edges_and_neighbours_have_the_same_vertex_where_they_cross, ()) {
  double relief = 0, noise = 0;
  const AnyLand land = any_land(relief, noise);
  const int finest = *rc::gen::inRange(2, 9), z = std::max(0, finest - *rc::gen::inRange(0, 3));
  PyramidPlan plan = plan_of(relief, noise, finest, 32, any_effort());
  const std::uint32_t across = std::uint32_t{2} << z, down = std::uint32_t{1} << z;
  const TileId id{z, *rc::gen::inRange<std::uint32_t>(0, across), *rc::gen::inRange<std::uint32_t>(0, down)};
  set_lines(plan, any_lines(id));
  const auto tile = make_tile(plan, id, land);
  RC_ASSERT(tile.has_value());
  const QuantizedMesh here = decode(*tile);
  RC_ASSERT(brute_force(here, id, nodes_of(plan, z), land, plan.background, plan.grid) <=
            tile->node_error * (1 + 1e-9) + 1e-6);
  if (const TileLines::Paths* const paths = plan.lines->find(id); paths != nullptr && tile->lines_left_out == 0) {
    for (const auto& step : paths->steps) RC_ASSERT(is_chain_of_edges(here, step, plan.cells));
    for (const std::int32_t col : paths->edges.top) {
      RC_ASSERT(std::any_of(here.north.begin(), here.north.end(),
                            [&](std::uint32_t v) { return std::abs(here.u[v] - col * 32767.0 / plan.cells) < 1; }));
    }
  }
  const auto east = make_tile(plan, {z, (id.x + 1) % across, id.y}, land);
  RC_ASSERT(east.has_value());
  const QuantizedMesh there = decode(*east);
  RC_ASSERT(without_dust(edge_of(here, here.east, here.v)) == without_dust(edge_of(there, there.west, there.v)));
  if (id.y + 1 == down) return;
  const auto north = make_tile(plan, {z, id.x, id.y + 1}, land);
  RC_ASSERT(north.has_value());
  const QuantizedMesh above = decode(*north);
  RC_ASSERT(without_dust(edge_of(here, here.north, here.u)) == without_dust(edge_of(above, above.south, above.u)));
}

/// Tiles in memory.
class Kept final : public TileSink {
 public:
  explicit Kept(const TileGrid& grid = {}) : grid_(grid) {}
  Result<std::vector<std::uint8_t>> encode(const TerrainTile& tile) const override {
    const std::lock_guard lock(mutex_);
    made_[key(tile.id)] = tile;
    return encode_quantized_mesh(tile, {}, grid_);
  }
  Result<void> put(TileId id, std::span<const std::uint8_t> bytes) override {
    order.push_back(key(id));
    files[key(id)].assign(bytes.begin(), bytes.end());
    return {};
  }
  const TerrainTile& tile(TileId id) const { return made_.at(key(id)); }

  using Key = std::tuple<int, std::uint32_t, std::uint32_t>;
  static Key key(TileId id) { return {id.z, id.x, id.y}; }
  std::vector<Key> order;
  std::map<Key, std::vector<std::uint8_t>> files;

 private:
  TileGrid grid_;
  mutable std::mutex mutex_;
  mutable std::map<Key, TerrainTile> made_;
};

struct Made {
  explicit Made(const TileGrid& grid) : kept(grid) {}

  PyramidPlan plan;
  Kept kept;
  PyramidReport report;
};

std::unique_ptr<Made> make_small_pyramid(const AnyLand& land, const DegreeBox& covered, int threads,
                                         const TileGrid& grid = {}, std::uint64_t max_tile_bytes = 0,
                                         std::vector<DegreeLine> lines = {}) {
  SourceFacts source{covered, 1, -1000, 1200};
  PyramidSettings settings;
  settings.cells = 16;
  settings.max_zoom = 7;
  settings.grid = grid;
  settings.max_tile_bytes = max_tile_bytes;
  settings.lines = std::move(lines);
  auto made = std::make_unique<Made>(grid);
  made->plan = *plan_pyramid(source, settings);
  Run run;
  run.threads = threads;
  auto report = make_pyramid(made->plan, land, made->kept, run);
  EXPECT_TRUE(report) << report.error().message;
  if (report) made->report = *report;
  return made;
}

const DegreeBox kIsland{10.3, 34.1, 31.9, 50.2};
const std::vector<DegreeLine> kRivers{{{5, 40}, {14, 41.2}, {16.5, 46}, {40, 48.1}},
                                      {{22.5, 30}, {22.5, 55}},
                                      {{12, 36}, {12.4, 36.3}, {13, 36.1}, {12, 36}}};

TEST(pyramid_laws, a_tile_of_a_pyramid_is_the_one_made_alone_and_threads_change_nothing) {
  const AnyLand land(7, 900, 50, false, kIsland);
  for (const TileGrid& grid : kGrids) {
    if (testing::kIsSanitized && grid.has_even_rows()) continue;
    const auto one = make_small_pyramid(land, kIsland, 1, grid), three = make_small_pyramid(land, kIsland, 3, grid);
    EXPECT_EQ(one->kept.order, three->kept.order);
    EXPECT_EQ(one->kept.files, three->kept.files);
    std::size_t alone = 0;
    for (const auto& [key, bytes] : one->kept.files) {
      const auto [z, x, y] = key;
      if (z < one->plan.block_level) continue;
      const auto tile = make_tile(one->plan, {z, x, y}, land);
      ASSERT_TRUE(tile) << tile.error().message;
      EXPECT_EQ(encode_quantized_mesh(*tile, {}, grid), bytes) << grid.name() << " " << z << "/" << x << "/" << y;
      ++alone;
    }
    EXPECT_GT(alone, grid.has_even_rows() ? 200u : 100u) << grid.name();
  }
}

TEST(pyramid_laws, tiles_within_a_limit_of_bytes_and_with_lines_are_those_made_alone_and_are_counted) {
  constexpr std::uint64_t kLimit = 900;
  const AnyLand land(7, 900, 50, false, kIsland);
  const auto one = make_small_pyramid(land, kIsland, 1, {}, kLimit, kRivers);
  const auto three = make_small_pyramid(land, kIsland, 3, {}, kLimit, kRivers);
  EXPECT_EQ(one->kept.files, three->kept.files);
  const TileEncoder encode = [](const TerrainTile& tile) { return encode_quantized_mesh(tile); };
  std::vector<std::uint64_t> coarser(one->plan.levels.size()), oversized(coarser);
  for (const auto& [key, bytes] : one->kept.files) {
    const auto [z, x, y] = key;
    const auto level = static_cast<std::size_t>(z);
    const auto tile = make_kept_tile(one->plan, {z, x, y}, land, encode);
    ASSERT_TRUE(tile) << tile.error().message;
    EXPECT_EQ(tile->bytes, bytes) << z << "/" << x << "/" << y;
    coarser[level] += tile->tile.max_error > one->plan.levels[level].max_error;
    oversized[level] += bytes.size() > kLimit;
  }
  std::uint64_t all = 0;
  for (std::size_t z = 0; z < coarser.size(); ++z) {
    EXPECT_EQ(one->report.levels[z].coarser, coarser[z]) << z;
    EXPECT_EQ(one->report.levels[z].oversized, oversized[z]) << z;
    all += coarser[z];
  }
  EXPECT_GT(all, 50u);
}

TEST(pyramid_laws, a_tile_above_the_blocks_is_the_same_without_its_proof_and_tiles_are_known_before_they_are_made) {
  for (const auto& [grid, has_voids] : {std::pair{kGrids[0], false}, {kGrids[0], true}, {kGrids[1], true}}) {
    const AnyLand land(21, 900, 50, has_voids, kIsland);
    const auto made = make_small_pyramid(land, kIsland, 2, grid);
    std::size_t above = 0;
    for (const auto& [key, bytes] : made->kept.files) {
      const auto [z, x, y] = key;
      if (z >= made->plan.block_level) continue;
      const auto tile = make_unproven_tile(made->plan, {z, x, y}, land);
      ASSERT_TRUE(tile) << tile.error().message;
      EXPECT_TRUE(std::isnan(tile->node_error));
      EXPECT_EQ(encode_quantized_mesh(*tile, {}, grid), bytes) << z << "/" << x << "/" << y;
      ++above;
    }
    EXPECT_GE(above, grid.has_even_rows() ? 6u : 5u);
    const auto tiles = find_tiles(made->plan, &land);
    ASSERT_TRUE(tiles) << tiles.error().message;
    EXPECT_EQ(*tiles, made->report.tiles);
    // Without a look at nodes: at least these.
    const auto perhaps = find_tiles(made->plan, nullptr);
    ASSERT_TRUE(perhaps);
    for (std::size_t z = 0; z < tiles->size(); ++z)
      EXPECT_TRUE(std::includes((*perhaps)[z].begin(), (*perhaps)[z].end(), (*tiles)[z].begin(), (*tiles)[z].end()));
  }
}

TEST(pyramid_laws, blocks_made_by_different_processes_in_any_order_make_the_same_pyramid) {
  const AnyLand land(13, 900, 50, true, kIsland);
  const auto whole = make_small_pyramid(land, kIsland, 2);
  const std::vector<TileId> blocks = find_blocks(whole->plan);
  ASSERT_GT(blocks.size(), 3u);
  std::map<Kept::Key, std::vector<std::uint8_t>> files;
  std::vector<BlockReport> reports;
  for (auto block = blocks.rbegin(); block != blocks.rend(); ++block) {
    Kept kept;
    auto made = make_block(whole->plan, *block, land, kept);
    ASSERT_TRUE(made) << made.error().message;
    reports.push_back(std::move(*made));
    files.merge(kept.files);
    EXPECT_TRUE(kept.files.empty()) << "a tile of two blocks";
  }
  Kept top;
  const auto report = finish_pyramid(whole->plan, std::move(reports), top);
  ASSERT_TRUE(report) << report.error().message;
  files.merge(top.files);
  EXPECT_EQ(files, whole->kept.files);
  EXPECT_EQ(report->tiles, whole->report.tiles);
  for (std::size_t z = 0; z < report->levels.size(); ++z) {
    EXPECT_EQ(report->levels[z].bytes, whole->report.levels[z].bytes);
    EXPECT_EQ(report->levels[z].bound, whole->report.levels[z].bound);
  }
}

TEST(pyramid_laws, blocks_follow_a_curve_of_neighbours) {
  SourceFacts source{{-180, -90, 180, 90}, 1, 0, 100};
  PyramidSettings settings;
  settings.max_zoom = 9;
  const PyramidPlan plan = *plan_pyramid(source, settings);
  const std::vector<TileId> blocks = find_blocks(plan);
  ASSERT_EQ(blocks.size(), 2u << (2 * plan.block_level));
  for (std::size_t k = 1; k < blocks.size(); ++k) {
    const std::int64_t right = std::int64_t{blocks[k].x} - blocks[k - 1].x,
                       up = std::int64_t{blocks[k].y} - blocks[k - 1].y;
    EXPECT_EQ(std::abs(right) + std::abs(up), 1) << "at block " << k;
  }
}

TEST(pyramid_laws, every_tile_with_heights_is_there_with_its_ancestors_and_siblings) {
  const AnyLand land(7, 900, 50, false, kIsland);
  const auto made = make_small_pyramid(land, kIsland, 2);
  std::set<Kept::Key> expected;
  for (int z = 0; z <= made->plan.max_zoom(); ++z) {
    for (std::uint32_t y = 0; y < std::uint32_t{1} << z; ++y) {
      for (std::uint32_t x = 0; x < std::uint32_t{2} << z; ++x) {
        const DegreeBox box = TileGrid{}.bounds_of({z, x, y});
        const bool meets = box.west < kIsland.east && box.east > kIsland.west && box.south < kIsland.north &&
                           box.north > kIsland.south;
        if (!meets) continue;
        expected.insert({z, x, y});
        if (z == 0 || z > made->plan.block_level) continue;
        for (const std::uint32_t k : {0u, 1u, 2u, 3u}) expected.insert({z, (x & ~1u) + (k & 1), (y & ~1u) + (k >> 1)});
      }
    }
  }
  expected.insert({0, 0, 0});
  expected.insert({0, 1, 0});
  for (const Kept::Key& key : expected) {
    const auto [z, x, y] = key;
    // A corner of a tile may hold none of its nodes.
    if (made->kept.files.count(key) == 0) {
      const auto tile = make_tile(made->plan, {z, x, y}, land);
      ASSERT_TRUE(tile);
      EXPECT_TRUE(z > made->plan.block_level) << z << "/" << x << "/" << y;
      for (const std::int32_t height : tile->heights) EXPECT_EQ(height, 0);
    }
  }
  for (const auto& [key, bytes] : made->kept.files) EXPECT_TRUE(expected.count(key) > 0);
  std::uint64_t tiles = 0;
  for (const LevelSummary& level : made->report.levels) tiles += level.tiles;
  EXPECT_EQ(tiles, made->kept.files.size());
}

TEST(pyramid_laws, bounds_above_the_blocks_hold_for_all_nodes_below) {
  const AnyLand land(11, 900, 120, true, kIsland);
  for (const TileGrid& grid : kGrids) {
    const auto made = make_small_pyramid(land, kIsland, 2, grid);
    ASSERT_EQ(made->plan.block_level, 2);
    for (int z = 0; z < made->plan.block_level; ++z) {
      for (const std::uint64_t id : made->report.tiles[static_cast<std::size_t>(z)]) {
        const TileId tile{z, static_cast<std::uint32_t>(id), static_cast<std::uint32_t>(id >> 32)};
        const TerrainTile& mesh = made->kept.tile(tile);
        const double error = brute_force(decode(mesh, grid), tile, nodes_of(made->plan, z), land, 0, grid);
        EXPECT_LE(error, mesh.node_error) << grid.name() << " " << z << "/" << tile.x << "/" << tile.y;
        EXPECT_GE(error, 0.5 * mesh.node_error) << "the bound says little";
      }
    }
  }
}

void expect_same_edges(const DegreeBox& covered, int least, const TileGrid& grid = {},
                       const std::vector<DegreeLine>& lines = {}) {
  const AnyLand land(11, 900, 120, true, covered);
  const auto made = make_small_pyramid(land, covered, 2, grid, 0, lines);
  int edges = 0;
  for (int z = 0; z <= made->plan.max_zoom(); ++z) {
    const std::uint32_t across = grid.columns(z);
    for (const auto& [key, bytes] : made->kept.files) {
      const auto [level, x, y] = key;
      if (level != z) continue;
      const QuantizedMesh here = *decode_quantized_mesh(bytes, "tile");
      if (const auto east = made->kept.files.find({z, (x + 1) % across, y}); east != made->kept.files.end()) {
        const QuantizedMesh there = *decode_quantized_mesh(east->second, "tile");
        EXPECT_EQ(without_dust(edge_of(here, here.east, here.v)), without_dust(edge_of(there, there.west, there.v)));
        ++edges;
      }
      if (const auto north = made->kept.files.find({z, x, y + 1}); north != made->kept.files.end()) {
        const QuantizedMesh there = *decode_quantized_mesh(north->second, "tile");
        EXPECT_EQ(without_dust(edge_of(here, here.north, here.u)), without_dust(edge_of(there, there.south, there.u)));
        ++edges;
      }
    }
  }
  EXPECT_GT(edges, least);
}

TEST(pyramid_laws, neighbours_in_a_pyramid_decode_to_the_same_edge) {
  expect_same_edges(kIsland, 300);
  expect_same_edges(kIsland, 100, kGrids[1]);
  expect_same_edges(kIsland, 300, {}, kRivers);
  // Around the antimeridian, up to where the grid ends.
  expect_same_edges({170, 78, 190, 90}, 50, kGrids[1]);
}

TEST(pyramid_laws, land_that_ends_just_before_an_edge_is_seen_by_the_tile_behind_it) {
  expect_same_edges({100, 20, 179.95, 22.45}, 50);
  expect_same_edges({45.05, 44.95, 60, 50}, 50);
}

TEST(grid_laws, rows_of_mercator_are_those_of_the_librarys_functions_and_of_the_level_below) {
  const TileGrid grid = kGrids[1];
  constexpr std::int64_t kLast = 1 << 14;
  for (std::int64_t row = 0; row <= kLast; ++row) {
    const double place = 3.141592653589793 * (1 - 2 * static_cast<double>(row) / kLast);
    EXPECT_NEAR(grid.latitude(row, kLast), std::atan(std::sinh(place)) * 57.29577951308232, 1e-12);
    EXPECT_EQ(grid.latitude(row, kLast), -grid.latitude(kLast - row, kLast));
    EXPECT_EQ(grid.latitude(row, kLast), grid.latitude(2 * row, 2 * kLast));
  }
  EXPECT_NEAR(grid.bounds().north, 85.0511287798066, 1e-12);
  EXPECT_EQ(grid.latitude(1, 2), 0);
  for (const TileGrid& one : kGrids) {
    EXPECT_EQ(TileGrid::find(one.name())->kind, one.kind);
    EXPECT_EQ(TileGrid::find_projection(one.projection())->kind, one.kind);
  }
}

TEST(grid_laws, a_raster_beyond_the_grids_end_is_refused_and_one_across_it_is_cut) {
  PyramidSettings settings;
  settings.grid = kGrids[1];
  const auto beyond = plan_pyramid(SourceFacts{{10, 86, 20, 89}, 1000, 0, 100}, settings);
  ASSERT_FALSE(beyond);
  EXPECT_NE(beyond.error().message.find("ends at 85.0511"), std::string::npos);
  const auto across = plan_pyramid(SourceFacts{{10, 80, 20, 89}, 1000, 0, 100}, settings);
  ASSERT_TRUE(across);
  EXPECT_EQ(across->covered.north, settings.grid.bounds().north);
  // Twice the error and half the tiles across of the geographic grid's level; so fine a level is one more.
  EXPECT_EQ(settings.grid.geometric_error(5), TileGrid{}.geometric_error(4));
  const SourceFacts equator{{10, -1, 20, 1}, 30, 0, 100};
  const auto web = plan_pyramid(equator, settings), degrees = plan_pyramid(equator);
  EXPECT_EQ(web->max_zoom(), degrees->max_zoom() + 1);
  EXPECT_EQ(web->levels.back().max_error, degrees->levels.back().max_error);
  // Rows of a block that crowd at the end of the grid keep places of their own.
  settings.cells = 256;
  settings.max_zoom = 5;
  EXPECT_GT(plan_pyramid(SourceFacts{{-180, -90, 180, 90}, 1000, 0, 100}, settings)->block_level, 0);
}

TEST(globe_laws, sines_are_those_of_the_library) {
  for (double degrees = -720; degrees <= 720; degrees += 0.37) {
    const SineCosine at = sine_of_degrees(degrees);
    EXPECT_NEAR(at.sine, std::sin(degrees * 0.017453292519943295), 4e-16 + 2e-16 * std::abs(degrees) / 57);
    EXPECT_NEAR(at.cosine, std::cos(degrees * 0.017453292519943295), 4e-16 + 2e-16 * std::abs(degrees) / 57);
  }
  EXPECT_EQ(sine_of_degrees(90).sine, 1);
  EXPECT_EQ(sine_of_degrees(180).sine, 0);
  EXPECT_EQ(sine_of_degrees(-90).cosine, 0);
}

TEST(globe_laws, triangles_lie_below_the_ellipsoid_by_no_more_than_the_sag) {
  const PyramidPlan plan = plan_of(0, 0, 9, 16, Effort::kFast);
  const AnyLand sea(1, 0, 0, false, {-180, -90, 180, 90});
  const Globe globe{Geodetic{}};
  for (const TileId id : {TileId{4, 0, 0}, TileId{5, 30, 16}, TileId{7, 100, 64}, TileId{9, 3, 511}}) {
    const auto tile = make_tile(plan, id, sea);
    ASSERT_TRUE(tile) << tile.error().message;
    EXPECT_LE(tile->sag, plan.levels[static_cast<std::size_t>(id.z)].geometric_error / 8);
    const DegreeBox box = TileGrid{}.bounds_of(id);
    double deepest = 0;
    for (std::size_t k = 0; k < tile->triangles.size(); k += 3) {
      std::array<Space, 3> corners;
      for (std::size_t c = 0; c < 3; ++c) {
        const std::uint32_t v = tile->triangles[k + c];
        corners[c] = globe.position(box.west + (box.east - box.west) * tile->u[v] / 32767.0,
                                    box.south + (box.north - box.south) * tile->v[v] / 32767.0, 0);
      }
      for (int a = 0; a <= 8; ++a) {
        for (int b = 0; a + b <= 8; ++b) {
          const Space p =
              sum(sum(scaled(corners[0], a / 8.0), scaled(corners[1], b / 8.0)), scaled(corners[2], (8 - a - b) / 8.0));
          // Depth below the ellipsoid, along the way to the centre: less than along the vertical.
          const double f = 1 / 298.257223563, polar = 6378137 * (1 - f);
          const double scale =
              std::sqrt((p[0] * p[0] + p[1] * p[1]) / (6378137.0 * 6378137.0) + p[2] * p[2] / (polar * polar));
          deepest = std::max(deepest, (1 - scale) * polar);
        }
      }
    }
    EXPECT_LE(deepest, tile->sag * (1 + 1e-6));
    EXPECT_GE(deepest, 0.5 * tile->sag);
  }
}

}  // namespace
}  // namespace scarp::tile_laws_test
