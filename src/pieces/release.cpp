#include "pieces/release.h"

#include <algorithm>
#include <cstdint>
#include <unordered_map>
#include <unordered_set>
#include <utility>

#include "base/parallel.h"
#include "geom/predicates.h"

namespace scarp::pieces {

namespace {

/// The rule's verdict about an edge, and its cost.
struct EdgeVerdict {
  bool flips = false;
  std::uint64_t samples = 0, triangles = 0;
};

EdgeVerdict assess_edge(const tin::Triangulation& tin, const metric::ErrorMetric& metric, tin::HalfEdge h) {
  EdgeVerdict verdict;
  if (tin.is_outside(h / 3)) return verdict;
  const auto corner = [&](tin::HalfEdge g) { return tin.point(tin.origin(g)); };
  const Point a = corner(h), b = corner(tin::Triangulation::next(h)), c = corner(tin::Triangulation::previous(h));
  const Point d = corner(tin::Triangulation::previous(tin.twin(h)));
  // An error so far above the goal breaks the bound despite rounding; a false alarm would only keep the edge.
  metric::FitQuestion question;
  if (metric.goal() > 0) question.give_up_max = 1.001 * metric.goal();
  const auto keeps_bound = [&](const std::array<Point, 3>& corners) {
    const metric::Fit fit = metric.fit(corners, question);
    verdict.samples += fit.scanned;
    ++verdict.triangles;
    return fit.complete && !metric.find_candidate(corners, fit);
  };
  verdict.flips = geom::in_circle(a, b, c, d) > 0 && keeps_bound({c, d, b}) && keeps_bound({d, c, a});
  return verdict;
}

/// The Delaunay rule where the bound allows it. Verdicts computed in advance are valid until one of an edge's triangles
/// changes.
class CarefulRule final : public tin::FlipRule {
 public:
  CarefulRule(const tin::Triangulation& tin, const metric::ErrorMetric& metric, const std::vector<tin::HalfEdge>& edges,
              int threads)
      : metric_(metric) {
    constexpr std::size_t kChunk = 64;
    std::vector<EdgeVerdict> verdicts(edges.size());
    parallel_for((edges.size() + kChunk - 1) / kChunk, threads, [&](std::size_t chunk) {
      const std::size_t end = std::min(edges.size(), (chunk + 1) * kChunk);
      for (std::size_t i = chunk * kChunk; i < end; ++i) verdicts[i] = assess_edge(tin, metric, edges[i]);
    });
    for (std::size_t i = 0; i < edges.size(); ++i) {
      count(verdicts[i]);
      verdicts_[edges[i]] = verdicts[i].flips;
    }
  }

  bool should_flip(const tin::Triangulation& tin, tin::HalfEdge h) override {
    const tin::Triangle t = h / 3, u = tin.twin(h) / 3;
    const auto known = verdicts_.find(h);
    bool flips = false;
    if (known != verdicts_.end() && !changed_.contains(t) && !changed_.contains(u)) {
      flips = known->second;
    } else {
      const EdgeVerdict verdict = assess_edge(tin, metric_, h);
      count(verdict);
      flips = verdict.flips;
    }
    if (flips) changed_.insert({t, u});
    return flips;
  }
  const Work& work() const { return work_; }

 private:
  void count(const EdgeVerdict& verdict) {
    work_.samples_scanned += verdict.samples;
    work_.triangles_scanned += verdict.triangles;
  }

  const metric::ErrorMetric& metric_;
  std::unordered_map<tin::HalfEdge, bool> verdicts_;
  std::unordered_set<tin::Triangle> changed_;
  Work work_;
};

}  // namespace

Work release_seams(tin::Triangulation& tin, const metric::ErrorMetric& metric, std::vector<tin::HalfEdge> seams,
                   int threads) {
  CarefulRule rule(tin, metric, seams, threads);
  tin.improve(seams, rule, SIZE_MAX);
  return rule.work();
}

}  // namespace scarp::pieces
