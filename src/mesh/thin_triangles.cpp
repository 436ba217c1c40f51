#include "mesh/thin_triangles.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdint>
#include <vector>

#include "mesh/half_edges.h"

namespace scarp::mesh {

namespace {

class Trimmer {
 public:
  Trimmer(Mesh& mesh, double thinnest, double thinnest_border)
      : mesh_(mesh), corners_(mesh.triangles), thinnest_(thinnest), most_(std::max(thinnest, thinnest_border)) {}

  void run() {
    for (std::uint32_t t = 0; t < mesh_.triangle_count(); ++t) {
      if (may_be_thin(t)) pending_.push_back(t);
    }
    if (pending_.empty()) return;
    twins_ = build_twins(corners_);
    on_border_.assign(mesh_.vertex_count(), false);
    for (std::uint32_t h = 0; h < twins_.size(); ++h) {
      if (twins_[h] == kNoHalfEdge) on_border_[corner(h)] = on_border_[corner(next_half_edge(h))] = true;
    }
    dropped_.assign(mesh_.triangle_count(), false);
    while (!pending_.empty()) {
      const std::uint32_t t = pending_.back();
      pending_.pop_back();
      if (!dropped_[t] && may_be_thin(t)) mend(t);
    }
    std::size_t kept = 0;
    for (std::uint32_t t = 0; t < dropped_.size(); ++t) {
      if (dropped_[t]) continue;
      for (std::uint32_t k = 0; k < 3; ++k) corners_[3 * kept + k] = corners_[3 * t + k];
      ++kept;
    }
    corners_.resize(3 * kept);
  }

 private:
  std::uint32_t corner(std::uint32_t h) const { return corners_[h]; }

  double length(std::uint32_t a, std::uint32_t b) const {
    const double *p = &mesh_.positions[3 * std::size_t{a}], *q = &mesh_.positions[3 * std::size_t{b}];
    return std::hypot(q[0] - p[0], q[1] - p[1]);
  }
  /// Height over the longest side; negative if clockwise.
  double height(std::uint32_t a, std::uint32_t b, std::uint32_t c) const {
    const double *p = &mesh_.positions[3 * std::size_t{a}], *q = &mesh_.positions[3 * std::size_t{b}],
                 *r = &mesh_.positions[3 * std::size_t{c}];
    const double area = (q[0] - p[0]) * (r[1] - p[1]) - (q[1] - p[1]) * (r[0] - p[0]);
    return area == 0 ? 0 : area / std::max({length(a, b), length(b, c), length(c, a)});
  }
  double height(std::uint32_t t) const { return height(corner(3 * t), corner(3 * t + 1), corner(3 * t + 2)); }
  bool is_thin(std::uint32_t t) const { return height(t) <= 0 || height(t) < thinnest_; }
  bool may_be_thin(std::uint32_t t) const { return height(t) <= 0 || height(t) < most_; }

  void mend(std::uint32_t t) {
    std::uint32_t longest = 3 * t;
    for (std::uint32_t h = 3 * t + 1; h < 3 * t + 3; ++h) {
      if (length(corner(h), corner(next_half_edge(h))) > length(corner(longest), corner(next_half_edge(longest))))
        longest = h;
    }
    if (twins_[longest] == kNoHalfEdge) {
      drop(longest);
    } else if (is_thin(t)) {
      flip(longest);
    }
  }

  void drop(std::uint32_t h) {
    const std::uint32_t apex = corner(previous_half_edge(h));
    if (on_border_[apex]) return;
    on_border_[apex] = true;
    dropped_[h / 3] = true;
    for (const std::uint32_t side : {next_half_edge(h), previous_half_edge(h)}) {
      twins_[twins_[side]] = kNoHalfEdge;
      pending_.push_back(twins_[side] / 3);
    }
  }

  // h = a→b in t = (a, b, c), its twin b→a in u = (b, a, d): the diagonal a–b becomes d–c, t = (c, d, b), u = (d, c,
  // a).
  void flip(std::uint32_t h) {
    const std::uint32_t g = twins_[h], t = h / 3, u = g / 3;
    const std::uint32_t a = corner(h), b = corner(g), c = corner(previous_half_edge(h)),
                        d = corner(previous_half_edge(g));
    if (!(std::min(height(c, d, b), height(d, c, a)) > std::min(height(t), height(u)))) return;
    const std::uint32_t bc = twins_[next_half_edge(h)], ca = twins_[previous_half_edge(h)],
                        ad = twins_[next_half_edge(g)], db = twins_[previous_half_edge(g)];
    const std::array<std::uint32_t, 6> corners{c, d, b, d, c, a};
    for (std::uint32_t k = 0; k < 3; ++k) {
      corners_[3 * t + k] = corners[k];
      corners_[3 * u + k] = corners[3 + k];
    }
    link(3 * t, 3 * u);
    link(3 * t + 1, db);
    link(3 * t + 2, bc);
    link(3 * u + 1, ca);
    link(3 * u + 2, ad);
    for (const std::uint32_t beside : {3 * t, 3 * u, db, bc, ca, ad}) {
      if (beside != kNoHalfEdge) pending_.push_back(beside / 3);
    }
  }
  void link(std::uint32_t h, std::uint32_t g) {
    twins_[h] = g;
    if (g != kNoHalfEdge) twins_[g] = h;
  }

  Mesh& mesh_;
  std::vector<std::uint32_t>& corners_;
  double thinnest_, most_;
  std::vector<std::uint32_t> twins_, pending_;
  std::vector<bool> on_border_, dropped_;
};

}  // namespace

void remove_thin_triangles(Mesh& mesh, double thinnest, double thinnest_border) {
  Trimmer(mesh, thinnest, thinnest_border).run();
}

}  // namespace scarp::mesh
