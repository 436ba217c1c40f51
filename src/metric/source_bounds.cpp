#include "metric/source_bounds.h"

#include <algorithm>
#include <cmath>
#include <limits>

namespace scarp::metric {

namespace {

constexpr float kNoBound = std::numeric_limits<float>::infinity();

}  // namespace

bool has_source_bounds(const SimplifyOptions& options, bool is_streamed) {
  const Tolerances& asked = options.tolerances;
  return asked.source != nullptr || asked.weights_source != nullptr || (is_streamed && !asked.ignored.empty());
}

SourceBounds::SourceBounds(const SimplifyOptions& options, const BoundRule& rule, double factor)
    : tolerances_(options.tolerances.source),
      weights_(options.tolerances.weights_source),
      ignored_(options.tolerances.ignored),
      most_(options.goals.max_error.value_or(HUGE_VAL)),
      factor_(factor),
      rule_(rule) {}

bool SourceBounds::has_most() const { return !std::isinf(most_) && weights_ == nullptr && ignored_.empty(); }

double SourceBounds::asked(float value) const {
  if (weights_ == nullptr) return std::min(most_, factor_ * value);
  return value > 0 ? divide_down(most_, value) : HUGE_VAL;
}

Result<void> SourceBounds::read_aims(Point first, std::int32_t cols, std::int32_t rows, float* aims,
                                     std::ptrdiff_t stride) const {
  return read(first, cols, rows, nullptr, aims, stride);
}

Result<void> SourceBounds::read_aims(std::int32_t first, const grid::Raster& samples, float* aims) const {
  return read({0, first}, samples.cols, samples.rows, &samples, aims, samples.cols);
}

Result<void> SourceBounds::read(Point first, std::int32_t cols, std::int32_t rows, const grid::Raster* samples,
                                float* aims, std::ptrdiff_t stride) const {
  if (has_values()) {
    SCARP_RETURN_IF_ERROR(source()->read(first.x, first.y, cols, rows, aims, stride));
  }
  for (std::int32_t y = 0; y < rows; ++y) {
    const std::span<float> row(aims + y * stride, static_cast<std::size_t>(cols));
    if (!has_values()) std::fill(row.begin(), row.end(), kNoBound);
    for (std::int32_t x = 0; x < cols; ++x) {
      float& value = row[static_cast<std::size_t>(x)];
      const Point at{first.x + x, first.y + y};
      if (!(value >= 0) || (weights_ != nullptr && std::isinf(value)))
        return tl::unexpected(weights_ != nullptr ? refuse_value("the mask", at, value, ", and finite")
                                                  : refuse_value("the tolerance", at, value));
      const double asked = this->asked(value);
      if (samples != nullptr && asked < rule_.reserve && samples->is_valid({x, y}))
        return tl::unexpected(rule_.refuse(at, asked));
      value = rule_.aim_at(rule_.bound(asked));
    }
    ignored_.visit(first.y + y, first.x, cols,
                   [&](std::int32_t x) { row[static_cast<std::size_t>(x - first.x)] = kNoBound; });
  }
  return {};
}

Result<void> SourceBounds::read_values(std::int32_t first, std::int32_t rows, std::int32_t cols, float* values) const {
  return source()->read(0, first, cols, rows, values, cols);
}

void SourceBounds::find_bounds(std::int32_t row, std::span<const float> values, std::span<float> bounds) const {
  if (values.empty()) {
    std::fill(bounds.begin(), bounds.end(), rule_.bound(most_));
  } else {
    std::transform(values.begin(), values.end(), bounds.begin(),
                   [this](float value) { return rule_.bound(asked(value)); });
  }
  ignored_.visit(row, 0, static_cast<std::int32_t>(bounds.size()),
                 [&](std::int32_t x) { bounds[static_cast<std::size_t>(x)] = kNoBound; });
}

}  // namespace scarp::metric
