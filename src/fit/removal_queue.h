// The order in which vertices are removed: the cheapest first.
//
// The price of a vertex is the energy of the best triangles of its ring (ring_search.h) less that of the triangles
// around it. Vertices with a short edge are removed first.
#pragma once

#include <cstdint>
#include <span>
#include <vector>

#include "fit/lazy_queue.h"
#include "fit/patch.h"
#include "fit/ring_search.h"
#include "fit/rules.h"
#include "fit/triangle_error.h"

namespace scarp::fit {

class RemovalQueue {
 public:
  /// All arguments must outlive this object. During its lifetime, nodes are neither added nor deleted.
  RemovalQueue(const Patch& patch, const TriangleError& error, const ShapeRule& shape)
      : patch_(patch), shape_(shape), search_(error, shape), notes_(patch.node_count()), queue_(patch.node_count()) {
    for (Patch::Id v = 0; v < patch.node_count(); ++v) notes_[v].witness = error.sample_near(patch.at(v));
  }

  /// Calls pass.remove(v, star, triangles) for the cheapest vertex until no vertex can be removed, or pass.is_over().
  /// remove() returns the nodes around which something has changed. Vertices for which pass.wants(v) is true are tried
  /// first. pass.energy_of(face): a triangle's energy.
  template <class Pass>
  void run(Pass& pass) {
    for (Patch::Id v = 0; v < patch_.node_count(); ++v) {
      if (!patch_.is_locked(v) && pass.wants(v)) offer(v, pass);
    }
    while (!queue_.empty()) {
      for (; !queue_.empty(); take(pass)) {
        if (pass.is_over()) return;
      }
      queue_.each_waiting([&](Patch::Id v) {
        if (!patch_.is_removed(v)) offer(v, pass);
      });
    }
  }

  std::uint64_t searches() const { return searches_; }

 private:
  struct Note {
    std::uint64_t code = 0;  // the triangles that would replace the vertex, if its ring begins with `first`
    Patch::Id first = tin::kNone;
    Point witness;  // sample that last prevented its removal
  };

  /// True if v's ring has a triangulation. Stores v's star in star_ and the best triangles in search_.
  template <class Pass>
  bool look_at(Patch::Id v, Pass& pass, float& price) {
    ++searches_;
    Note& note = notes_[v];
    queue_.refresh(v);
    patch_.find_star(v, star_);
    if (star_.ring.size() < 3 || star_.ring.size() > RingSearch::kMostCorners) return false;
    ring_.clear();
    for (const Patch::Id corner : star_.ring) ring_.push_back(patch_.at(corner));
    if (!search_.find(ring_, patch_.at(v), note.witness)) return false;
    note.code = search_.code();
    note.first = star_.ring.front();
    float now = 0;
    for (const Patch::Id f : star_.faces) now += pass.energy_of(f);
    price = search_.energy() - now;
    if (has_short_edge(shape_, patch_.at(v), ring_)) price -= kShortEdgeFirst;
    return true;
  }

  template <class Pass>
  void offer(Patch::Id v, Pass& pass) {
    float price = 0;
    if (look_at(v, pass, price)) queue_.push(v, price);
  }

  template <class Pass>
  void take(Pass& pass) {
    const Patch::Id v = queue_.pop();
    patch_.find_star(v, star_);
    // Two flips that cancel each other change no triangle, but may change where a ring begins.
    if (!queue_.is_stale(v) && star_.ring.front() == notes_[v].first) {
      RingSearch::decode(notes_[v].code, star_.ring.size(), triangles_);
      remove(v, pass);
      return;
    }
    float price = 0;
    if (!look_at(v, pass, price)) return;
    if (!queue_.is_first(v, price)) {
      queue_.push(v, price);
      return;
    }
    search_.triangles(triangles_);
    remove(v, pass);
  }

  template <class Pass>
  void remove(Patch::Id v, Pass& pass) {
    const std::span<const Patch::Id> changed = pass.remove(v, star_, triangles_);
    for (const Patch::Id u : changed) {
      if (!patch_.is_locked(u)) queue_.touch(u);
    }
  }

  const Patch& patch_;
  const ShapeRule& shape_;
  RingSearch search_;
  std::vector<Note> notes_;
  LazyQueue queue_;
  Patch::Star star_;
  std::vector<FitCorner> ring_;
  std::vector<Patch::RingTriangle> triangles_;
  std::uint64_t searches_ = 0;
};

}  // namespace scarp::fit
