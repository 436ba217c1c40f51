// Combined errors of several fields, for fitting: heights and channels.
#pragma once

#include <array>
#include <cstddef>
#include <functional>
#include <optional>
#include <vector>

#include "base/norm.h"
#include "base/point.h"
#include "scarp/options.h"

namespace scarp::fit {

/// The most fields that can be combined.
inline constexpr std::size_t kMostFitFields = 65;

/// The definition of a sample's error over several fields.
struct FitNorm {
  struct Field {
    const float* samples = nullptr;  ///< row-major like the raster; finite wherever the raster has a height
    double scale = 1;                ///< weight of its errors; above 0
  };
  std::vector<Field> fields;  ///< 1 … kMostFitFields, including the heights if they count
  Norm norm = Norm::kSum;
  /// Returns a sample of the closed triangle that breaks its bound; nothing if all samples are within their bounds.
  /// Called where rounding may decide, on any thread, for positive triangles whose corners are samples. Its result is
  /// final.
  std::function<std::optional<Point>(const std::array<Point, 3>& corners)> find_breach = {};
};

}  // namespace scarp::fit
