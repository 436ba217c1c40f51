// Greedy insertion, Algorithm III (Garland & Heckbert 1995, section 4.3).
//
// Each triangle of the domain knows its worst sample; a queue holds the triangles whose worst sample breaks the
// threshold. The worst of all is inserted, the triangulation restores its edge rule, and exactly the triangles around
// the new vertex are scanned again. When the queue is empty, every sample of every triangle is within the threshold -
// not by bookkeeping of rounded numbers: near the threshold exact_error.h decides.
//
// How we differ from the report's program: closed integer scans (no sample falls between two triangles), ties broken by
// raster order instead of memory order, a proven stop at any threshold including 0, voids (NaN samples, triangles
// marked outside).
//
// Cost: expected O((n + m) log m) for n samples and m insertions.
#pragma once

#include <cstdint>
#include <optional>
#include <vector>

#include "grid/raster.h"
#include "refine/candidate_queue.h"
#include "tin/triangulation.h"

namespace scarp {

/// The worst sample of a triangle if it exceeds `threshold`: largest |error|, ties in raster order. Void samples
/// do not count. REQUIRES: corners are valid samples.
std::optional<Candidate> find_candidate(const Raster& raster, const std::array<Point, 3>& corners, double threshold);

class Refinement {
 public:
  /// Scans every triangle that is not outside. The samples and `tin` stay alive and are
  /// changed by nobody else.
  Refinement(const Raster& raster, Triangulation& tin, double threshold);

  /// No sample exceeds the threshold any more.
  bool done() const { return queue_.empty(); }
  /// Error of the sample to be inserted next; the threshold if done().
  double worst_error() const { return done() ? threshold_ : queue_.candidate(queue_.worst()).error; }
  /// No half-edge ids are left for another insertion (1,431 million triangles).
  bool is_full() const { return tin_.triangle_count() > kNone / 3 - 2; }
  /// How many triangles of the domain insert_worst() would add. REQUIRES: !done().
  std::uint32_t next_gain() const;
  /// REQUIRES: !done().
  void insert_worst();
  /// How many triangles of the domain the insertion of p would add; 0 if p is a vertex or outside the domain.
  std::uint32_t gain_at(Point p) const { return gain(tin_.locate(p, tin_.last_touched())); }
  /// Inserts a given sample and rescans around it. REQUIRES: gain_at(p) > 0.
  void insert(Point p) { insert_at(p, tin_.locate(p, tin_.last_touched())); }

  std::uint64_t triangle_count() const { return inside_; }

 private:
  void insert_at(Point p, Triangulation::Location location);
  void rescan(Triangle t);
  std::uint32_t gain(const Triangulation::Location& location) const;

  Raster raster_;
  Triangulation& tin_;
  double threshold_;
  CandidateQueue queue_;
  std::vector<Triangle> star_;
  std::uint64_t inside_ = 0;
};

}  // namespace scarp
