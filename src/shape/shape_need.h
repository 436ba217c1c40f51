// A lower bound on the triangles that goals for the lengths of edges need.
#pragma once

#include <cstdint>

#include "base/memory_budget.h"
#include "scarp/options.h"
#include "scarp/result.h"
#include "shape/plan_metric.h"
#include "shape/size_field.h"
#include "tin/triangulation.h"

namespace scarp {

/// Edges over sizes, at most.
inline constexpr double kGradeFactor = 2;

/// Triangles that the surface of `tin` will have at least, however they lie: its area over that of equilateral
/// triangles with the longest edges that are allowed. Sizes only fall from what they are (null: without a grade). 0
/// where nothing limits edges, or sizes grow too fast to estimate. Cost: O(triangles).
double least_triangles(const Triangulation& tin, const PlanMetric& metric, const ShapeGoals& goals,
                       const SizeField* sizes);

/// Fails with kInput where no mesh has so many triangles, with kUsage where the memory does not hold them in addition
/// to `work` bytes.
Result<void> check_need(double triangles, const MemoryBudget& memory, std::uint64_t work);

}  // namespace scarp
