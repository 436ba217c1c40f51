// Detection of points that are the nodes of a raster.
#pragma once

#include <optional>
#include <vector>

#include "scarp/height_field.h"

namespace scarp::io {

struct PointGrid {
  int cols = 0, rows = 0;
  double west = 0, north = 0;  ///< position of the first node
  double dx = 0, dy = 0;       ///< steps, above 0
  std::size_t missing = 0;
  std::vector<double> heights;  ///< by rows from the north; NaN where a node is missing
};

/// The raster with the points as its nodes, in any order; nothing for scattered points. See is_point_file() for the
/// rule. Cost: two sorts.
std::optional<PointGrid> find_grid(const PointSet& points);

}  // namespace scarp::io
