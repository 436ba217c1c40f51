// Sets the borders between tiles free: edges that were decided there without looking at both sides are decided again.
#pragma once

#include <vector>

#include "metric/judge.h"
#include "scarp/strategy.h"
#include "tin/triangulation.h"

namespace scarp {

/// Flips `seams`, and what they touch, towards the Delaunay property wherever both new triangles keep the bound of
/// every sample; else the edge stays. So no vertex is added (to insist on Delaunay edges costs 0.2 to 1 % more
/// vertices: docs/design.md), and afterwards every free edge is either Delaunay or needed as it is. Cost: a scan of two
/// triangles for each edge that Delaunay would flip, the first round of them on `threads` threads; the result does not
/// depend on those. REQUIRES: every triangle keeps its bounds.
Work release_seams(Triangulation& tin, const Judge& judge, std::vector<HalfEdge> seams, int threads = 1);

}  // namespace scarp
