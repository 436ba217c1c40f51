// The final step of a data-dependent triangulation.
#pragma once

#include "metric/error_metric.h"
#include "scarp/options.h"
#include "scarp/run.h"
#include "tin/triangulation.h"

namespace scarp::refine {

/// Flips free edges of the domain while a flip lowers the sum of squared errors of its two triangles. Neither new
/// largest error may exceed the larger old one. Neither new triangle may be thinner than both 0.1 (2 · area / longest
/// side²) and the thinner old triangle. The thresholds of the rule do not matter. With `keep_bounds`, no flip gives a
/// triangle a candidate, so a mesh that satisfied every bound still does. Cost: about four scans of the samples.
/// Returns the work done.
Work settle_edges(tin::Triangulation& tin, const metric::ErrorMetric& metric, const EdgeRule& rule, bool keep_bounds);

}  // namespace scarp::refine
