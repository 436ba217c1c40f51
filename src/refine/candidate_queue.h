// Triangles by their worst sample: the queue of Algorithm III and the list of Algorithms I and II.
#pragma once

#include <algorithm>
#include <cstddef>
#include <cstdint>
#include <vector>

#include "base/array.h"
#include "metric/candidate.h"

namespace scarp::refine {

/// Finds the triangle with the worst candidate.
class CandidateStore {
 public:
  virtual ~CandidateStore() = default;
  virtual bool empty() const = 0;
  /// The triangle whose candidate is the worst. REQUIRES: !empty().
  virtual std::uint32_t worst() const = 0;
  virtual metric::Candidate candidate(std::uint32_t id) const = 0;
  /// Ids below `count` may be used from now on; new triangles have no candidate.
  virtual void grow(std::size_t count) = 0;
  /// Sets or replaces the triangle's candidate.
  virtual void set(std::uint32_t id, const metric::Candidate& candidate) = 0;
  virtual void remove(std::uint32_t id) = 0;
  /// Appends the triangles whose candidate's error is at least `least`, in any order.
  virtual void collect(double least, std::vector<std::uint32_t>& ids) const = 0;
  /// Entries moved or scanned since the beginning.
  virtual std::uint64_t moves() const = 0;
};

/// A 4-ary max-heap of triangle ids with a back-index, so that a rescanned triangle is re-keyed in place (Garland &
/// Heckbert 1995, section 4.3). Uses 24 bytes per triangle.
class CandidateQueue final : public CandidateStore {
 public:
  bool empty() const override { return heap_.empty(); }
  std::uint32_t worst() const override { return heap_[0]; }
  metric::Candidate candidate(std::uint32_t id) const override { return {errors_[id], points_[id]}; }

  void grow(std::size_t count) override {
    const std::size_t known = slots_.size();
    if (count <= known) return;
    slots_.resize(count);
    std::fill(slots_.begin() + known, slots_.end(), kNotQueued);
    errors_.resize(count);  // written when triangles are queued
    points_.resize(count);
  }

  /// Re-keys a queued triangle in place.
  void set(std::uint32_t id, const metric::Candidate& candidate) override {
    std::size_t slot = slots_[id];
    const bool was_queued = slots_[id] != kNotQueued;
    const bool rises = !was_queued || metric::is_worse(candidate, this->candidate(id));
    errors_[id] = candidate.error;
    points_[id] = candidate.at;
    if (!was_queued) {
      slot = heap_.size();
      heap_.push_back(id);
    }
    rises ? sift_up(slot, id) : sift_down(slot, id);
  }

  void remove(std::uint32_t id) override {
    const std::size_t slot = slots_[id];
    if (slot == kNotQueued) return;
    slots_[id] = kNotQueued;
    const std::uint32_t last = heap_.back();
    heap_.pop_back();
    if (last == id) return;
    const bool rises = slot > 0 && metric::is_worse(candidate(last), candidate(heap_[(slot - 1) / 4]));
    rises ? sift_up(slot, last) : sift_down(slot, last);
  }

  void collect(double least, std::vector<std::uint32_t>& ids) const override {
    std::vector<std::size_t> slots;
    if (!heap_.empty()) slots.push_back(0);
    while (!slots.empty()) {
      const std::size_t slot = slots.back();
      slots.pop_back();
      if (!(errors_[heap_[slot]] >= least)) continue;
      ids.push_back(heap_[slot]);
      for (std::size_t child = 4 * slot + 1; child < 4 * slot + 5 && child < heap_.size(); ++child)
        slots.push_back(child);
    }
  }
  std::uint64_t moves() const override { return moves_; }

 private:
  static constexpr std::uint32_t kNotQueued = 0xffffffffu;

  void place(std::size_t slot, std::uint32_t id) {
    ++moves_;
    heap_[slot] = id;
    slots_[id] = static_cast<std::uint32_t>(slot);
  }
  void sift_up(std::size_t slot, std::uint32_t id) {
    const metric::Candidate moved = candidate(id);
    while (slot > 0) {
      const std::size_t parent = (slot - 1) / 4;
      if (!metric::is_worse(moved, candidate(heap_[parent]))) break;
      place(slot, heap_[parent]);
      slot = parent;
    }
    place(slot, id);
  }
  void sift_down(std::size_t slot, std::uint32_t id) {
    const metric::Candidate moved = candidate(id);
    for (;;) {
      const std::size_t first = 4 * slot + 1, end = first + 4 < heap_.size() ? first + 4 : heap_.size();
      std::size_t best = slot;
      metric::Candidate best_candidate = moved;
      for (std::size_t child = first; child < end; ++child) {
        const metric::Candidate c = candidate(heap_[child]);
        if (metric::is_worse(c, best_candidate)) {
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
  std::uint64_t moves_ = 0;
};

/// An unordered list: finds the worst candidate by scanning every triangle, once after each change.
class CandidateList final : public CandidateStore {
 public:
  bool empty() const override { return count_ == 0; }
  std::uint32_t worst() const override {
    if (!known_) {
      bool any = false;
      for (std::uint32_t id = 0; id < candidates_.size(); ++id) {
        if (!(candidates_[id].error >= 0) || (any && !metric::is_worse(candidates_[id], candidates_[worst_]))) continue;
        worst_ = id;
        any = true;
      }
      looked_ += candidates_.size();
      known_ = true;
    }
    return worst_;
  }
  metric::Candidate candidate(std::uint32_t id) const override { return candidates_[id]; }
  void grow(std::size_t count) override { candidates_.resize(count, kNoCandidate); }
  void set(std::uint32_t id, const metric::Candidate& candidate) override {
    count_ += !(candidates_[id].error >= 0);
    candidates_[id] = candidate;
    known_ = false;
  }
  void remove(std::uint32_t id) override {
    count_ -= candidates_[id].error >= 0;
    candidates_[id] = kNoCandidate;
    known_ = false;
  }
  void collect(double least, std::vector<std::uint32_t>& ids) const override {
    for (std::uint32_t id = 0; id < candidates_.size(); ++id) {
      if (candidates_[id].error >= 0 && candidates_[id].error >= least) ids.push_back(id);
    }
  }
  std::uint64_t moves() const override { return looked_; }

 private:
  static constexpr metric::Candidate kNoCandidate{-1, {}};

  std::vector<metric::Candidate> candidates_;  // by triangle
  std::size_t count_ = 0;
  mutable std::uint32_t worst_ = 0;
  mutable bool known_ = false;
  mutable std::uint64_t looked_ = 0;
};

}  // namespace scarp::refine
