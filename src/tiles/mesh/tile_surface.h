// The mesh of a tile and its error at rows of points.
//
// The points of a row are close together on a straight line, so most are in the triangle of the previous point, where
// the mesh's height along the row is linear. At the end of a triangle, a walk across edges finds the next one.
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <functional>
#include <limits>
#include <span>
#include <vector>

#include "scarp/tile.h"

namespace scarp::tiles {

/// Heights at equal steps on a straight line, in units of the tile from its south-western corner; NaN: none.
struct PointRow {
  double u = 0, v = 0, step_u = 0, step_v = 0;
  std::span<const float> heights;
};

/// A point whose error exceeds the limit.
struct FarPoint {
  double u = 0, v = 0, height = 0, error = 0;
};

/// Largest |mesh − height| over points in a tile.
class TileSurface {
 public:
  /// True if a point counts. Called only for points that would change the result.
  using Counts = std::function<bool(double u, double v)>;

  /// REQUIRES: triangles are positive and cover the tile. `limit`: far_points() have a larger error.
  explicit TileSurface(const TerrainTile& tile, double limit = std::numeric_limits<double>::infinity(),
                       Counts counts = {});

  /// Ignores points outside the tile. Cost: some nanoseconds a point.
  void judge(const PointRow& row);

  double largest_error() const { return worst_; }
  /// The worst point of each triangle, in the order of triangles.
  std::vector<FarPoint> far_points() const;

 private:
  static constexpr std::uint32_t kNone = ~std::uint32_t{0};

  struct Facet {
    std::array<double, 3> x{}, y{}, z{};
    std::array<std::uint32_t, 3> beyond{kNone, kNone, kNone};  ///< the neighbour across the side opposite to a corner
  };

  void link(const TerrainTile& tile);
  std::uint32_t find(std::uint32_t near, double u, double v) const;
  void note(std::uint32_t facet, const FarPoint& point);

  std::vector<Facet> facets_;
  Counts counts_;
  double side_ = 0;  ///< side of the tile, in units
  double limit_ = 0, worst_ = 0;
  std::uint32_t start_ = 0;    ///< triangle where the previous row began
  std::vector<FarPoint> far_;  ///< by facet, if there is a limit
};

}  // namespace scarp::tiles
