#include "tiles/nodes/sample_rows.h"

#include <algorithm>
#include <cmath>
#include <vector>

#include "grid/window.h"

namespace scarp::tiles {
namespace {

/// Samples between exact places in each direction.
constexpr int kAnchorSamples = 16;
/// Approximate number of samples read at once.
constexpr int kRowSamplesTogether = 1 << 20;
/// Places per direction that are examined to find the raster's part in a box.
constexpr int kLooks = 33;
/// Nearer to a pole, meridians are not parallel enough.
constexpr double kStraightLatitude = 85;

double nearest_turn(double degrees, double to) { return degrees - 360 * std::floor((degrees - to) / 360 + 0.5); }

}  // namespace

/// A range of places in the raster.
class SampleRows::Reach {
 public:
  void add(double col, double row) {
    left_ = std::min(left_, col);
    right_ = std::max(right_, col);
    top_ = std::min(top_, row);
    bottom_ = std::max(bottom_, row);
  }
  void grow(double samples) {
    left_ -= samples;
    right_ += samples;
    top_ -= samples;
    bottom_ += samples;
  }

 private:
  friend class SampleRows;
  double left_ = INFINITY, right_ = -INFINITY, top_ = INFINITY, bottom_ = -INFINITY;
};

SampleRows::SampleRows(const HeightField& field, const RasterPlace& place) : field_(field), place_(place) {
  const std::array<double, 6>& a = place.affine;
  determinant_ = a[1] * a[5] - a[2] * a[4];
}

std::array<double, 2> SampleRows::to_raster(double x, double y) const {
  const std::array<double, 6>& a = place_.affine;
  return {((x - a[0]) * a[5] - (y - a[3]) * a[2]) / determinant_,
          ((y - a[3]) * a[1] - (x - a[0]) * a[4]) / determinant_};
}

SampleRows::Window SampleRows::window_over(const Reach& reach) const {
  const auto clamped = [](double place, int count) {
    return static_cast<int>(std::clamp(std::floor(place), -1.0, static_cast<double>(count)));
  };
  Window window;
  if (!(reach.left_ <= reach.right_) || !(reach.top_ <= reach.bottom_)) return window;
  window.col = std::max(0, clamped(reach.left_ - 1, field_.cols));
  window.row = std::max(0, clamped(reach.top_ - 1, field_.rows));
  window.cols = std::min(field_.cols, clamped(reach.right_ + 2, field_.cols) + 1) - window.col;
  window.rows = std::min(field_.rows, clamped(reach.bottom_ + 2, field_.rows) + 1) - window.row;
  return window;
}

template <class Take>
Result<void> SampleRows::read_bands(const Window& window, const Take& take) const {
  const int together = std::max(1, kRowSamplesTogether / window.cols / kAnchorSamples) * kAnchorSamples;
  std::vector<float> heights;
  for (int first = 0; first < window.rows; first += together) {
    Window band = window;
    band.row += first;
    band.rows = std::min(together, window.rows - first);
    heights.resize(static_cast<std::size_t>(band.cols) * static_cast<std::size_t>(band.rows));
    SCARP_RETURN_IF_ERROR(
        grid::read_window(field_, band.col, band.row, band.cols, band.rows, heights.data(), band.cols));
    take(band, heights.data());
  }
  return {};
}

Result<void> SampleRows::visit_in_degrees(const DegreeBox& box, double turn, const SampleVisitor& visit) const {
  Reach reach;
  for (const double x : {box.west, box.east}) {
    for (const double y : {box.south, box.north}) {
      const auto [col, row] = to_raster(x - turn, y);
      reach.add(col, row);
    }
  }
  const Window window = window_over(reach);
  if (window.is_empty()) return {};
  const std::array<double, 6>& a = place_.affine;
  return read_bands(window, [&](const Window& band, const float* heights) {
    for (int j = 0; j < band.rows; ++j) {
      const double col = band.col, row = band.row + j;
      visit({a[0] + a[1] * col + a[2] * row + turn,
             a[3] + a[4] * col + a[5] * row,
             a[1],
             a[4],
             {heights + std::ptrdiff_t{j} * band.cols, static_cast<std::size_t>(band.cols)}});
    }
  });
}

void SampleRows::visit_one_by_one(const Window& window, int row, double longitude, const float* heights,
                                  const SampleVisitor& visit) const {
  const std::array<double, 6>& a = place_.affine;
  std::vector<double> xs, ys;
  for (int i = 0; i < window.cols; ++i) {
    xs.push_back(a[0] + a[1] * (window.col + i) + a[2] * row);
    ys.push_back(a[3] + a[4] * (window.col + i) + a[5] * row);
  }
  place_.to_degrees->apply(xs, ys);
  for (std::size_t i = 0; i < xs.size(); ++i) {
    if (std::isfinite(xs[i]) && std::isfinite(ys[i]))
      visit({nearest_turn(xs[i], longitude), ys[i], 0, 0, {heights + i, 1}});
  }
}

Result<void> SampleRows::visit_placed(const DegreeBox& box, const SampleVisitor& visit) const {
  std::vector<double> xs, ys;
  for (int j = 0; j < kLooks; ++j) {
    for (int i = 0; i < kLooks; ++i) {
      xs.push_back(box.west + (box.east - box.west) * i / (kLooks - 1));
      ys.push_back(box.south + (box.north - box.south) * j / (kLooks - 1));
    }
  }
  place_.from_degrees->apply(xs, ys);
  Reach reach;
  double step = 0;
  for (std::size_t k = 0; k < xs.size(); ++k) {
    if (!std::isfinite(xs[k]) || !std::isfinite(ys[k])) continue;
    const auto [col, row] = to_raster(xs[k], ys[k]);
    reach.add(col, row);
    for (const std::size_t other : {k % kLooks > 0 ? k - 1 : k, k >= kLooks ? k - kLooks : k}) {
      const auto [other_col, other_row] = to_raster(xs[other], ys[other]);
      const double apart = std::max(std::abs(col - other_col), std::abs(row - other_row));
      if (std::isfinite(apart)) step = std::max(step, apart);
    }
  }
  // Between examined places, the raster may reach farther by less than the places' distance.
  reach.grow(step);
  const Window window = window_over(reach);
  if (window.is_empty()) return {};
  const std::array<double, 6>& a = place_.affine;
  const double middle = (box.west + box.east) / 2;
  const bool is_polar = std::max(std::abs(box.south), std::abs(box.north)) > kStraightLatitude;
  const int across = (window.cols + kAnchorSamples - 1) / kAnchorSamples + 1;
  // Places of each 16th sample of two rows, 16 apart.
  std::vector<double> longitudes(2 * static_cast<std::size_t>(across)), latitudes(longitudes.size());
  return read_bands(window, [&](const Window& band, const float* heights) {
    for (int first = 0; first < band.rows; first += kAnchorSamples) {
      for (std::size_t k = 0; k < longitudes.size(); ++k) {
        const bool is_lower = k >= static_cast<std::size_t>(across);
        const double col = band.col + kAnchorSamples * (static_cast<int>(k) - (is_lower ? across : 0));
        const double row = band.row + first + (is_lower ? kAnchorSamples : 0);
        longitudes[k] = a[0] + a[1] * col + a[2] * row;
        latitudes[k] = a[3] + a[4] * col + a[5] * row;
      }
      place_.to_degrees->apply(longitudes, latitudes);
      for (int i = 0; i + 1 < across; ++i) {
        const auto k = static_cast<std::size_t>(i), below = k + static_cast<std::size_t>(across);
        const double start = nearest_turn(longitudes[k], middle);
        const auto longitude = [&](std::size_t at) { return nearest_turn(longitudes[at], start); };
        Window piece = band;
        piece.col += i * kAnchorSamples;
        piece.cols = std::min(kAnchorSamples, band.col + band.cols - piece.col);
        bool is_straight = !is_polar;
        for (const std::size_t at : {k, k + 1, below, below + 1})
          is_straight = is_straight && std::isfinite(longitudes[at]) && std::isfinite(latitudes[at]);
        for (int j = first; j < std::min(first + kAnchorSamples, band.rows); ++j) {
          const float* const from = heights + std::ptrdiff_t{j} * band.cols + i * kAnchorSamples;
          if (!is_straight) {
            visit_one_by_one(piece, band.row + j, middle, from, visit);
            continue;
          }
          const double t = static_cast<double>(j - first) / kAnchorSamples;
          const auto between = [&](double upper, double lower) { return upper + (lower - upper) * t; };
          const double x = between(start, longitude(below)), y = between(latitudes[k], latitudes[below]);
          const double end_x = between(longitude(k + 1), longitude(below + 1)),
                       end_y = between(latitudes[k + 1], latitudes[below + 1]);
          visit({x,
                 y,
                 (end_x - x) / kAnchorSamples,
                 (end_y - y) / kAnchorSamples,
                 {from, static_cast<std::size_t>(piece.cols)}});
        }
      }
    }
  });
}

}  // namespace scarp::tiles
