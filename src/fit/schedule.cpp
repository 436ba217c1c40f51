#include "fit/schedule.h"

#include <algorithm>

#include "fit/collapse.h"
#include "fit/flips.h"
#include "fit/removal_queue.h"
#include "fit/vertex_step.h"

namespace scarp::fit {

namespace {

using Id = Patch::Id;

/// If all vertices are locked, the patch may exceed the range of the arithmetic (cut.h).
bool has_free_vertex(const Patch& patch) {
  for (Id v = 0; v < patch.node_count(); ++v) {
    if (!patch.is_locked(v)) return true;
  }
  return false;
}

}  // namespace

Schedule::Schedule(Patch& patch, const TriangleError& error, ErrorRule::Power power, const RepairOptions& options)
    : patch_(patch),
      strict_(error.with({1, power})),
      loose_(error.with({options.depth.slack, power})),
      options_(options),
      repair_(patch, loose_, options.depth, options.rules),
      is_settled_(patch.node_count(), 0) {}

void Schedule::measure_all() {
  for (Id f = 0; f < patch_.face_count(); ++f) {
    if (patch_.face(f).corners[0] != tin::kNone) measure(patch_, strict_, f);
  }
}

struct Schedule::Removals {
  Schedule& of;
  std::size_t most, left;  // triangles

  bool wants(Id v) const { return of.is_wanted(v) && !of.patch_.is_removed(v); }
  bool is_over() const { return left <= most || of.is_time_up(); }
  float energy_of(Id f) const { return of.patch_.face(f).energy; }
  std::span<const Id> remove(Id v, const Patch::Star& star, std::span<const Patch::RingTriangle> triangles) {
    ++of.counts_.tried;
    if (!of.repair_.remove(v, star, triangles)) return {};
    ++of.counts_.removed;
    left -= star.faces.size() - triangles.size();
    return of.repair_.changed();
  }
};

void Schedule::remove_all(std::size_t most) {
  std::fill(is_settled_.begin(), is_settled_.end(), std::uint8_t{0});
  Removals pass{*this, most, patch_.count_faces()};
  RemovalQueue(patch_, loose_, options_.rules.shape).run(pass);
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
    if (a == tin::kNone || !(is_wanted(a) || is_wanted(b) || is_wanted(c))) continue;
    for (unsigned edge = 0; edge < 3; ++edge) {
      if (flips.improve(strict_, f, edge)) unsettle_flipped(f);
    }
  }
  for (Id f = 0; f < patch_.face_count(); ++f) {
    for (unsigned edge = 0; edge < 3 && patch_.face(f).corners[0] != tin::kNone; ++edge) {
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

/// The new edge is the last of both faces.
void Schedule::unsettle_flipped(Id face) {
  const Patch::Quad q = patch_.quad(face, 2);
  for (const Id v : {q.a, q.b, q.c, q.d}) is_settled_[v] = 0;
}

void Schedule::shake() {
  VertexStep step(patch_, options_.rules);
  std::fill(is_settled_.begin(), is_settled_.end(), std::uint8_t{0});
  std::uint32_t dice = options_.shake;
  for (Id v = 0; v < patch_.node_count(); ++v) {
    // The congruential generator of Numerical Recipes, with mixed bits.
    dice = dice * 1664525u + 1013904223u;
    if (!patch_.is_removed(v)) step.shake(strict_, v, (dice ^ dice >> 15) * 0x2c1b3c6du);
  }
}

RepairCounts repair_vertices(Patch& patch, const TriangleError& error, const RepairOptions& options) {
  if (!has_free_vertex(patch)) return {};
  Schedule schedule(patch, error, ErrorRule::Power::kEight, options);
  schedule.measure_all();
  if (options.shake != 0) schedule.shake();
  schedule.sweep();
  schedule.remove_all(options.most);
  if (options.depth.collapses && options.rules.freedom == Freedom::kLattice) schedule.collapse();
  if (options.polishes == 0) return schedule.counts();
  RepairOptions all = options;
  all.wanted = {};
  Schedule polish(patch, error, ErrorRule::Power::kTwo, all);
  polish.measure_all();
  for (int i = 0; i < options.polishes; ++i) polish.sweep();
  return schedule.counts();
}

}  // namespace scarp::fit
