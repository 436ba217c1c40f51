// The data that a kernel needs about a triangle in a band.
#pragma once

#include <cmath>
#include <utility>

#include "base/branchless.h"
#include "measure/judge_kernels.h"
#include "measure/plan_triangle.h"

namespace scarp::judge {

/// Integers in [lo, hi] and [least, most]; first > second if there are none.
inline std::pair<int, int> whole_between(double lo, double hi, int least, int most) {
  return {static_cast<int>(lesser(greater(std::ceil(lo), least), most + 1.0)),
          static_cast<int>(lesser(greater(std::floor(hi), least - 1.0), most))};
}

/// The rows first … last of a raster.
struct TaskRows {
  std::int32_t first, last, cols;
};

/// Returns false if the facet lies outside the rows. `is_on_lattice`: its corners are multiples of 1/256.
bool make_task(const Facet& facet, const TaskRows& rows, bool is_on_lattice, FacetTask& task);

}  // namespace scarp::judge
