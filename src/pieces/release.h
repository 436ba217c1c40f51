// Releases the borders between tiles. Their edges were chosen from one side only, and are now chosen from both sides.
#pragma once

#include <vector>

#include "metric/error_metric.h"
#include "scarp/run.h"
#include "tin/triangulation.h"

namespace scarp::pieces {

/// Flips `seams`, and the edges that they touch, towards the Delaunay property if both new triangles satisfy the bound
/// of every sample. No vertex is added (forcing Delaunay edges costs 0.2 to 1 % more vertices: docs/design.md).
/// Afterwards every free edge is either Delaunay or needed by the bound. Cost: a scan of two triangles for each edge
/// that is not Delaunay; the first round of scans runs on `threads` threads. The result does not depend on `threads`.
/// REQUIRES: every triangle satisfies its bounds.
Work release_seams(tin::Triangulation& tin, const metric::ErrorMetric& metric, std::vector<tin::HalfEdge> seams,
                   int threads = 1);

}  // namespace scarp::pieces
