// Positions of a mesh's vertices in the grid of its field.
#pragma once

#include <cmath>
#include <cstddef>
#include <cstdint>
#include <utility>

#include "base/array.h"
#include "measure/grid_map.h"
#include "scarp/height_field.h"
#include "scarp/mesh.h"
#include "scarp/result.h"

namespace scarp::judge {

/// A vertex in plan coordinates, and its height.
struct FacetCorner {
  double x, y, z;
};

/// Corners by vertex. They use half the memory if all vertices lie on GridMap's lattice.
class FacetCorners {
 public:
  /// x and y in steps of the GridMap's lattice.
  struct Short {
    std::int32_t x, y;
    float z;
  };

  FacetCorners() = default;
  explicit FacetCorners(Array<FacetCorner> corners) : corners_(std::move(corners)) {}
  explicit FacetCorners(Array<Short> corners) : shorts_(std::move(corners)) {}

  /// Returns false if `to` cannot hold the corner exactly.
  static bool shorten(const FacetCorner& corner, Short& to) {
    constexpr double kMost = 0x1p30;
    const double x = corner.x * GridMap::kSteps, y = corner.y * GridMap::kSteps;
    if (!(std::abs(x) <= kMost && std::abs(y) <= kMost && std::abs(corner.z) <= kMost)) return false;
    to = {static_cast<std::int32_t>(x), static_cast<std::int32_t>(y), static_cast<float>(corner.z)};
    return to.x == x && to.y == y && double{to.z} == corner.z;
  }

  FacetCorner operator[](std::size_t v) const {
    if (shorts_.empty()) return corners_[v];
    const Short& at = shorts_[v];
    return {at.x / GridMap::kSteps, at.y / GridMap::kSteps, at.z};
  }
  double row(std::size_t v) const { return shorts_.empty() ? corners_[v].y : shorts_[v].y / GridMap::kSteps; }
  /// Prefetches the corner.
  void expect(std::size_t v) const {
    if (shorts_.empty()) {
      __builtin_prefetch(&corners_[v]);
    } else {
      __builtin_prefetch(&shorts_[v]);
    }
  }

 private:
  Array<FacetCorner> corners_;  // empty if shorts are used
  Array<Short> shorts_;
};

/// Vertices in columns, rows and heights.
struct GridPlaces {
  FacetCorners corners;
  bool are_on_lattice = true;  ///< all columns and rows are multiples of 1/256
};

/// Computes the places with GridMap. Fails with kInput for a vertex out of reach (check_mesh.h). REQUIRES: an
/// invertible affine frame. The result does not depend on threads.
Result<GridPlaces> place_on_grid(const HeightField& field, const Mesh& mesh, int threads);

}  // namespace scarp::judge
