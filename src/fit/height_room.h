// The heights of one vertex at which its star keeps the bound: a linear programme of one unknown, from one pass.
//
// When a vertex rises by d units the residual at each sample of its star becomes t + λ d, so the sample keeps the
// threshold where
//
//   (−1 − t) / λ <= d <= (1 − t) / λ,
//
// and the star where all of these intervals meet. The height of least energy (height_step.h) balances the largest
// errors only nearly: it may break the bound where other heights do not. So repair moves the best height into the room,
// where there is one, and a vertex whose star breaks the bound moves to the first place with room, whatever the energy
// becomes there, since that ends what repair is about. Samples on the ring, for which the vertex' height is nothing, do
// not count: others have to mend them.
//
// Without collapses (collapse.h), over the 42 cases of bench/quality/efforts.csv, max keeps 0.963 of the triangles
// (0.854 to 1.000), for 6 % more time and an RMSE 1.047 times as large; a fourth round instead needs 24 % more time for
// 0.4 to 1.9 % of the triangles. At high it would be 0.977 of them (0.848 to 1.000 in 55 cases). With rooms for stars
// that keep the bound too, in sweeps and shakes, Fuji, Crater Lake, Jacksboro and a smooth field at 2 to 0.5 % of the
// relief gain 0.5 % or lose 0.8 %.
#pragma once

#include <optional>

#include "fit/triangle_error.h"

namespace scarp {

/// The rise in the room that is nearest to the wish, by a ten thousandth of the scale within its ends; nothing where
/// there is no room.
std::optional<double> rise_in(const TriangleError::Room& room, double wish, double scale = 1);

}  // namespace scarp
