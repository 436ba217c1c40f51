// Surfaces that heights are above, such as the sea, themselves above the ellipsoid.
#pragma once

#include <memory>
#include <span>
#include <vector>

#include "scarp/degrees.h"
#include "scarp/result.h"

#pragma GCC visibility push(default)

namespace scarp {

/// The surface that heights are above, such as the sea: itself above the ellipsoid.
class HeightZero {
 public:
  virtual ~HeightZero() = default;
  /// Heights in metres above the ellipsoid at degrees, NaN where they are not known. Each depends on its place alone.
  /// Several threads may call it at once. The spans have equal sizes.
  virtual void find(std::span<const double> longitudes, std::span<const double> latitudes,
                    std::span<double> heights) const = 0;
};

/// The geoid EGM96 above the ellipsoid of WGS 84, built in: nodes 15 minutes of arc apart, in whole centimetres,
/// bilinear between them. Within 6 mm of what PROJ makes of the same grid (egm96_15.gtx), everywhere. The same bits on
/// every machine. Cost: 20 ms and 4 MB when it is asked for first.
std::shared_ptr<const HeightZero> egm96();

/// A grid of a surface's heights.
struct ZeroGrid {
  int cols = 0, rows = 0;      ///< at least 2
  std::vector<float> heights;  ///< cols · rows, row by row; metres above the ellipsoid, NaN where they are not known
  RasterPlace place;           ///< position of the grid's nodes
};

/// Bilinear between the four nodes around a place; up to half a cell outside as at the outer nodes. Not known where one
/// of the four is not. A grid in degrees that goes all round continues after its last column. Fails with kUsage for
/// other numbers of heights, and as make_node_source().
Result<std::shared_ptr<const HeightZero>> make_grid_zero(ZeroGrid grid);

}  // namespace scarp

#pragma GCC visibility pop
