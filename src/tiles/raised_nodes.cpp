// Nodes above the ellipsoid, of heights above the sea.
#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <utility>

#include "scarp/tile.h"

namespace scarp {
namespace {

/// Places whose zero is exact are at most this apart: the geoid bends by less than a centimetre between.
constexpr double kAnchorDegrees = 1.0 / 32;

class RaisedNodes final : public NodeSource {
 public:
  RaisedNodes(const NodeSource& source, std::shared_ptr<const HeightZero> zero)
      : source_(source), zero_(std::move(zero)) {}

  Result<void> read(const NodeWindow& window, std::span<float> out) const override {
    if (auto read = source_.read(window, out); !read) return read;
    std::int64_t step = 1;
    while (window.grid.largest_step(window.per_turn) * static_cast<double>(2 * step) <= kAnchorDegrees) step *= 2;
    const auto before = [&](std::int64_t i) { return i >= 0 ? i / step : -((-i + step - 1) / step); };
    const std::int64_t first_x = before(window.col), first_y = before(window.row);
    const std::int64_t across = before(window.col + window.cols - 1) + 2 - first_x;
    const std::int64_t down = before(window.row + window.rows - 1) + 2 - first_y;
    std::vector<double> xs, ys;
    for (std::int64_t j = 0; j < down; ++j) {
      for (std::int64_t i = 0; i < across; ++i) {
        const std::int64_t row = std::min((first_y + j) * step, window.last_row());
        // A pole is one place.
        xs.push_back(window.longitude(window.is_pole(row) ? 0 : (first_x + i) * step));
        ys.push_back(window.latitude(row));
      }
    }
    std::vector<double> zeros(xs.size());
    zero_->find(xs, ys, zeros);
    for (std::int64_t j = 0; j < window.rows; ++j) {
      const std::int64_t row = window.row + j, ay = before(row);
      const double ty = static_cast<double>(row - ay * step) / static_cast<double>(step);
      for (std::int64_t i = 0; i < window.cols; ++i) {
        const std::int64_t col = window.col + i, ax = before(col);
        const double tx = static_cast<double>(col - ax * step) / static_cast<double>(step);
        const double* at = zeros.data() + (ay - first_y) * across + (ax - first_x);
        const double upper = at[0] + (at[1] - at[0]) * tx, lower = at[across] + (at[across + 1] - at[across]) * tx;
        float& height = out[static_cast<std::size_t>(j * window.cols + i)];
        if (std::isnan(height)) continue;
        height = static_cast<float>(double{height} + upper + (lower - upper) * ty);
        if (!std::isnan(height)) continue;
        return fail(ErrorKind::kInput,
                    fmt::format("nothing is known of the zero of heights at longitude {:.4f}, latitude {:.4f}",
                                window.longitude(col), window.latitude(row)));
      }
    }
    return {};
  }

 private:
  const NodeSource& source_;
  std::shared_ptr<const HeightZero> zero_;
};

}  // namespace

std::unique_ptr<NodeSource> make_raised_source(const NodeSource& source, std::shared_ptr<const HeightZero> zero) {
  return std::make_unique<RaisedNodes>(source, std::move(zero));
}

}  // namespace scarp
