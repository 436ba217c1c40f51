// The heights of one vertex at which its star is within the bound: a linear programme with one unknown, which needs one
// pass.
//
// When a vertex rises by d units, the residual at each sample of its star becomes t + λ d. So the sample is within the
// threshold for
//
//   (−1 − t) / λ <= d <= (1 − t) / λ,
//
// and the star is within the bound in the intersection of these intervals, the room. The height of least energy
// (height_step.h) only roughly balances the largest errors; it may break the bound where another height would not. So
// repair moves the best height into the room, if there is one. A vertex with a star that breaks the bound moves to the
// first place with room, even if the energy rises: that completes its repair. Samples on the ring do not count: only
// steps of other vertices change their errors.
//
// Without collapses (collapse.h), over the 42 cases of bench/quality/efforts.csv, effort max with rooms ends with 0.963
// of the triangles (0.854 to 1.000), for 6 % more time and an RMSE 1.047 times as large. A fourth round instead of
// rooms needs 24 % more time and saves 0.4 to 1.9 % of the triangles. Effort high with rooms would end with 0.977 of
// its triangles (0.848 to 1.000 in 55 cases). If sweeps and shakes also use rooms, for stars within the bound, four
// rasters at 2 to 0.5 % of the relief gain at most 0.5 % or lose at most 0.8 %.
#pragma once

#include <optional>

#include "fit/triangle_error.h"

namespace scarp::fit {

/// The rise nearest to the wish in the room; if the room is wide enough, at least a ten-thousandth of the scale from
/// its ends. Nothing if there is no room.
std::optional<double> rise_in(const TriangleError::Room& room, double wish, double scale = 1);

}  // namespace scarp::fit
