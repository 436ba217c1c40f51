// The last touch to a data-dependent triangulation.
#pragma once

#include "metric/error_metric.h"
#include "scarp/options.h"
#include "scarp/run.h"
#include "tin/triangulation.h"

namespace scarp {

/// Flips free edges of the domain as long as a flip lowers the sum of squared errors of its two triangles, raises
/// neither largest error above the larger of the two and makes no triangle thinner than 0.1 (2 · area / longest
/// side²) or than it was, whatever the rule's threshold. With `keep_bounds` no flip gives a triangle a candidate: a
/// mesh that kept every bound continues to keep it. Cost: about four scans of the samples. Returns the work done.
Work settle_edges(Triangulation& tin, const ErrorMetric& metric, const EdgeRule& rule, bool keep_bounds);

}  // namespace scarp
