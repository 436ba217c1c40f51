// The border gives the same overlaps and T-junctions as the search over all triangles.
#include <gtest/gtest.h>
#include <rapidcheck/gtest.h>

#include <cmath>
#include <numeric>
#include <random>

#include "measure/topology.h"
#include "scarp/measure.h"

namespace scarp::topology_laws_test {
namespace {

struct Counts {
  bool is_single_layer = false;
  std::uint64_t overlaps = 0, t_junctions = 0, loops = 0, open = 0;
};

bool looks_up(const Mesh& mesh, std::size_t t) {
  const double* a = &mesh.positions[3 * std::size_t{mesh.triangles[3 * t]}];
  const double* b = &mesh.positions[3 * std::size_t{mesh.triangles[3 * t + 1]}];
  const double* c = &mesh.positions[3 * std::size_t{mesh.triangles[3 * t + 2]}];
  return (b[0] - a[0]) * (c[1] - a[1]) > (b[1] - a[1]) * (c[0] - a[0]);
}

Counts count(const Mesh& mesh, const judge::Connections& connections) {
  std::vector<std::uint32_t> all(mesh.triangle_count());
  std::iota(all.begin(), all.end(), 0u);
  return {connections.is_single_layer, judge::count_overlaps(mesh, all, 1, [](double) { return true; }),
          judge::count_t_junctions(mesh, connections), connections.edges.loops, connections.edges.open.size()};
}

/// Compares the border, if it suffices, with the search over all triangles. Returns true if it sufficed.
bool expect_agreement(const Mesh& mesh) {
  for (std::size_t t = 0; t < mesh.triangle_count(); ++t) {
    if (!looks_up(mesh, t)) return false;
  }
  const Counts quick = count(mesh, judge::connect(mesh, true)), slow = count(mesh, judge::connect(mesh, false));
  RC_ASSERT(!slow.is_single_layer);
  if (quick.is_single_layer) RC_ASSERT(slow.overlaps == 0u);
  RC_ASSERT(quick.t_junctions == slow.t_junctions);
  RC_ASSERT(quick.loops == slow.loops);
  RC_ASSERT(quick.open == slow.open);
  return quick.is_single_layer;
}

/// A ramp of `turns` around a column, each step a pair of triangles. The radius grows by `outwards` per turn.
Mesh spiral(double turns, double outwards, double width, double tilt) {
  Mesh mesh;
  const int steps = std::max(3, static_cast<int>(turns * 40));
  for (int i = 0; i <= steps; ++i) {
    const double angle = 2 * M_PI * turns * i / steps + tilt, r = 10 + outwards * turns * i / steps;
    for (const double radius : {r, r + width})
      mesh.positions.insert(mesh.positions.end(), {radius * std::cos(angle), radius * std::sin(angle), double(i)});
  }
  for (std::uint32_t i = 0; i < static_cast<std::uint32_t>(steps); ++i) {
    const std::uint32_t a = 2 * i;
    mesh.triangles.insert(mesh.triangles.end(), {a, a + 1, a + 3, a, a + 3, a + 2});
  }
  return mesh;
}

/// Squares of two triangles each, rotated by `tilt`; some triangles are omitted and some vertices moved.
Mesh moth_eaten(std::mt19937& random, int side, unsigned holes, double moved, double tilt) {
  Mesh mesh;
  for (int y = 0; y <= side; ++y) {
    for (int x = 0; x <= side; ++x) {
      const double u = x + (random() % 8 == 0 ? moved : 0), v = y + (random() % 8 == 0 ? moved : 0);
      mesh.positions.insert(mesh.positions.end(),
                            {std::cos(tilt) * u - std::sin(tilt) * v, std::sin(tilt) * u + std::cos(tilt) * v, 0});
    }
  }
  const auto add = [&](int a, int b, int c) {
    if (holes != 0 && random() % holes == 0) return;
    for (const int v : {a, b, c}) mesh.triangles.push_back(static_cast<std::uint32_t>(v));
  };
  for (int y = 0; y < side; ++y) {
    for (int x = 0; x < side; ++x) {
      const int a = y * (side + 1) + x, c = a + side + 1;
      add(a, a + 1, c);
      add(a + 1, c + 1, c);
    }
  }
  return mesh;
}

RC_GTEST_PROP(topology_laws, ramps_overlap_from_one_turn_on, ()) {
  const double turns = *rc::gen::inRange(1, 30) / 10.0, tilt = *rc::gen::inRange(0, 7);
  const double outwards = *rc::gen::element(0.0, 3.0, 6.0), width = *rc::gen::element(1.0, 4.0);
  const bool is_quick = expect_agreement(spiral(turns, outwards, width, tilt));
  if (turns != 1) RC_ASSERT(is_quick == (turns < 1 || width < outwards));
}

RC_GTEST_PROP(topology_laws, borders_tell_what_the_search_tells, ()) {
  std::mt19937 random(*rc::gen::arbitrary<std::uint32_t>());
  const unsigned holes = *rc::gen::element(0u, 3u, 10u, 40u);
  const double moved = *rc::gen::element(0.0, 0.25, -0.25, 1e-9), tilt = *rc::gen::element(0.0, 0.5, 1.0);
  Mesh mesh = moth_eaten(random, *rc::gen::inRange(2, 20), holes, moved, tilt);
  if (mesh.triangles.empty()) return;
  const bool is_quick = expect_agreement(mesh);
  if (holes == 0) RC_ASSERT(is_quick);
  // A second piece over it, next to it, or touching it.
  const Mesh other = moth_eaten(random, 5, 0, 0, tilt);
  const double along = *rc::gen::element(0.0, 2.0, 2.5, 5.0, 40.0);
  const auto first = static_cast<std::uint32_t>(mesh.vertex_count());
  for (std::size_t v = 0; v < other.vertex_count(); ++v)
    mesh.positions.insert(mesh.positions.end(),
                          {other.positions[3 * v] + along, other.positions[3 * v + 1], *rc::gen::element(0.0, 1.0)});
  for (const std::uint32_t v : other.triangles) mesh.triangles.push_back(first + v);
  expect_agreement(mesh);
}

}  // namespace
}  // namespace scarp::topology_laws_test
