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

namespace scarp {

/// The most fields that count together.
inline constexpr std::size_t kMostFitFields = 65;

/// The definition of a sample's error, where it is not that of its height.
struct FitNorm {
  struct Field {
    const float* samples = nullptr;  ///< row-major like the raster; finite wherever that has a height
    double scale = 1;                ///< weight of its errors; above 0
  };
  std::vector<Field> fields;  ///< at least one, at most kMostFitFields; the heights are among them where they count
  Norm norm = Norm::kSum;
  /// A sample of the closed triangle that breaks its bound; nothing if all keep it. Called where rounding is in doubt,
  /// on any thread, about triangles whose corners are samples, positive. Its result is final.
  std::function<std::optional<Point>(const std::array<Point, 3>& corners)> find_breach = {};
};

}  // namespace scarp
