// A surface given by a grid of heights.
#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <utility>
#include <vector>

#include "scarp/tile.h"

namespace scarp {
namespace {

class GridZero final : public HeightZero {
 public:
  explicit GridZero(ZeroGrid grid) : grid_(std::move(grid)) {
    const std::array<double, 6>& a = grid_.place.affine;
    determinant_ = a[1] * a[5] - a[2] * a[4];
    if (grid_.place.from_degrees == nullptr && a[2] == 0 && a[4] == 0) {
      turn_ = 360 / std::abs(a[1]);
      if (turn_ - grid_.cols < 1e-6 * turn_) round_cols_ = static_cast<int>(std::floor(turn_ + 0.5));
    }
  }

  bool has_inverse() const { return std::isfinite(determinant_) && determinant_ != 0; }

  void find(std::span<const double> longitudes, std::span<const double> latitudes,
            std::span<double> heights) const override {
    std::vector<double> xs(longitudes.begin(), longitudes.end()), ys(latitudes.begin(), latitudes.end());
    if (grid_.place.from_degrees != nullptr) grid_.place.from_degrees->apply(xs, ys);
    const std::array<double, 6>& a = grid_.place.affine;
    for (std::size_t k = 0; k < xs.size(); ++k) {
      const double x = xs[k] - a[0], y = ys[k] - a[3];
      double col = (x * a[5] - y * a[2]) / determinant_;
      const double row = (y * a[1] - x * a[4]) / determinant_;
      // Adds turns to reach the grid, or else the first position after its start.
      if (turn_ > 0) col -= turn_ * std::floor((col + 0.5) / turn_);
      heights[k] = at(col, row);
    }
  }

 private:
  double at(double col, double row) const {
    const double right = grid_.cols - 1, bottom = grid_.rows - 1;
    const bool is_across = round_cols_ > 0 || (col >= -0.5 && col <= right + 0.5);
    if (!is_across || !(row >= -0.5 && row <= bottom + 0.5)) return std::numeric_limits<double>::quiet_NaN();
    if (round_cols_ == 0) col = std::clamp(col, 0.0, right);
    row = std::clamp(row, 0.0, bottom);
    const double west = round_cols_ > 0 ? std::floor(col) : std::min(std::floor(col), right - 1);
    const double north = std::min(std::floor(row), bottom - 1);
    const double x = col - west, y = row - north;
    const auto node = [&](double of_col, double of_row) {
      int column = static_cast<int>(of_col);
      if (round_cols_ > 0) column = (column % round_cols_ + round_cols_) % round_cols_;
      return double{grid_.heights[static_cast<std::size_t>(of_row) * static_cast<std::size_t>(grid_.cols) +
                                  static_cast<std::size_t>(column)]};
    };
    const double upper = between(node(west, north), x, [&] { return node(west + 1, north); });
    return between(upper, y,
                   [&] { return between(node(west, north + 1), x, [&] { return node(west + 1, north + 1); }); });
  }

  /// Nodes of weight 0 may be missing.
  template <class Find>
  static double between(double from, double part, const Find& to) {
    return part == 0 ? from : from + (to() - from) * part;
  }

  ZeroGrid grid_;
  double determinant_ = 0;
  double turn_ = 0;     ///< columns per 360°, for a grid in degrees
  int round_cols_ = 0;  ///< the same if the grid is complete: the last column is next to the first
};

}  // namespace

Result<std::shared_ptr<const HeightZero>> make_grid_zero(ZeroGrid grid) {
  if (grid.cols < 2 || grid.rows < 2 ||
      grid.heights.size() != static_cast<std::size_t>(grid.cols) * static_cast<std::size_t>(grid.rows))
    return fail(ErrorKind::kUsage, "a grid of heights needs 2 x 2 nodes or more, and one height for each");
  auto zero = std::make_shared<GridZero>(std::move(grid));
  if (!zero->has_inverse()) return fail(ErrorKind::kUsage, "the grid's place on the globe maps all nodes to a line");
  return std::shared_ptr<const HeightZero>(std::move(zero));
}

}  // namespace scarp
