// Greedy insertion (Garland & Heckbert 1995, section 4): Algorithm III, and what differs in I, II and IV.
//
// Each triangle of the domain knows its candidate, the most important of its samples that break their bound. The best
// of all is inserted, the triangulation restores its edge rule, and exactly the triangles around the new vertex are
// scanned again. When no candidate is left, every sample of every triangle keeps its bound. Rounded numbers do not
// weaken this: near the bound the metric decides exactly.
//
// How we differ from the paper's program: closed integer scans (no sample falls between two triangles), ties broken by
// raster order instead of memory order, a proven stop at any threshold including 0, nodata (NaN samples, triangles
// marked outside).
//
// Cost: expected O((n + m) log m) for n samples and m insertions with Algorithm::kHeap.
#pragma once

#include <cstdint>
#include <memory>
#include <span>
#include <vector>

#include "metric/error_metric.h"
#include "refine/candidate_queue.h"
#include "refine/data_dependent.h"
#include "scarp/options.h"
#include "scarp/run.h"
#include "tin/triangulation.h"

namespace scarp {

class Refinement {
 public:
  /// The state of the triangles at the start.
  enum class Start {
    kScan,   ///< scan every triangle that is not outside
    kClean,  ///< all keep their bounds already, or scan() scans those that may not
  };
  /// The metric and `tin` stay alive; no other code changes them. Edges are Delaunay, or follow the data if `edges`
  /// asks for it; triangles of `tin` stay as they are until a point is inserted.
  Refinement(const ErrorMetric& metric, Triangulation& tin, Algorithm algorithm = Algorithm::kHeap,
             const EdgeRule& edges = {}, Start start = Start::kScan);

  /// No sample breaks its bound any more.
  bool done() const { return candidates_->empty(); }
  /// Importance of the sample to be inserted next; the metric's goal if done().
  double worst_error() const { return done() ? metric_.goal() : candidates_->candidate(candidates_->worst()).error; }
  /// No half-edge ids are left for another insertion (1,431 million triangles).
  bool is_full() const { return tin_.triangle_count() > kNone / 3 - 2; }
  /// How many triangles of the domain insert_worst() would add. REQUIRES: !done().
  std::uint32_t next_gain() const;
  /// REQUIRES: !done().
  void insert_worst();
  /// How many triangles of the domain the insertion of p would add; 0 if p is a vertex or outside the domain.
  std::uint32_t gain_at(Point p) const { return gain(tin_.locate(p, tin_.last_touched())); }
  /// Inserts a given sample and rescans around it. REQUIRES: gain_at(p) > 0.
  void insert(Point p);
  /// The same at a known location.
  void insert_at(Point p, Triangulation::Location location);
  /// Triangles around the vertex that was inserted last: all that this changed.
  const std::vector<Triangle>& changed() const { return star_; }
  /// Edges follow this rule from now on in place of the Delaunay property; it stays alive. REQUIRES: no EdgeRule.
  void follow(FlipRule* flips) { flips_ = flips; }

  /// The candidates that a batch would insert now, worst first; empty if done(). A sample on an edge may come twice.
  struct BatchCandidate {
    Candidate candidate;
    Triangle triangle;
  };
  std::vector<BatchCandidate> collect(const Batch& batch) const;
  /// Inserts a sample without scanning the triangles around it until rescan_changed().
  void insert_unseen(Point p, Triangle hint);
  /// True if the triangle was changed since the last rescan_changed().
  bool has_changed(Triangle t) const { return t < changed_.size() && changed_[t] != 0; }
  std::uint32_t gain_near(Point p, Triangle hint) const { return gain(tin_.locate(p, hint)); }
  void rescan_changed();
  /// Scans triangles, whose fits are not known from elsewhere, each once. REQUIRES: on several threads, a metric that
  /// they may ask at the same time, and no EdgeRule.
  void scan(std::span<const Triangle> triangles, int threads = 1);

  std::uint64_t triangle_count() const { return inside_; }
  Work work() const;

 private:
  void add(Point p, Triangulation::Location location);
  /// The result of scanning a triangle.
  struct Look {
    std::optional<Candidate> candidate;
    std::uint64_t samples = 0;
  };
  Look look_at(Triangle t) const;
  void take(Triangle t, const std::optional<Candidate>& candidate);
  void rescan(Triangle t);
  void rescan_all();
  std::uint32_t gain(const Triangulation::Location& location) const;

  const ErrorMetric& metric_;
  Triangulation& tin_;
  Algorithm algorithm_;
  std::unique_ptr<DataDependentRule> rule_;  // null: Delaunay, or as flips_ wants it
  FlipRule* flips_ = nullptr;
  std::unique_ptr<CandidateStore> candidates_;
  std::vector<Triangle> star_, unseen_;  // changed by the last insertion, by those not rescanned yet
  std::vector<std::uint8_t> changed_;
  std::uint64_t inside_ = 0, samples_ = 0, triangles_ = 0, passes_ = 0;
};

}  // namespace scarp
