// Frames: positions of samples.
#include <algorithm>
#include <cmath>
#include <limits>

#include "grid/local_frame.h"
#include "scarp/height_field.h"

namespace scarp {
namespace {

bool is_float32(double value) {
  return std::abs(value) <= std::numeric_limits<float>::max() &&
         static_cast<double>(static_cast<float>(value)) == value;
}

/// True if p·i + q·j is a float32 for |i| <= reach_i, |j| <= reach_j: p and q are multiples of a power of two, and the
/// sum stays within 2^24 times that power.
bool sums_are_float32(double p, double q, int reach_i, int reach_j) {
  const double span = std::abs(p) * reach_i + std::abs(q) * reach_j;
  if (span == 0) return true;
  if (!std::isfinite(span) || span > std::numeric_limits<float>::max()) return false;
  int exponent = std::ilogb(span) - 23;
  if (span == std::ldexp(1.0, exponent + 23)) --exponent;  // 2^24 itself is a float32
  const double unit = std::ldexp(1.0, exponent);
  return unit >= std::numeric_limits<float>::denorm_min() && std::fmod(p, unit) == 0 && std::fmod(q, unit) == 0;
}

/// True if step·k is a float32 for every k in [first, last].
bool multiples_are_float32(double step, int first, int last) {
  // Multiples of a step with few digits, such as a power of two, are always exact.
  if (sums_are_float32(step, 0, std::max(std::abs(first), std::abs(last)), 0)) return true;
  for (int k = first; k <= last; ++k) {
    if (!is_float32(step * k)) return false;
  }
  return true;
}

}  // namespace

Frame grid_frame(int rows) {
  Frame frame;
  frame.kind = Frame::Kind::kGrid;
  frame.affine = {0, 1, 0, static_cast<double>(rows) - 1, 0, -1};
  frame.description = "grid coordinates: x = column, y = rows - 1 - row, 1 unit a cell";
  return frame;
}

std::array<double, 2> frame_origin(const Frame& frame, int cols, int rows) {
  auto [x, y] = frame.apply_affine(cols / 2, rows / 2);
  if (frame.transform && !frame.transform->apply({&x, 1}, {&y, 1})) {
    x = y = std::numeric_limits<double>::quiet_NaN();
  }
  if (!std::isfinite(x) || !std::isfinite(y)) x = y = std::numeric_limits<double>::quiet_NaN();
  return {x, y};
}

bool offsets_are_exact(const Frame& frame, int cols, int rows, int steps) {
  if (!frame.is_affine()) return false;
  std::array<double, 6> a = frame.affine;
  for (double& term : a) term /= steps;
  const int reach_col = steps * grid::centre_reach(cols), reach_row = steps * grid::centre_reach(rows);
  // An offset is affine[1]·(col − cols/2) + affine[2]·(row − rows/2), independent of the constant terms.
  const auto all_along = [steps](double term, int size) {
    return multiples_are_float32(term, -steps * (size / 2), steps * (size - 1 - size / 2));
  };
  if (!all_along(a[1], cols) || !all_along(a[4], cols)) return false;
  if (!all_along(a[2], rows) || !all_along(a[5], rows)) return false;
  const bool sums_x = a[1] == 0 || a[2] == 0 || sums_are_float32(a[1], a[2], reach_col, reach_row);
  const bool sums_y = a[4] == 0 || a[5] == 0 || sums_are_float32(a[4], a[5], reach_col, reach_row);
  return sums_x && sums_y;
}

std::array<double, 6> map_affine(const RasterInfo& info, int rows) {
  if (!info.has_georeference) return grid_frame(rows).affine;
  const auto& g = info.geotransform;  // coefficients of pixel corners
  return {g[0] + g[1] / 2 + g[2] / 2, g[1], g[2], g[3] + g[4] / 2 + g[5] / 2, g[4], g[5]};
}

}  // namespace scarp
