#include "grid/samples.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <limits>

#include "base/parallel.h"

namespace scarp::grid {

Result<void> check_size(const HeightField& field) {
  if ((field.samples == nullptr && field.source == nullptr) || field.cols < 2 || field.rows < 2)
    return fail(ErrorKind::kInput,
                fmt::format("a height field needs at least 2 x 2 samples, not {} x {}", field.cols, field.rows));
  if (field.cols > kMaxCoordinate || field.rows > kMaxCoordinate)
    return fail(ErrorKind::kInput, fmt::format("a height field of {} x {} samples is too large: at most {} a side",
                                               field.cols, field.rows, kMaxCoordinate));
  return {};
}

Result<Samples> Samples::of(const HeightField& field) {
  SCARP_RETURN_IF_ERROR(check_size(field));
  Samples samples;
  samples.raster_ = {field.samples, field.cols, field.rows};
  const std::size_t count = static_cast<std::size_t>(field.cols) * static_cast<std::size_t>(field.rows);
  const auto must_change = [&](float z) { return std::isinf(z) || (field.nodata && z == *field.nodata); };
  // No early exit within a row, for vectorisation.
  bool is_clean = true;
  const float nodata = field.nodata.value_or(std::numeric_limits<float>::infinity());
  for (std::size_t first = 0, cols = static_cast<std::size_t>(field.cols); is_clean && first < count; first += cols) {
    int unfit = 0;
    for (std::size_t i = first; i < first + cols; ++i)
      unfit += std::abs(field.samples[i]) == std::numeric_limits<float>::infinity() || field.samples[i] == nodata;
    is_clean = unfit == 0;
  }
  if (!is_clean) {
    samples.cleaned_.assign(field.samples, field.samples + count);
    for (float& z : samples.cleaned_) {
      if (must_change(z)) z = std::numeric_limits<float>::quiet_NaN();
    }
    samples.raster_.samples = samples.cleaned_.data();
  }
  return samples;
}

Result<Samples> Samples::to_refine(const HeightField& field, int threads) {
  auto samples = of(field);
  if (!samples || !field.frame.space) return samples;
  const Raster clean = samples->raster_;
  const auto cols = static_cast<std::size_t>(field.cols);
  std::vector<float> above(cols * static_cast<std::size_t>(field.rows));
  const auto up = field.frame.space->up();
  const auto origin = field.frame.space->origin();
  parallel_for(static_cast<std::size_t>(field.rows), threads, [&](std::size_t row) {
    std::vector<double> x(cols), y(cols), z(cols);
    const float* heights = clean.row(static_cast<std::int32_t>(row));
    for (std::size_t col = 0; col < cols; ++col) {
      const auto at = field.frame.apply_affine(static_cast<double>(col), static_cast<double>(row));
      x[col] = at[0];
      y[col] = at[1];
      z[col] = std::isnan(heights[col]) ? 0 : heights[col];
    }
    field.frame.space->to_space(x, y, z);
    for (std::size_t col = 0; col < cols; ++col) {
      const double height = up[0] * (x[col] - origin[0]) + up[1] * (y[col] - origin[1]) + up[2] * (z[col] - origin[2]);
      above[row * cols + col] = std::isnan(heights[col]) ? heights[col] : static_cast<float>(height);
    }
  });
  samples->cleaned_ = std::move(above);
  samples->raster_.samples = samples->cleaned_.data();
  return samples;
}

}  // namespace scarp::grid
