// Greedy insertion (Garland & Heckbert 1995, section 4): Algorithm III, and the differences of I, II and IV.
//
// Each triangle of the domain stores its candidate, the most important of its samples that break their bound. The most
// important candidate is inserted, the triangulation restores its edge rule, and exactly the triangles around the new
// vertex are scanned again. When no candidate remains, every sample of every triangle satisfies its bound. Rounding
// does not weaken this, because the metric decides exactly near the bound.
//
// Differences from the paper's program: closed integer scans (no sample falls between two triangles), ties broken by
// raster order instead of memory order, proven termination at any threshold including 0, and nodata (NaN samples,
// triangles marked outside).
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

namespace scarp::refine {

class Refinement {
 public:
  /// The state of the triangles at the start.
  enum class Start {
    kScan,   ///< scan every triangle that is not outside
    kClean,  ///< all satisfy their bounds, or scan() scans triangles that may not
  };
  /// The metric and `tin` must outlive this; no other code may change them. Edges are Delaunay, or data-dependent if
  /// `edges` requests it. Triangles of `tin` do not change until a point is inserted.
  Refinement(const metric::ErrorMetric& metric, tin::Triangulation& tin, Algorithm algorithm = Algorithm::kHeap,
             const EdgeRule& edges = {}, Start start = Start::kScan);

  /// True if no sample breaks its bound.
  bool done() const { return candidates_->empty(); }
  /// Importance of the sample to be inserted next; the metric's goal if done().
  double worst_error() const { return done() ? metric_.goal() : candidates_->candidate(candidates_->worst()).error; }
  /// True if no half-edge ids are available for another insertion (1,431 million triangles).
  bool is_full() const { return tin_.triangle_count() > tin::kNone / 3 - 2; }
  /// Number of triangles that insert_worst() would add to the domain. REQUIRES: !done().
  std::uint32_t next_gain() const;
  /// REQUIRES: !done().
  void insert_worst();
  /// Number of triangles that inserting p would add to the domain; 0 if p is a vertex or outside the domain.
  std::uint32_t gain_at(Point p) const { return gain(tin_.locate(p, tin_.last_touched())); }
  /// Inserts a given sample and rescans around it. REQUIRES: gain_at(p) > 0.
  void insert(Point p);
  /// The same at a known location.
  void insert_at(Point p, tin::Triangulation::Location location);
  /// Triangles around the last inserted vertex: all that its insertion changed.
  const std::vector<tin::Triangle>& changed() const { return star_; }
  /// From now on, edges follow this rule instead of the Delaunay property. It must outlive this. REQUIRES: no EdgeRule.
  void follow(tin::FlipRule* flips) { flips_ = flips; }

  /// The candidates that a batch would insert now, worst first; empty if done(). A sample on an edge may occur twice.
  struct BatchCandidate {
    metric::Candidate candidate;
    tin::Triangle triangle;
  };
  std::vector<BatchCandidate> collect(const Batch& batch) const;
  /// Inserts a sample without scanning the triangles around it until rescan_changed().
  void insert_unseen(Point p, tin::Triangle hint);
  /// True if the triangle was changed since the last rescan_changed().
  bool has_changed(tin::Triangle t) const { return t < changed_.size() && changed_[t] != 0; }
  std::uint32_t gain_near(Point p, tin::Triangle hint) const { return gain(tin_.locate(p, hint)); }
  void rescan_changed();
  /// Scans each of the triangles, whose fits are otherwise unknown, once. REQUIRES: on several threads, a metric that
  /// they may query at the same time, and no EdgeRule.
  void scan(std::span<const tin::Triangle> triangles, int threads = 1);

  std::uint64_t triangle_count() const { return inside_; }
  Work work() const;

 private:
  void add(Point p, tin::Triangulation::Location location);
  /// The result of scanning a triangle.
  struct Look {
    std::optional<metric::Candidate> candidate;
    std::uint64_t samples = 0;
  };
  Look look_at(tin::Triangle t) const;
  void take(tin::Triangle t, const std::optional<metric::Candidate>& candidate);
  void rescan(tin::Triangle t);
  void rescan_all();
  std::uint32_t gain(const tin::Triangulation::Location& location) const;

  const metric::ErrorMetric& metric_;
  tin::Triangulation& tin_;
  Algorithm algorithm_;
  std::unique_ptr<DataDependentRule> rule_;  // null: Delaunay, or by flips_
  tin::FlipRule* flips_ = nullptr;
  std::unique_ptr<CandidateStore> candidates_;
  std::vector<tin::Triangle> star_, unseen_;  // changed by the last insertion, and by insertions not rescanned yet
  std::vector<std::uint8_t> changed_;
  std::uint64_t inside_ = 0, samples_ = 0, triangles_ = 0, passes_ = 0;
};

}  // namespace scarp::refine
