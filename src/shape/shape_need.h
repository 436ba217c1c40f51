// A lower bound of the number of triangles that goals for edge lengths need.
#pragma once

#include <cstdint>

#include "base/memory_budget.h"
#include "scarp/options.h"
#include "scarp/result.h"
#include "shape/plan_metric.h"
#include "shape/size_field.h"
#include "tin/triangulation.h"

namespace scarp::shape {

/// Upper bound of edge length / size.
inline constexpr double kGradeFactor = 2;

/// Lower bound of the number of triangles in the surface of `tin`: its area divided by that of an equilateral triangle
/// with the longest allowed edges. Sizes only fall below the given ones (null: without a grade). 0 if edges are
/// unlimited or sizes grow too fast for an estimate. Cost: O(triangles).
double least_triangles(const tin::Triangulation& tin, const PlanMetric& metric, const ShapeGoals& goals,
                       const SizeField* sizes);

/// Fails with kInput if no mesh can have that many triangles, and with kUsage if they do not fit in memory next to
/// `work` bytes.
Result<void> check_need(double triangles, const MemoryBudget& memory, std::uint64_t work);

}  // namespace scarp::shape
