// Conversion of a terrain to a solid: top, walls, floor.
//
// At a border vertex where two parts of the domain touch (two cells that share only a corner), the vertical wall edge
// would have four triangles. So each fan of triangles around such a vertex first gets a separate vertex. Then every
// border vertex has one incoming and one outgoing border edge, and walls close around it.
//
// The floor keeps only the corners of the outline. Between two corners, a wall is a polygon in a vertical plane: one
// straight edge of the floor, and above it the border vertices of the terrain in order. Such a polygon ("monotone
// mountain") is triangulated from one end to the other with a stack. Every left turn is cut off (Fournier and Montuno
// 1984, "Triangulating simple polygons and equivalent problems").

#include <algorithm>
#include <cmath>
#include <limits>

#include "mesh/attributes.h"
#include "mesh/close_solid.h"
#include "mesh/exact_orient.h"
#include "mesh/flat_base.h"
#include "mesh/half_edges.h"
#include "scarp/mesh.h"

namespace scarp::mesh {
namespace {

class Closing {
 public:
  Closing(Mesh& mesh, double base)
      : mesh_(mesh), base_(base - mesh.origin[2]), twins_(build_twins(mesh.triangles)), top_(mesh.triangles.size()) {}

  void run(bool step_back) {
    split_fans(step_back);
    const std::vector<std::uint32_t> floor = build_flat_base(mesh_.positions, mesh_.triangles, twins_);
    below_.assign(mesh_.vertex_count(), kNoHalfEdge);
    is_corner_.assign(mesh_.vertex_count(), false);
    for (const std::uint32_t v : floor) is_corner_[v] = true;
    add_walls();
    for (std::size_t t = 0; t < floor.size(); t += 3) add(drop(floor[t]), drop(floor[t + 2]), drop(floor[t + 1]));
  }

 private:
  const double* at(std::uint32_t v) const { return &mesh_.positions[3 * std::size_t{v}]; }

  /// Border half-edges have no twin; exactly one starts at each fan around a vertex.
  void split_fans(bool step_back) {
    std::vector<bool> has_fan(mesh_.vertex_count(), false);
    for (std::uint32_t h = 0; h < top_; ++h) {
      if (twins_[h] != kNoHalfEdge) continue;
      const std::uint32_t vertex = mesh_.triangles[h];
      if (!has_fan[vertex]) {
        has_fan[vertex] = true;
        continue;
      }
      const auto copy = static_cast<std::uint32_t>(mesh_.vertex_count());
      const std::array<double, 2> place = step_back ? step_into(h) : std::array{at(vertex)[0], at(vertex)[1]};
      mesh_.positions.insert(mesh_.positions.end(), {place[0], place[1], double{at(vertex)[2]}});
      append_attributes_of(mesh_, vertex);
      for (std::uint32_t corner = h; corner != kNoHalfEdge; corner = twins_[previous_half_edge(corner)]) {
        mesh_.triangles[corner] = copy;
      }
    }
  }

  /// The direction from the start of a half-edge to the middle of its triangle.
  std::array<double, 2> step_into(std::uint32_t h) const {
    const double *from = at(mesh_.triangles[h]), *b = at(mesh_.triangles[next_half_edge(h)]),
                 *c = at(mesh_.triangles[previous_half_edge(h)]);
    const double x = (b[0] + c[0]) / 2 - from[0], y = (b[1] + c[1]) / 2 - from[1];
    const auto largest = static_cast<float>(std::max(std::abs(from[0]), std::abs(from[1])));
    constexpr double kUnits = 4;
    const double unit = double{std::nextafter(largest, std::numeric_limits<float>::infinity())} - double{largest};
    const double share = kUnits * unit / std::max(std::abs(x), std::abs(y));
    return {double{static_cast<float>(from[0] + share * x)}, double{static_cast<float>(from[1] + share * y)}};
  }

  /// The vertex below another one.
  std::uint32_t drop(std::uint32_t v) {
    if (below_[v] == kNoHalfEdge) {
      below_[v] = static_cast<std::uint32_t>(mesh_.vertex_count());
      const double x = at(v)[0], y = at(v)[1];
      mesh_.positions.insert(mesh_.positions.end(), {x, y, base_});
      append_attributes_of(mesh_, v);
    }
    return below_[v];
  }

  void add(std::uint32_t a, std::uint32_t b, std::uint32_t c) {
    mesh_.triangles.insert(mesh_.triangles.end(), {a, b, c});
  }

  void add_walls() {
    std::vector<std::uint32_t> behind(mesh_.vertex_count(),
                                      kNoHalfEdge);  // along the border, the terrain on the left
    for (std::uint32_t h = 0; h < top_; ++h) {
      if (twins_[h] == kNoHalfEdge) behind[mesh_.triangles[h]] = mesh_.triangles[next_half_edge(h)];
    }
    std::vector<std::uint32_t> run;
    for (std::uint32_t start = 0; start < behind.size(); ++start) {
      if (behind[start] == kNoHalfEdge || !is_corner_[start]) continue;
      run.assign(1, start);
      do {
        run.push_back(behind[run.back()]);
      } while (!is_corner_[run.back()]);
      add_wall(run);
    }
  }

  /// Adds the wall below the border from one corner to the next; seen from outside, the first corner is on the left.
  void add_wall(const std::vector<std::uint32_t>& run) {
    const std::uint32_t low_first = drop(run.front()), low_last = drop(run.back());
    const double along[2] = {at(run.back())[0] - at(run.front())[0], at(run.back())[1] - at(run.front())[1]};
    const std::size_t axis = std::abs(along[0]) >= std::abs(along[1]) ? 0 : 1;
    const double sign = along[axis] > 0 ? 1 : -1;
    const auto point = [&](std::uint32_t v) { return Point2{sign * at(v)[axis], at(v)[2]}; };
    stack_.assign(1, low_last);
    const auto take = [&](std::uint32_t v) {
      while (stack_.size() >= 2 && exact_orient(point(stack_[stack_.size() - 2]), point(stack_.back()), point(v)) > 0) {
        add(stack_[stack_.size() - 2], stack_.back(), v);
        stack_.pop_back();
      }
      stack_.push_back(v);
    };
    for (std::size_t k = run.size(); k-- > 0;) take(run[k]);
    take(low_first);
  }

  Mesh& mesh_;
  double base_;  // the base as an offset
  std::vector<std::uint32_t> twins_;
  std::size_t top_;                   // half-edges of the terrain
  std::vector<std::uint32_t> below_;  // the floor's copy of each vertex
  std::vector<bool> is_corner_;       // for each vertex: used by the floor
  std::vector<std::uint32_t> stack_;
};

}  // namespace

}  // namespace scarp::mesh

namespace scarp {

bool mesh::is_below_all(const Mesh& mesh, double base) {
  const auto offset = static_cast<float>(base - mesh.origin[2]);
  if (!std::isfinite(offset)) return false;
  for (std::size_t i = 2; i < mesh.positions.size(); i += 3) {
    if (!(mesh.origin[2] + mesh.positions[i] > base) || !(static_cast<float>(mesh.positions[i]) > offset)) return false;
  }
  return true;
}

void mesh::close_solid(Mesh& mesh, double base, bool step_back) {
  mesh.normals.clear();
  Closing(mesh, base).run(step_back);
}

bool add_base(Mesh& mesh, double base) {
  if (!mesh::is_below_all(mesh, base)) return false;
  mesh::close_solid(mesh, base, false);
  return true;
}

}  // namespace scarp
