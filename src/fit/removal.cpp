#include "fit/removal.h"

#include <limits>

#include "fit/lazy_queue.h"
#include "fit/ring_search.h"

namespace scarp {

namespace {

using Id = Patch::Id;

class Removal {
 public:
  Removal(Patch& patch, const TriangleError& error, const ShapeRule& shape, const std::function<bool()>& is_time_up,
          std::vector<std::uint8_t>& settled)
      : patch_(patch),
        error_(error),
        is_time_up_(is_time_up),
        settled_(settled),
        shape_(shape),
        search_(error, shape),
        notes_(patch.node_count()),
        queue_(patch.node_count()) {
    for (Id v = 0; v < patch.node_count(); ++v)
      notes_[v].witness = {patch.at(v).x / kLatticeSteps, patch.at(v).y / kLatticeSteps};
  }

  RemovalCounts run() {
    for (Id v = 0; v < patch_.node_count(); ++v) {
      if (!patch_.is_locked(v) && settled_[v] == 0) offer(v);
    }
    while (!queue_.empty()) {
      for (; !queue_.empty(); take()) {
        if (is_time_up_ && is_time_up_()) return counts_;
      }
      queue_.each_waiting([this](Id v) {
        if (!patch_.is_removed(v)) offer(v);
      });
    }
    return counts_;
  }

 private:
  struct Note {
    std::uint64_t code = 0;  // the triangles that would take the vertex' place
    Point witness;           // against its removal
  };

  float energy_of(Id f) {
    const Patch::Face& face = patch_.face(f);
    if (face.energy < 0) {
      const auto verdict = error_.assess(patch_.at(face.corners[0]), patch_.at(face.corners[1]),
                                         patch_.at(face.corners[2]), std::numeric_limits<float>::infinity());
      patch_.set_measure(f, verdict.worst, verdict.energy);
    }
    return face.energy;
  }

  /// Whether v can go; leaves its star in star_ and the best triangles in search_.
  bool look_at(Id v, float& price) {
    ++counts_.searches;
    Note& note = notes_[v];
    queue_.refresh(v);
    patch_.find_star(v, star_);
    if (star_.ring.size() > RingSearch::kMostCorners) return false;
    ring_.clear();
    for (const Id corner : star_.ring) ring_.push_back(patch_.at(corner));
    if (!search_.find(ring_, patch_.at(v), note.witness)) return false;
    note.code = search_.code();
    float now = 0;
    for (const Id f : star_.faces) now += energy_of(f);
    price = search_.energy() - now;
    if (has_short_edge(shape_, patch_.at(v), ring_)) price -= kShortEdgeFirst;
    return true;
  }

  void offer(Id v) {
    float price = 0;
    settled_[v] = 1;
    if (look_at(v, price)) queue_.push(v, price);
  }

  void take() {
    const Id v = queue_.pop();
    if (!queue_.is_stale(v)) {
      patch_.find_star(v, star_);
      RingSearch::decode(notes_[v].code, star_.ring.size(), triangles_);
      remove(v);
      return;
    }
    float price = 0;
    if (!look_at(v, price)) return;
    if (!queue_.is_first(v, price)) {
      queue_.push(v, price);
      return;
    }
    search_.triangles(triangles_);
    remove(v);
  }

  void remove(Id v) {
    patch_.remove(v, star_, triangles_);
    ++counts_.removed;
    for (const Id u : star_.ring) {
      if (!patch_.is_locked(u)) queue_.touch(u);
    }
  }

  Patch& patch_;
  const TriangleError& error_;
  const std::function<bool()>& is_time_up_;
  std::vector<std::uint8_t>& settled_;
  const ShapeRule& shape_;
  RingSearch search_;
  std::vector<Note> notes_;
  LazyQueue queue_;
  Patch::Star star_;
  std::vector<FitCorner> ring_;
  std::vector<Patch::RingTriangle> triangles_;
  RemovalCounts counts_;
};

}  // namespace

RemovalCounts remove_vertices(Patch& patch, const TriangleError& error, const ShapeRule& shape,
                              const std::function<bool()>& is_time_up, std::vector<std::uint8_t>& settled) {
  return Removal(patch, error, shape, is_time_up, settled).run();
}

}  // namespace scarp
