// A path from sample to sample as a line with few vertices.
#pragma once

#include <vector>

#include "features/valley_paths.h"
#include "lines/line_samples.h"

namespace scarp {

/// The samples of a path, its ends and joints among them, that a line needs as vertices: the fewest with which each
/// sample between two is no farther than a sample from the line's chord, nor the surface along the chord and the
/// samples farther than `tolerance` from the heights along it. Among equally few, those with the least squared distance
/// from samples. Only samples of the raster within two of the path are examined.
std::vector<Point> fewest_vertices(const LineSamples& samples, const ValleyPath& path, double tolerance);

}  // namespace scarp
