// The queue of Algorithm III: triangles by their worst sample.
#pragma once

#include <cstdint>

#include "base/array.h"
#include "geom/predicates.h"

namespace scarp {

/// The sample that a triangle would have inserted.
struct Candidate {
  double error = 0;  ///< |plane − sample| by Plane::height_at()
  Point at;
};

/// Larger error first, then raster order: a total order on candidates that are different samples.
inline bool is_worse(const Candidate& a, const Candidate& b) {
  return a.error != b.error ? a.error > b.error : before(a.at, b.at);
}

/// A 4-ary max-heap of triangle ids with a back-index, so that a rescanned triangle is re-keyed in place (Garland &
/// Heckbert 1995, section 4.3). 24 bytes a triangle.
class CandidateQueue {
 public:
  bool empty() const { return heap_.empty(); }
  std::uint32_t worst() const { return heap_[0]; }
  Candidate candidate(std::uint32_t id) const { return {errors_[id], points_[id]}; }

  /// Ids below `count` may be used from now on; new ones are not queued.
  void grow(std::size_t count) {
    while (slots_.size() < count) {
      slots_.push_back(kNotQueued);
      errors_.push_back(0);
      points_.push_back({});
    }
  }

  /// Queues the triangle, or re-keys it where it stands.
  void set(std::uint32_t id, const Candidate& candidate) {
    std::size_t slot = slots_[id];
    const bool was_queued = slots_[id] != kNotQueued;
    const bool rises = !was_queued || is_worse(candidate, this->candidate(id));
    errors_[id] = candidate.error;
    points_[id] = candidate.at;
    if (!was_queued) {
      slot = heap_.size();
      heap_.push_back(id);
    }
    rises ? sift_up(slot, id) : sift_down(slot, id);
  }

  void remove(std::uint32_t id) {
    const std::size_t slot = slots_[id];
    if (slot == kNotQueued) return;
    slots_[id] = kNotQueued;
    const std::uint32_t last = heap_.back();
    heap_.pop_back();
    if (last == id) return;
    const bool rises = slot > 0 && is_worse(candidate(last), candidate(heap_[(slot - 1) / 4]));
    rises ? sift_up(slot, last) : sift_down(slot, last);
  }

 private:
  static constexpr std::uint32_t kNotQueued = 0xffffffffu;

  void place(std::size_t slot, std::uint32_t id) {
    heap_[slot] = id;
    slots_[id] = static_cast<std::uint32_t>(slot);
  }
  void sift_up(std::size_t slot, std::uint32_t id) {
    const Candidate moved = candidate(id);
    while (slot > 0) {
      const std::size_t parent = (slot - 1) / 4;
      if (!is_worse(moved, candidate(heap_[parent]))) break;
      place(slot, heap_[parent]);
      slot = parent;
    }
    place(slot, id);
  }
  void sift_down(std::size_t slot, std::uint32_t id) {
    const Candidate moved = candidate(id);
    for (;;) {
      const std::size_t first = 4 * slot + 1, end = first + 4 < heap_.size() ? first + 4 : heap_.size();
      std::size_t best = slot;
      Candidate best_candidate = moved;
      for (std::size_t child = first; child < end; ++child) {
        const Candidate c = candidate(heap_[child]);
        if (is_worse(c, best_candidate)) {
          best = child;
          best_candidate = c;
        }
      }
      if (best == slot) break;
      place(slot, heap_[best]);
      slot = best;
    }
    place(slot, id);
  }

  Array<std::uint32_t> heap_;
  Array<std::uint32_t> slots_;  // by triangle
  Array<double> errors_;        // by triangle
  Array<Point> points_;         // by triangle
};

}  // namespace scarp
