#include "fit/relocation.h"

#include <algorithm>

#include "fit/repair.h"
#include "fit/vertex_step.h"

namespace scarp::fit {

void relocate_vertices(Patch& patch, const TriangleError& error, const MoveRules& rules,
                       std::vector<std::uint8_t>& settled) {
  const TriangleError strict = error.with({1, ErrorRule::Power::kEight});
  const auto each_face = [&](const auto& visit) {
    for (Patch::Id f = 0; f < patch.face_count(); ++f) {
      if (patch.face(f).corners[0] != tin::kNone) visit(f);
    }
  };
  // If all vertices are locked, corners may be beyond the range of scans.
  each_face([&](Patch::Id f) {
    const auto& corners = patch.face(f).corners;
    if (!std::all_of(corners.begin(), corners.end(), [&](Patch::Id v) { return patch.is_locked(v); }))
      measure(patch, strict, f);
  });
  VertexStep step(patch, rules);
  Patch::Star star;
  for (Patch::Id v = 0; v < patch.node_count(); ++v) {
    if (patch.is_removed(v) || !step.improve(strict, v)) continue;
    patch.find_star(v, star);
    settled[v] = 0;
    for (const Patch::Id u : star.ring) settled[u] = 0;
  }
  each_face([&](Patch::Id f) { patch.set_measure(f, -1, -1); });
}

}  // namespace scarp::fit
