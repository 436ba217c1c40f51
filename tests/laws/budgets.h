// Laws of every mesh within a budget, and terrain whose meshes fill budgets well.
#pragma once

#include <rapidcheck/gtest.h>

#include <cmath>

#include "laws/fields.h"
#include "scarp/measure.h"
#include "scarp/simplify.h"

namespace scarp::testing {

/// Smooth terrain: the number of triangles is a power of the bound, without jumps.
inline Field hills(int cols, int rows) {
  Field field{cols, rows, {}};
  for (int y = 0; y < rows; ++y) {
    for (int x = 0; x < cols; ++x) {
      const double large = 40 * std::sin(0.05 * x) * std::cos(0.07 * y), small = 10 * std::sin(0.2 * x + 0.13 * y);
      field.samples.push_back(static_cast<float>(large + small + 3 * std::sin(0.9 * x) * std::cos(0.8 * y)));
    }
  }
  return field;
}

inline bool is_within(const Simplified& made, const SimplifyOptions& options) {
  return made.mesh.vertex_count() <= options.goals.max_vertices.value_or(made.mesh.vertex_count()) &&
         made.mesh.triangle_count() <= options.goals.max_triangles.value_or(made.mesh.triangle_count());
}

/// Laws: the mesh satisfies the budgets, is sound, and has the reported and guaranteed error.
inline void check_budget(const Measurement& seen, const Simplified& made, const SimplifyOptions& options) {
  RC_ASSERT(is_within(made, options));
  RC_ASSERT(seen.is_sound());
  RC_ASSERT(seen.uncovered == 0u);
  RC_ASSERT(seen.max_error == made.measurement.max_error);
  if (made.stop == StopReason::kMaxError) RC_ASSERT(seen.max_error <= *options.goals.max_error + 1e-9);
  if (made.stop == StopReason::kExact) RC_ASSERT(seen.max_error <= 1e-9);
}

}  // namespace scarp::testing
