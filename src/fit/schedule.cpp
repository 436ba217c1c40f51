#include "fit/schedule.h"

#include <algorithm>

#include "fit/collapse.h"
#include "fit/flips.h"
#include "fit/vertex_step.h"

namespace scarp {

namespace {

using Id = Patch::Id;

/// Where all are locked, arithmetic may have ended (cut.h).
bool has_free_vertex(const Patch& patch) {
  for (Id v = 0; v < patch.node_count(); ++v) {
    if (!patch.is_locked(v)) return true;
  }
  return false;
}

Point sample_under(const FitCorner& corner) { return {corner.x / kLatticeSteps, corner.y / kLatticeSteps}; }

}  // namespace

Schedule::Schedule(Patch& patch, const TriangleError& error, ErrorRule::Power power, const RepairOptions& options)
    : patch_(patch),
      strict_(error.with({1, power})),
      loose_(error.with({options.depth.slack, power})),
      search_(loose_, options.rules.shape),
      options_(options),
      repair_(patch, loose_, options.depth, options.rules),
      notes_(patch.node_count()),
      queue_(patch.node_count()),
      is_settled_(patch.node_count(), 0) {}

void Schedule::measure_all() {
  for (Id f = 0; f < patch_.face_count(); ++f) {
    if (patch_.face(f).corners[0] != kNone) measure(patch_, strict_, f);
  }
}

void Schedule::remove_all(std::size_t most) {
  std::fill(is_settled_.begin(), is_settled_.end(), std::uint8_t{0});
  left_ = count_faces(patch_);
  for (Id v = 0; v < patch_.node_count(); ++v) notes_[v].witness = sample_under(patch_.at(v));
  for (Id v = 0; v < patch_.node_count(); ++v) {
    if (is_wanted(v) && !patch_.is_locked(v) && !patch_.is_removed(v)) offer(v);
  }
  while (!queue_.empty()) {
    for (; !queue_.empty(); take()) {
      if (left_ <= most || is_time_up()) return;
    }
    queue_.each_waiting([this](Id v) {
      if (!patch_.is_removed(v)) offer(v);
    });
  }
}

void Schedule::collapse() {
  std::fill(is_settled_.begin(), is_settled_.end(), std::uint8_t{0});
  Collapse pass(patch_, loose_, options_.rules, repair_);
  const auto [done, tried] = pass.run([this](Id v) { return is_wanted(v); }, options_.is_time_up);
  counts_.removed += done;
  counts_.tried += tried;
}

void Schedule::sweep() {
  Flips flips(patch_, options_.rules.shape);
  VertexStep step(patch_, options_.rules);
  for (Id f = 0; f < patch_.face_count(); ++f) {
    const auto& [a, b, c] = patch_.face(f).corners;
    if (a == kNone || !(is_wanted(a) || is_wanted(b) || is_wanted(c))) continue;
    for (unsigned edge = 0; edge < 3; ++edge) {
      if (flips.improve(strict_, f, edge)) unsettle_flipped(f);
    }
  }
  for (Id f = 0; f < patch_.face_count(); ++f) {
    for (unsigned edge = 0; edge < 3 && patch_.face(f).corners[0] != kNone; ++edge) {
      if (flips.heal(strict_, f, edge)) unsettle_flipped(f);
    }
  }
  for (Id v = 0; v < patch_.node_count(); ++v) {
    if (!is_wanted(v) || is_settled_[v] != 0 || patch_.is_removed(v)) continue;
    if (!step.improve(strict_, v)) {
      is_settled_[v] = 1;
    } else {
      patch_.find_star(v, star_);
      for (const Id u : star_.ring) is_settled_[u] = 0;
    }
  }
}

/// Its new edge is the last of both faces.
void Schedule::unsettle_flipped(Id face) {
  const Patch::Quad q = patch_.quad(face, 2);
  for (const Id v : {q.a, q.b, q.c, q.d}) is_settled_[v] = 0;
}

void Schedule::shake() {
  VertexStep step(patch_, options_.rules);
  std::fill(is_settled_.begin(), is_settled_.end(), std::uint8_t{0});
  std::uint32_t dice = options_.shake;
  for (Id v = 0; v < patch_.node_count(); ++v) {
    // Numerical Recipes' congruential generator, its bits mixed.
    dice = dice * 1664525u + 1013904223u;
    if (!patch_.is_removed(v)) step.shake(strict_, v, (dice ^ dice >> 15) * 0x2c1b3c6du);
  }
}

/// Whether v's ring has a triangulation; leaves its star in star_ and the best triangles in search_.
bool Schedule::look_at(Id v, float& price) {
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
  if (has_short_edge(options_.rules.shape, patch_.at(v), ring_)) price -= kShortEdgeFirst;
  return true;
}

void Schedule::offer(Id v) {
  float price = 0;
  if (look_at(v, price)) queue_.push(v, price);
}

void Schedule::take() {
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

void Schedule::remove(Id v) {
  ++counts_.tried;
  if (!repair_.remove(v, star_, triangles_)) return;
  ++counts_.removed;
  left_ -= star_.faces.size() - triangles_.size();
  for (const Id u : repair_.changed()) {
    if (!patch_.is_locked(u)) queue_.touch(u);
  }
}

RepairCounts repair_vertices(Patch& patch, const TriangleError& error, const RepairOptions& options) {
  if (!has_free_vertex(patch)) return {};
  Schedule schedule(patch, error, ErrorRule::Power::kEight, options);
  schedule.measure_all();
  if (options.shake != 0) schedule.shake();
  schedule.sweep();
  schedule.remove_all();
  if (options.depth.collapses && options.rules.freedom == Freedom::kLattice) schedule.collapse();
  if (options.polishes == 0) return schedule.counts();
  RepairOptions all = options;
  all.wanted = {};
  Schedule polish(patch, error, ErrorRule::Power::kTwo, all);
  polish.measure_all();
  for (int i = 0; i < options.polishes; ++i) polish.sweep();
  return schedule.counts();
}

std::size_t count_faces(const Patch& patch) {
  std::size_t count = 0;
  for (Id f = 0; f < patch.face_count(); ++f) count += patch.face(f).corners[0] != kNone ? 1 : 0;
  return count;
}

}  // namespace scarp
