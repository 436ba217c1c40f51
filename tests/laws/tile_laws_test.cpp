// Laws of tiles on every grid: two neighbours decode to the same edge, and a tile's bound holds for all its nodes.
#include <gtest/gtest.h>
#include <rapidcheck/gtest.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdint>
#include <vector>

#include "globe/globe.h"
#include "globe/sine.h"
#include "laws/any_land.h"
#include "scarp/measure.h"
#include "scarp/tile.h"
#include "tiles/mesh/node_scan.h"
#include "tiles/mesh/tile_lines.h"
#include "tiles/mesh/tile_mesh_parts.h"
#include "tiles/pyramid/coarse_nodes.h"

namespace scarp::tile_laws_test {
namespace {

using namespace testing;  // NOLINT: what the laws of tiles share

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

/// Errors of the tile's decoded triangles at nodes, by the judge of finished meshes.
Measurement judge(const TerrainTile& tile, const tiles::TileNodes& nodes, double limit) {
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
  return *measure(field, tiles::decoded(tile, nodes.steps()), options);
}

RC_GTEST_PROP(tile_laws, the_scan_of_nodes_finds_what_the_judge_finds, ()) {
  double relief = 0, noise = 0;
  const AnyLand land = any_land(relief, noise);
  const int finest = *rc::gen::inRange(1, 9), z = std::max(0, finest - *rc::gen::inRange(0, 4));
  const PyramidPlan plan = plan_of(relief, noise, finest, 32, any_effort());
  const TileId id{z, *rc::gen::inRange<std::uint32_t>(0, std::uint32_t{2} << z),
                  *rc::gen::inRange<std::uint32_t>(0, std::uint32_t{1} << z)};
  const std::int32_t steps = nodes_of(plan, z);
  const tiles::TileNodes nodes = *tiles::TileNodes::read(plan, id, steps, tiles::normal_reach(steps), land);
  TerrainTile tile = *make_tile(plan, id, land);
  // Displaces some vertices, so that nodes around them exceed the limit.
  const double limit = plan.levels[static_cast<std::size_t>(z)].max_error;
  const auto far = static_cast<std::int32_t>(3 * limit / tile.quantum);
  const auto astray = *rc::gen::inRange(0, 5);
  for (int k = 0; k < astray; ++k) tile.heights[*rc::gen::inRange<std::size_t>(0, tile.heights.size())] += far;
  const tiles::NodeErrors errors = tiles::scan_nodes(tile, nodes, limit);
  const Measurement judged = judge(tile, nodes, limit);
  RC_ASSERT(errors.uncovered == 0u);
  RC_ASSERT(std::abs(errors.largest - judged.max_error) <= 1e-9 * (1 + judged.max_error));
  // The scan and the judge name each triangle's worst node; they may name the worst node of two triangles once or
  // twice.
  const auto places = [](const auto& nodes) {
    std::set<std::pair<std::int32_t, std::int32_t>> all;
    for (const auto& node : nodes) all.insert({node.row, node.col});
    return all;
  };
  RC_ASSERT(places(errors.worst) == places(judged.offenders));
  tile.triangles.resize(tile.triangles.size() - 3);
  // The judge tolerates a node outside a triangle by less than a 256th of a step.
  RC_ASSERT(tiles::scan_nodes(tile, nodes, limit).uncovered >= judge(tile, nodes, limit).uncovered);
}

RC_GTEST_PROP(tile_laws, a_limit_of_bytes_changes_the_interior_alone_and_the_bound_stays_true, ()) {
  double relief = 0, noise = 0;
  const AnyLand land = any_land(relief, noise);
  const int finest = *rc::gen::inRange(2, 9), z = std::max(0, finest - *rc::gen::inRange(0, 3));
  PyramidPlan plan = plan_of(relief, noise, finest, 32, any_effort());
  const TileId id{z, *rc::gen::inRange<std::uint32_t>(0, std::uint32_t{2} << z),
                  *rc::gen::inRange<std::uint32_t>(0, std::uint32_t{1} << z)};
  const TileEncoder encode = [](const TerrainTile& tile) { return encode_quantized_mesh(tile); };
  const auto free = make_tile(plan, id, land, encode);
  RC_ASSERT(free.has_value());
  plan.max_tile_bytes = *rc::gen::inRange<std::uint64_t>(1, free->bytes.size() + 100);
  const auto kept = make_tile(plan, id, land, encode);
  RC_ASSERT(kept.has_value());
  const double asked = plan.levels[static_cast<std::size_t>(z)].max_error;
  RC_ASSERT(kept->tile.max_error >= asked);
  if (free->bytes.size() <= plan.max_tile_bytes) RC_ASSERT(kept->bytes == free->bytes);
  // A tile that exceeds the limit contains nothing that may be omitted.
  if (kept->bytes.size() > plan.max_tile_bytes) {
    plan.max_tile_bytes = 1;
    const auto least = make_tile(plan, id, land, encode);
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

/// True if, within rounding, no edge of the mesh crosses the segment between two nodes of the level.
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
  // At a level, the error is twice that of the geographic grid, and half as many tiles are across: equal resolution is
  // one level finer.
  EXPECT_EQ(settings.grid.geometric_error(5), TileGrid{}.geometric_error(4));
  const SourceFacts equator{{10, -1, 20, 1}, 30, 0, 100};
  const auto web = plan_pyramid(equator, settings), degrees = plan_pyramid(equator);
  EXPECT_EQ(web->max_zoom(), degrees->max_zoom() + 1);
  EXPECT_EQ(web->levels.back().max_error, degrees->levels.back().max_error);
  // Rows of a block that crowd at the end of the grid keep distinct places.
  settings.cells = 256;
  settings.max_zoom = 5;
  EXPECT_GT(plan_pyramid(SourceFacts{{-180, -90, 180, 90}, 1000, 0, 100}, settings)->block_level, 0);
}

TEST(globe_laws, sines_are_those_of_the_library) {
  for (double degrees = -720; degrees <= 720; degrees += 0.37) {
    const globe::SineCosine at = globe::sine_of_degrees(degrees);
    EXPECT_NEAR(at.sine, std::sin(degrees * 0.017453292519943295), 4e-16 + 2e-16 * std::abs(degrees) / 57);
    EXPECT_NEAR(at.cosine, std::cos(degrees * 0.017453292519943295), 4e-16 + 2e-16 * std::abs(degrees) / 57);
  }
  EXPECT_EQ(globe::sine_of_degrees(90).sine, 1);
  EXPECT_EQ(globe::sine_of_degrees(180).sine, 0);
  EXPECT_EQ(globe::sine_of_degrees(-90).cosine, 0);
}

TEST(globe_laws, triangles_lie_below_the_ellipsoid_by_no_more_than_the_sag) {
  const PyramidPlan plan = plan_of(0, 0, 9, 16, Effort::kFast);
  const AnyLand sea(1, 0, 0, false, {-180, -90, 180, 90});
  const globe::Globe globe{Geodetic{}};
  for (const TileId id : {TileId{4, 0, 0}, TileId{5, 30, 16}, TileId{7, 100, 64}, TileId{9, 3, 511}}) {
    const auto tile = make_tile(plan, id, sea);
    ASSERT_TRUE(tile) << tile.error().message;
    EXPECT_LE(tile->sag, plan.levels[static_cast<std::size_t>(id.z)].geometric_error / 8);
    const DegreeBox box = TileGrid{}.bounds_of(id);
    double deepest = 0;
    for (std::size_t k = 0; k < tile->triangles.size(); k += 3) {
      std::array<globe::Space, 3> corners;
      for (std::size_t c = 0; c < 3; ++c) {
        const std::uint32_t v = tile->triangles[k + c];
        corners[c] = globe.position(box.west + (box.east - box.west) * tile->u[v] / 32767.0,
                                    box.south + (box.north - box.south) * tile->v[v] / 32767.0, 0);
      }
      for (int a = 0; a <= 8; ++a) {
        for (int b = 0; a + b <= 8; ++b) {
          const globe::Space p =
              globe::sum(globe::sum(globe::scaled(corners[0], a / 8.0), globe::scaled(corners[1], b / 8.0)),
                         globe::scaled(corners[2], (8 - a - b) / 8.0));
          // Depth below the ellipsoid towards the centre, which is less than along the vertical.
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
