// The final step of a data-dependent triangulation.
#pragma once

#include "metric/error_metric.h"
#include "scarp/options.h"
#include "scarp/run.h"
#include "tin/triangulation.h"

namespace scarp {

/// Flips free edges of the domain while a flip lowers the sum of squared errors of its two triangles, raises neither
/// largest error above the larger of the two, and makes no triangle thinner than 0.1 (2 · area / longest side²) or than
/// before, for any threshold of the rule. With `keep_bounds`, no flip gives a triangle a candidate, so a mesh that
/// satisfied every bound still does. Cost: about four scans of the samples. Returns the work done.
Work settle_edges(Triangulation& tin, const ErrorMetric& metric, const EdgeRule& rule, bool keep_bounds);

}  // namespace scarp
