// Simplification of a path of samples to a line with few vertices.
#pragma once

#include <vector>

#include "features/valley_paths.h"
#include "lines/line_samples.h"

namespace scarp::features {

/// The samples of a path, including its ends and joints, that form the simplified line. The line has the fewest
/// vertices under two conditions. Each sample between two vertices lies within one sample of their chord. The surface
/// along the chord, and the samples, differ by at most `tolerance` from the chord's heights. Among lines with equally
/// few vertices, the smallest squared distance from samples wins. Reads only samples within two of the path.
std::vector<Point> fewest_vertices(const lines::LineSamples& samples, const ValleyPath& path, double tolerance);

}  // namespace scarp::features
