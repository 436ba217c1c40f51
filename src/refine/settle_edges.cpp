#include "refine/settle_edges.h"

#include <algorithm>

#include "refine/fit_cache.h"
#include "refine/quadrilateral.h"

namespace scarp::refine {

namespace {

constexpr double kThin = 0.1;

class SettlingRule final : public tin::FlipRule {
 public:
  SettlingRule(const metric::ErrorMetric& metric, bool keep_bounds)
      : metric_(metric), keep_bounds_(keep_bounds), cache_(metric, true, 0) {}

  bool should_flip(const tin::Triangulation& tin, tin::HalfEdge h) override {
    const Quadrilateral quad(tin, h);
    if (!quad.can_flip() || tin.is_outside(quad.t)) return false;
    if (fatness(quad.other) < std::min(kThin, fatness(quad.kept))) return false;
    const metric::Fit first_kept = cache_.fit_of(tin, quad.t), second_kept = cache_.fit_of(tin, quad.u);
    // Both triangles count the samples on the edge between them.
    const double twice_now = metric_.squares_between(quad.kept[0][0], quad.kept[0][1]);
    const double twice_then = metric_.squares_between(quad.other[0][0], quad.other[0][1]);
    const double squares = first_kept.sum_squares + second_kept.sum_squares - twice_now + twice_then;
    const double largest = std::max(first_kept.max_error, second_kept.max_error);
    const metric::Fit first = cache_.look(quad.other[0], squares);
    if (!first.complete || first.max_error > largest) return false;
    const metric::Fit second = cache_.look(quad.other[1], squares - first.sum_squares);
    if (!second.complete || second.max_error > largest || !(first.sum_squares + second.sum_squares < squares))
      return false;
    if (keep_bounds_ && (metric_.find_candidate(quad.other[0], first) || metric_.find_candidate(quad.other[1], second)))
      return false;
    cache_.remember(quad.t, quad.first_vertices, first);
    cache_.remember(quad.u, quad.second_vertices, second);
    return true;
  }

  Work work() const { return {cache_.samples_scanned(), cache_.triangles_scanned(), 0, 0}; }

 private:
  const metric::ErrorMetric& metric_;
  bool keep_bounds_;
  FitCache cache_;
};

}  // namespace

Work settle_edges(tin::Triangulation& tin, const metric::ErrorMetric& metric, const EdgeRule& rule, bool keep_bounds) {
  if (!rule.data_dependent || !rule.settle || rule.score == EdgeScore::kNormals) return {};
  std::vector<tin::HalfEdge> edges;
  for (tin::HalfEdge h = 0; h < 3 * tin.triangle_count(); ++h) {
    if (tin.twin(h) != tin::kNone && h < tin.twin(h)) edges.push_back(h);
  }
  SettlingRule settling(metric, keep_bounds);
  const std::size_t most = 4 * edges.size();
  tin.improve(edges, settling, most);
  return settling.work();
}

}  // namespace scarp::refine
