#include "refine/release.h"

#include <cstdint>
#include <utility>

#include "geom/predicates.h"

namespace scarp {

namespace {

/// Delaunay's rule where the bound allows it.
class CarefulRule final : public FlipRule {
 public:
  explicit CarefulRule(const Judge& judge) : judge_(judge) {}

  bool should_flip(const Triangulation& tin, HalfEdge h) override {
    if (tin.is_outside(h / 3)) return false;
    const auto corner = [&](HalfEdge g) { return tin.point(tin.origin(g)); };
    const Point a = corner(h), b = corner(Triangulation::next(h)), c = corner(Triangulation::previous(h));
    const Point d = corner(Triangulation::previous(tin.twin(h)));
    return in_circle(a, b, c, d) > 0 && keeps_bound({c, d, b}) && keeps_bound({d, c, a});
  }
  const Effort& effort() const { return effort_; }

 private:
  bool keeps_bound(const std::array<Point, 3>& corners) {
    const Fit fit = judge_.fit(corners, {});
    effort_.samples_scanned += fit.scanned;
    ++effort_.triangles_scanned;
    return !judge_.find_candidate(corners, fit);
  }

  const Judge& judge_;
  Effort effort_;
};

}  // namespace

Effort release_seams(Triangulation& tin, const Judge& judge, std::vector<HalfEdge> seams) {
  CarefulRule rule(judge);
  tin.improve(seams, rule, SIZE_MAX);
  return rule.effort();
}

}  // namespace scarp
