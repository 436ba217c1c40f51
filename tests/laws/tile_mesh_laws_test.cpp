// The mesh of a tile against the flipping triangulation: the same triangles for the same points.
#include <gtest/gtest.h>
#include <rapidcheck/gtest.h>

#include <random>

#include "laws/tile_meshes.h"

namespace scarp::tile_mesh_laws_test {
namespace {

using testing::Field;
using testing::Relief;

enum class Lie { kAnywhere, kOnBorder, kOnFewLines, kInCorner };

Point random_point(std::mt19937& random, std::int32_t cols, std::int32_t rows, Lie lie) {
  const auto below = [&](std::int32_t n) { return static_cast<std::int32_t>(random() % static_cast<unsigned>(n)); };
  switch (lie) {
    case Lie::kOnBorder:
      return random() % 2 == 0 ? Point{below(cols), random() % 2 == 0 ? 0 : rows - 1}
                               : Point{random() % 2 == 0 ? 0 : cols - 1, below(rows)};
    case Lie::kOnFewLines: {
      const std::int32_t k = below(std::min(cols, rows));
      return random() % 2 == 0 ? Point{k, k} : Point{k, rows / 2};
    }
    case Lie::kInCorner:
      return {below(std::min(cols, 9)), below(std::min(rows, 9))};
    case Lie::kAnywhere:
      break;
  }
  return {below(cols), below(rows)};
}

/// Inserts the same points into both, with good and bad hints.
void insert_into_both(tin::TileMesh& mesh, tin::Triangulation& tin, std::mt19937& random, std::int32_t cols,
                      std::int32_t rows, Lie lie, int count) {
  for (int k = 0; k < count; ++k) {
    const Point p = random_point(random, cols, rows, lie);
    mesh.insert(geom::tile_point(p.x, p.y), static_cast<tin::TileMesh::Id>(random() % mesh.triangle_count()));
    tin.insert(p, tin.locate(p, tin.last_touched()));
  }
}

/// Lattice steps of all constrained edges, each once: splitting chains preserves their sum.
template <class Visit>
void visit_constrained(const tin::TileMesh& mesh, Visit&& visit) {
  for (tin::TileMesh::Id t = 0; t < mesh.triangle_count(); ++t) {
    for (unsigned k = 0; k < 3; ++k) {
      const tin::TileMesh::Link link = mesh[t].links[k];
      if (tin::TileMesh::is_constrained(link) && t < tin::TileMesh::triangle_of(link))
        visit(geom::point_of(mesh[t].corners[k]), geom::point_of(mesh[t].corners[(k + 1) % 3]));
    }
  }
}
std::int64_t steps(Point a, Point b) { return std::gcd(std::abs(b.x - a.x), std::abs(b.y - a.y)); }
bool is_between(Point a, Point b, Point p) {
  return orient(a, b, p) == 0 && std::min(a.x, b.x) <= p.x && p.x <= std::max(a.x, b.x) && std::min(a.y, b.y) <= p.y &&
         p.y <= std::max(a.y, b.y);
}

RC_GTEST_PROP(tile_mesh, is_the_triangulation_of_its_points, ()) {
  const auto cols = *rc::gen::element(2, 3, 5, 17, 64, 1000, 4097), rows = *rc::gen::element(2, 3, 9, 64, 777, 4097);
  const Lie lie = *rc::gen::element(Lie::kAnywhere, Lie::kAnywhere, Lie::kOnBorder, Lie::kOnFewLines, Lie::kInCorner);
  std::mt19937 random(*rc::gen::arbitrary<std::uint32_t>());
  tin::TileMesh mesh;
  mesh.reset(cols, rows);
  tin::Triangulation tin(cols, rows);
  for (int round = 0; round < 3; ++round) {
    insert_into_both(mesh, tin, random, cols, rows, round == 1 ? Lie::kOnBorder : lie, 40);
    const std::string broken = testing::verify_tile_mesh(mesh, cols, rows);
    RC_ASSERT(broken == "");
    RC_ASSERT(mesh.vertex_count() == tin.vertex_count());
    RC_ASSERT(mesh.triangle_count() == tin.triangle_count());
    if (!testing::has_ties(tin)) RC_ASSERT(testing::triangles_of(mesh) == testing::triangles_of(tin));
  }
}

RC_GTEST_PROP(tile_mesh, equals_the_triangulation_of_points_in_general_position, ()) {
  std::mt19937 random(*rc::gen::arbitrary<std::uint32_t>());
  tin::TileMesh mesh;
  mesh.reset(4097, 4001);
  tin::Triangulation tin(4097, 4001);
  insert_into_both(mesh, tin, random, 4097, 4001, Lie::kAnywhere, 300);
  RC_PRE(!testing::has_ties(tin));
  RC_ASSERT(testing::triangles_of(mesh) == testing::triangles_of(tin));
}

RC_GTEST_PROP(tile_mesh, insertion_keeps_constraints_and_the_outside, ()) {
  const auto cols = *rc::gen::inRange(2, 40), rows = *rc::gen::inRange(2, 40);
  const auto seed = *rc::gen::arbitrary<std::uint32_t>();
  const Field field = testing::random_field(seed, cols, rows, Relief::kReal, *rc::gen::element(0.02, 0.1, 0.3, 0.7));
  auto domain = refine::build_domain(field.raster(), 0, grid_frame(rows));
  RC_PRE(domain.has_value());
  tin::TileMesh mesh;
  mesh.assign(domain->tin);
  RC_ASSERT(testing::verify_tile_mesh(mesh, cols, rows) == "");
  RC_ASSERT(testing::triangles_of(mesh) == testing::triangles_of(domain->tin));
  std::vector<std::pair<Point, Point>> chains;
  std::int64_t chain_steps = 0;
  visit_constrained(mesh, [&](Point a, Point b) {
    chains.push_back({a, b});
    chain_steps += steps(a, b);
  });
  const std::int64_t area2 = testing::outside_area2(mesh);
  std::mt19937 random(seed);
  for (const Lie lie : {Lie::kAnywhere, Lie::kOnBorder, Lie::kAnywhere}) {
    insert_into_both(mesh, domain->tin, random, cols, rows, lie, 60);
    const std::string broken = testing::verify_tile_mesh(mesh, cols, rows);
    RC_ASSERT(broken == "");
    RC_ASSERT(testing::outside_area2(mesh) == area2);
    std::int64_t left = chain_steps;
    visit_constrained(mesh, [&](Point a, Point b) {
      const bool is_kept = std::any_of(chains.begin(), chains.end(), [&](const auto& chain) {
        return is_between(chain.first, chain.second, a) && is_between(chain.first, chain.second, b);
      });
      RC_ASSERT(is_kept);
      left -= steps(a, b);
    });
    RC_ASSERT(left == 0);
    if (!testing::has_ties(domain->tin)) RC_ASSERT(testing::triangles_of(mesh) == testing::triangles_of(domain->tin));
  }
}

RC_GTEST_PROP(tile_mesh, locates_every_point_from_every_triangle, ()) {
  const auto cols = *rc::gen::inRange(2, 40), rows = *rc::gen::inRange(2, 40);
  const auto seed = *rc::gen::arbitrary<std::uint32_t>();
  const Field field = testing::random_field(seed, cols, rows, Relief::kReal, 0.2);
  auto domain = refine::build_domain(field.raster(), 0, grid_frame(rows));
  RC_PRE(domain.has_value());
  tin::TileMesh mesh;
  mesh.assign(domain->tin);
  std::mt19937 random(seed);
  insert_into_both(mesh, domain->tin, random, cols, rows, Lie::kAnywhere, 30);
  for (int k = 0; k < 200; ++k) {
    const Point p = random_point(random, cols, rows, Lie::kAnywhere);
    const auto hint = static_cast<tin::TileMesh::Id>(random() % mesh.triangle_count());
    const auto& corners = mesh[mesh.locate(geom::tile_point(p.x, p.y), hint)].corners;
    for (std::size_t e = 0; e < 3; ++e)
      RC_ASSERT(orient(geom::point_of(corners[e]), geom::point_of(corners[(e + 1) % 3]), p) >= 0);
  }
}

RC_GTEST_PROP(tile_mesh, a_cavity_says_what_will_change, ()) {
  const auto cols = *rc::gen::inRange(3, 60), rows = *rc::gen::inRange(3, 60);
  std::mt19937 random(*rc::gen::arbitrary<std::uint32_t>());
  tin::TileMesh mesh;
  mesh.reset(cols, rows);
  for (int k = 0; k < 60; ++k) {
    const Point p = random_point(random, cols, rows, k % 3 == 0 ? Lie::kOnBorder : Lie::kAnywhere);
    const tin::TileMesh::Id t = mesh.locate(geom::tile_point(p.x, p.y), 0);
    const auto& corners = mesh[t].corners;
    if (std::find(corners.begin(), corners.end(), geom::tile_point(p.x, p.y)) != corners.end()) continue;
    std::vector<tin::TileMesh::Record> before;
    for (tin::TileMesh::Id id = 0; id < mesh.triangle_count(); ++id) before.push_back(mesh[id]);
    const tin::TileMesh::Cavity cavity = mesh.find_cavity(t, geom::tile_point(p.x, p.y));
    RC_ASSERT(cavity.removed[0] == t);
    const std::vector<tin::TileMesh::Id> removed(cavity.removed.begin(), cavity.removed.end());
    for (std::size_t i = 0; i < cavity.sides.size(); ++i)
      RC_ASSERT(cavity.sides[i].to == cavity.sides[(i + 1) % cavity.sides.size()].from);
    const auto fresh = mesh.fill_cavity(geom::tile_point(p.x, p.y));
    for (const tin::TileMesh::Id id : fresh) {
      RC_ASSERT(mesh[id].corners[0] == geom::tile_point(p.x, p.y));
      RC_ASSERT(mesh[id].key == 0);
    }
    for (tin::TileMesh::Id id = 0; id < before.size(); ++id) {
      if (std::find(removed.begin(), removed.end(), id) == removed.end())
        RC_ASSERT(mesh[id].corners == before[id].corners);
    }
  }
}

TEST(tile_mesh, memory_of_an_earlier_tile_does_not_show) {
  tin::TileMesh used;
  for (std::uint32_t round = 0; round < 6; ++round) {
    const std::int32_t cols = static_cast<std::int32_t>(5 + 40 * (round % 3)), rows = 30;
    tin::TileMesh fresh;
    used.reset(cols, rows);
    fresh.reset(cols, rows);
    std::mt19937 random(round);
    tin::TileMesh::Id hint = 0;
    for (int k = 0; k < 100; ++k) {
      const Point p = random_point(random, cols, rows, k % 4 == 0 ? Lie::kOnBorder : Lie::kAnywhere);
      hint = used.insert(geom::tile_point(p.x, p.y), hint);
      fresh.insert(geom::tile_point(p.x, p.y), hint % static_cast<tin::TileMesh::Id>(fresh.triangle_count()));
    }
    ASSERT_EQ(testing::verify_tile_mesh(used, cols, rows), "");
    ASSERT_EQ(used.vertex_count(), fresh.vertex_count());
  }
}

TEST(tile_mesh, a_vertex_is_not_inserted_twice) {
  tin::TileMesh mesh;
  mesh.reset(9, 9);
  mesh.insert(geom::tile_point(4, 4), 0);
  const tin::TileMesh::Id t = mesh.insert(geom::tile_point(4, 4), 1);
  EXPECT_EQ(mesh.vertex_count(), 5u);
  EXPECT_NE(std::find(mesh[t].corners.begin(), mesh[t].corners.end(), geom::tile_point(4, 4)), mesh[t].corners.end());
}

}  // namespace
}  // namespace scarp::tile_mesh_laws_test
