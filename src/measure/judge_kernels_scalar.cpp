// The scalar twin, which the vectors must match bit by bit.
#include <algorithm>
#include <cmath>
#include <limits>

#include "base/bits.h"
#include "measure/judge_kernels.h"

namespace scarp::judge::detail {
namespace {

struct Columns {
  std::int32_t first, last;
};

Columns columns_of(const FacetTask& facet, std::int32_t row) {
  if (!facet.has_spans) return {facet.left, facet.right};
  double lo = facet.left, hi = facet.right;
  for (std::size_t k = 0; k < 3; ++k) {
    const double side = facet.x[k] + facet.dx[k] * (row - facet.y[k]) * facet.per_dy[k];
    if (facet.dy[k] > 0) hi = std::min(hi, side + facet.margin);
    if (facet.dy[k] < 0) lo = std::max(lo, side - facet.margin);
  }
  return {static_cast<std::int32_t>(std::min(std::ceil(lo), facet.right + 1.0)),
          static_cast<std::int32_t>(std::max(std::floor(hi), facet.left - 1.0))};
}

void judge_facet(const FacetTask& facet, const BandRows& band, Caution& caution) {
  for (std::int32_t row = facet.first; row <= facet.last; ++row) {
    const Columns span = columns_of(facet, row);
    const float* heights = band.heights + std::ptrdiff_t{row - band.first} * band.cols;
    double* errors = band.errors + std::ptrdiff_t{row - band.first} * band.stride;
    for (std::int32_t col = span.first; col <= span.last; ++col) {
      const double sample = heights[col];
      if (std::isnan(sample)) continue;
      std::array<double, 3> weight{}, term{};
      bool is_inside = true;
      for (std::size_t k = 0; k < 3; ++k) {
        weight[k] = facet.dx[k] * (row - facet.y[k]) - facet.dy[k] * (col - facet.x[k]);
        is_inside = is_inside && weight[k] >= -facet.slack;
        term[k] = std::max(0.0, weight[k]) * (facet.z[k] - sample);
      }
      if (!is_inside) continue;
      const double error = (term[0] + term[1] + term[2]) * facet.per_area, magnitude = std::abs(error);
      if (magnitude >= caution.watch && (term[0] != 0 || term[1] != 0 || term[2] != 0)) {
        caution.watch = caution.look(caution.judge, row, col, 1);
        continue;
      }
      double& held = errors[col];
      if (!(magnitude <= std::abs(held)) || error == std::abs(held)) held = error;
    }
  }
}

RowSums sum_row(const double* errors, std::int32_t count, Buckets& buckets) {
  std::array<double, kSumParts> error{}, magnitude{}, square{};
  RowSums sums;
  buckets.count = 0;
  buckets.zeros = 0;
  for (std::int32_t i = 0; i < count; ++i) {
    if (std::isnan(errors[i])) continue;
    const std::size_t part = static_cast<std::size_t>(i) % kSumParts;
    const double size = std::abs(errors[i]);
    ++sums.samples;
    error[part] += errors[i];
    magnitude[part] += size;
    square[part] += errors[i] * errors[i];
    sums.largest = std::max(sums.largest, size);
    buckets.values[buckets.count++] = bit_cast<std::uint32_t>(static_cast<float>(size)) >> kBucketShift;
  }
  sums.error = sum_of_parts(error.data());
  sums.magnitude = sum_of_parts(magnitude.data());
  sums.square = sum_of_parts(square.data());
  return sums;
}

RowHeights take_row(const float* from, std::int32_t count, float nodata, float* to) {
  constexpr float kInfinity = std::numeric_limits<float>::infinity();
  RowHeights taken{0, kInfinity, -kInfinity};
  for (std::int32_t i = 0; i < count; ++i) {
    const float height = from[i];
    const bool is_height = std::abs(height) <= std::numeric_limits<float>::max() && height != nodata;
    if (to != nullptr) to[i] = is_height ? height : std::numeric_limits<float>::quiet_NaN();
    if (!is_height) continue;
    ++taken.valid;
    taken.least = std::min(taken.least, height);
    taken.most = std::max(taken.most, height);
  }
  return taken;
}

}  // namespace

const JudgeKernels& scalar_judge_kernels() {
  static constexpr JudgeKernels kernels{"SCALAR", judge_facet, sum_row, take_row};
  return kernels;
}

}  // namespace scarp::judge::detail
