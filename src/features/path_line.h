// Simplification of a path of samples to a line with few vertices.
#pragma once

#include <vector>

#include "features/valley_paths.h"
#include "lines/line_samples.h"

namespace scarp {

/// The samples of a path, including its ends and joints, that form the simplified line. It has the fewest vertices such
/// that each sample between two lies within one sample of the line's chord, and the surface along the chord and the
/// samples differ by at most `tolerance` from the heights along it. Ties are broken by the smallest squared distance
/// from samples. Reads only samples within two of the path.
std::vector<Point> fewest_vertices(const LineSamples& samples, const ValleyPath& path, double tolerance);

}  // namespace scarp
