#include "fit/schedule.h"

#include "fit/collapse.h"
#include "fit/flips.h"
#include "fit/lazy_queue.h"
#include "fit/repair.h"
#include "fit/ring_search.h"
#include "fit/vertex_step.h"

namespace scarp {

namespace {

using Id = Patch::Id;

class Schedule {
 public:
  Schedule(Patch& patch, const TriangleError& error, const RepairOptions& options)
      : patch_(patch),
        strict_(error.with({1, ErrorRule::Power::kEight})),
        loose_(error.with({options.depth.slack, ErrorRule::Power::kEight})),
        search_(loose_, options.rules.shape),
        options_(options),
        repair_(patch, loose_, options.depth, options.rules),
        notes_(patch.node_count()),
        queue_(patch.node_count()) {}

  RepairCounts run() {
    if (!has_free_vertex()) return counts_;
    for (Id f = 0; f < patch_.face_count(); ++f) {
      if (patch_.face(f).corners[0] != kNone) measure(patch_, strict_, f);
    }
    if (options_.shake != 0) shake();
    sweep();
    remove_all();
    if (options_.depth.collapses && options_.rules.freedom == Freedom::kLattice) collapse();
    for (int i = 0; i < options_.polishes; ++i) polish();
    return counts_;
  }

 private:
  void remove_all() {
    for (Id v = 0; v < patch_.node_count(); ++v) notes_[v].witness = sample_of(v);
    for (Id v = 0; v < patch_.node_count(); ++v) {
      if (is_wanted(v) && !patch_.is_locked(v) && !patch_.is_removed(v)) offer(v);
    }
    while (!queue_.empty()) {
      for (; !queue_.empty(); take()) {
        if (is_time_up()) return;
      }
      queue_.each_waiting([this](Id v) {
        if (!patch_.is_removed(v)) offer(v);
      });
    }
  }

  void collapse() {
    Collapse pass(patch_, loose_, options_.rules, repair_);
    const auto [done, tried] = pass.run([this](Id v) { return is_wanted(v); }, options_.is_time_up);
    counts_.removed += done;
    counts_.tried += tried;
  }

  bool is_wanted(Id v) const { return options_.wanted.empty() || options_.wanted[v] != 0; }
  bool is_time_up() const { return options_.is_time_up && options_.is_time_up(); }

  struct Note {
    std::uint64_t code = 0;  // the triangles that would take the vertex' place
    Point witness;           // against its removal
  };

  /// Where all are locked, arithmetic may have ended (cut.h).
  bool has_free_vertex() const {
    for (Id v = 0; v < patch_.node_count(); ++v) {
      if (!patch_.is_locked(v)) return true;
    }
    return false;
  }

  Point sample_of(Id v) const { return {patch_.at(v).x / kLatticeSteps, patch_.at(v).y / kLatticeSteps}; }

  void sweep() {
    Flips flips(patch_, options_.rules.shape);
    VertexStep step(patch_, options_.rules);
    for (Id f = 0; f < patch_.face_count(); ++f) {
      const auto& [a, b, c] = patch_.face(f).corners;
      if (a == kNone || !(is_wanted(a) || is_wanted(b) || is_wanted(c))) continue;
      for (unsigned edge = 0; edge < 3; ++edge) flips.improve(strict_, f, edge);
    }
    for (Id v = 0; v < patch_.node_count(); ++v) {
      if (is_wanted(v) && !patch_.is_removed(v)) step.improve(strict_, v);
    }
  }

  void shake() {
    VertexStep step(patch_, options_.rules);
    std::uint32_t dice = options_.shake;
    for (Id v = 0; v < patch_.node_count(); ++v) {
      // Numerical Recipes' congruential generator, its bits mixed.
      dice = dice * 1664525u + 1013904223u;
      if (!patch_.is_removed(v)) step.shake(strict_, v, (dice ^ dice >> 15) * 0x2c1b3c6du);
    }
  }

  void polish() {
    VertexStep step(patch_, options_.rules);
    for (Id v = 0; v < patch_.node_count(); ++v) {
      if (!patch_.is_removed(v)) step.level(strict_, v);
    }
  }

  /// Whether v's ring has a triangulation; leaves its star in star_ and the best triangles in search_.
  bool look_at(Id v, float& price) {
    queue_.refresh(v);
    patch_.find_star(v, star_);
    if (star_.ring.size() < 3 || star_.ring.size() > RingSearch::kMostCorners) return false;
    ring_.clear();
    for (const Id corner : star_.ring) ring_.push_back(patch_.at(corner));
    if (!search_.find(ring_, patch_.at(v), notes_[v].witness)) return false;
    notes_[v].code = search_.code();
    float now = 0;
    for (const Id f : star_.faces) now += patch_.face(f).energy;
    price = search_.energy() - now;
    return true;
  }

  void offer(Id v) {
    float price = 0;
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
    ++counts_.tried;
    if (!repair_.remove(v, star_, triangles_)) return;
    ++counts_.removed;
    for (const Id u : repair_.changed()) {
      if (!patch_.is_locked(u)) queue_.touch(u);
    }
  }

  Patch& patch_;
  TriangleError strict_, loose_;
  RingSearch search_;
  const RepairOptions& options_;
  Repair repair_;
  std::vector<Note> notes_;
  LazyQueue queue_;
  Patch::Star star_;
  std::vector<FitCorner> ring_;
  std::vector<Patch::RingTriangle> triangles_;
  RepairCounts counts_;
};

}  // namespace

RepairCounts repair_vertices(Patch& patch, const TriangleError& error, const RepairOptions& options) {
  return Schedule(patch, error, options).run();
}

}  // namespace scarp
