#include "fit/point_samples.h"

#include <algorithm>
#include <cmath>
#include <limits>

#include "base/curve.h"
#include "fit/point_error.h"
#include "grid/vertex_lattice.h"

namespace scarp::fit {

namespace {

constexpr double kPerBucket = 2;  // samples

/// A box of lattice points, with both ends.
struct StepBox {
  std::int64_t west, north, east, south;
  bool holds(Point p) const { return p.x >= west && p.x <= east && p.y >= north && p.y <= south; }
};

/// Calls visit(i) for the samples in a box, in their order. Visits only squares of Morton's curve that meet the box.
template <class Visit>
class BoxQuery {
 public:
  BoxQuery(std::span<const Point> at, const StepBox& box, const Visit& visit) : at_(at), box_(box), visit_(visit) {}

  /// [begin, end): the samples of a square of 2^level steps.
  void run(std::int64_t x, std::int64_t y, int level, std::size_t begin, std::size_t end) const {
    constexpr std::size_t kFew = 16;
    const std::int64_t side = std::int64_t{1} << level;
    if (begin == end || x > box_.east || y > box_.south || x + side <= box_.west || y + side <= box_.north) return;
    const bool is_inside = x >= box_.west && y >= box_.north && x + side - 1 <= box_.east && y + side - 1 <= box_.south;
    if (is_inside || end - begin <= kFew || level == 0) {
      for (std::size_t i = begin; i < end; ++i) {
        if (is_inside || box_.holds(at_[i])) visit_(i);
      }
      return;
    }
    const std::int64_t half = side / 2;
    for (std::int64_t quarter = 0; quarter < 4; ++quarter) {
      const std::int64_t left = x + (quarter & 1) * half, top = y + (quarter >> 1) * half;
      const std::size_t next = quarter == 3 ? end : first_from(quarter + 1, x, y, half, begin, end);
      run(left, top, level - 1, begin, next);
      begin = next;
    }
  }

 private:
  /// The first sample that is not before a quarter of a square.
  std::size_t first_from(std::int64_t quarter, std::int64_t x, std::int64_t y, std::int64_t half, std::size_t begin,
                         std::size_t end) const {
    const std::uint64_t place = curve_place(static_cast<std::uint64_t>(x + (quarter & 1) * half),
                                            static_cast<std::uint64_t>(y + (quarter >> 1) * half));
    const auto found = std::partition_point(
        at_.begin() + static_cast<std::ptrdiff_t>(begin), at_.begin() + static_cast<std::ptrdiff_t>(end),
        [&](Point p) { return curve_place(static_cast<std::uint64_t>(p.x), static_cast<std::uint64_t>(p.y)) < place; });
    return static_cast<std::size_t>(found - at_.begin());
  }

  std::span<const Point> at_;
  StepBox box_;
  const Visit& visit_;
};

float extreme(std::span<const double> z, bool is_highest) {
  if (z.empty()) return 0;
  return static_cast<float>(is_highest ? *std::max_element(z.begin(), z.end()) : *std::min_element(z.begin(), z.end()));
}

}  // namespace

PointSamples::PointSamples(std::span<const Point> at, std::span<const double> z, Point last, double rounding)
    : ScatteredSamples(last, extreme(z, false), extreme(z, true)), at_(at), z_(z), rounding_(rounding) {}

const ScatteredErrors& PointSamples::over(const Patch::Window& window, double threshold,
                                          std::unique_ptr<ScatteredErrors>& kept) const {
  if (!kept) kept = std::make_unique<PointError>();
  auto& errors = static_cast<PointError&>(*kept);
  errors.read(*this, window, threshold);
  return errors;
}

void PointWindow::read(const PointSamples& samples, const Patch::Window& window) {
  constexpr std::int64_t kSteps = grid::kLatticeSteps;
  unsorted_x_.clear();
  unsorted_y_.clear();
  unsorted_z_.clear();
  const std::int64_t west = window.first.x * kSteps, north = window.first.y * kSteps;
  const std::int64_t width = std::max(window.cols - 1, 0) * kSteps, height = std::max(window.rows - 1, 0) * kSteps;
  const auto add = [&](std::size_t i) {
    unsorted_x_.push_back(static_cast<float>(samples.at()[i].x - west));
    unsorted_y_.push_back(static_cast<float>(samples.at()[i].y - north));
    unsorted_z_.push_back(static_cast<float>(samples.z()[i]));
  };
  if (window.rows > 0)
    BoxQuery(samples.at(), {west, north, west + width, north + height}, add).run(0, 0, 30, 0, samples.at().size());
  sort_into_buckets(width, height);
}

/// The sort is stable within each bucket.
void PointWindow::sort_into_buckets(std::int64_t width, std::int64_t height) {
  const std::size_t count = unsorted_z_.size();
  const double area = static_cast<double>(width + 1) * static_cast<double>(height + 1);
  const double side = std::sqrt(area * kPerBucket / static_cast<double>(std::max<std::size_t>(count, 1)));
  shift_ = std::clamp(static_cast<int>(std::lround(std::log2(side))), 0, 24);
  cols_ = static_cast<std::int32_t>(width >> shift_) + 1;
  rows_ = static_cast<std::int32_t>(height >> shift_) + 1;
  const auto bucket = [&](std::size_t i) {
    const std::int32_t col = static_cast<std::int32_t>(unsorted_x_[i]) >> shift_;
    const std::int32_t row = static_cast<std::int32_t>(unsorted_y_[i]) >> shift_;
    return static_cast<std::size_t>(row) * static_cast<std::size_t>(cols_) + static_cast<std::size_t>(col);
  };
  begins_.assign(static_cast<std::size_t>(cols_) * static_cast<std::size_t>(rows_) + 1, 0);
  for (std::size_t i = 0; i < count; ++i) ++begins_[bucket(i) + 1];
  for (std::size_t b = 1; b < begins_.size(); ++b) begins_[b] += begins_[b - 1];
  x_.assign(count + 1, 0);
  y_.assign(count + 1, 0);
  z_.assign(count + 1, std::numeric_limits<float>::quiet_NaN());
  for (std::size_t i = 0; i < count; ++i) {
    const std::uint32_t to = begins_[bucket(i)]++;
    x_[to] = unsorted_x_[i];
    y_[to] = unsorted_y_[i];
    z_[to] = unsorted_z_[i];
  }
  for (std::size_t b = begins_.size() - 1; b > 0; --b) begins_[b] = begins_[b - 1];
  begins_[0] = 0;
}

std::size_t PointWindow::nearest(const FitCorner& place) const {
  std::size_t best = size();
  double least = std::numeric_limits<double>::infinity();
  const auto offer = [&](std::uint32_t begin, std::uint32_t end) {
    for (std::uint32_t i = begin; i < end; ++i) {
      const double x = double{x_[i]} - place.x, y = double{y_[i]} - place.y, square = x * x + y * y;
      if (square < least || (square == least && i < best)) {
        least = square;
        best = i;
      }
    }
  };
  const double side = height_of_row();
  const std::int32_t col = std::clamp(place.x >> shift_, 0, cols_ - 1),
                     row = std::clamp(place.y >> shift_, 0, rows_ - 1);
  const std::int32_t farthest = std::max(cols_, rows_);
  for (std::int32_t ring = 0; ring <= farthest; ++ring) {
    // All samples beyond the rings so far are at least this far away.
    const double reach = (ring - 1) * side;
    if (ring > 0 && least < std::max(reach, 0.0) * std::max(reach, 0.0)) break;
    for (std::int32_t r = std::max(row - ring, 0); r <= std::min(row + ring, rows_ - 1); ++r) {
      const std::uint32_t* const begins = begins_.data() + std::ptrdiff_t{r} * cols_;
      const std::int32_t first = std::max(col - ring, 0), last = std::min(col + ring, cols_ - 1);
      if (r == row - ring || r == row + ring) {
        offer(begins[first], begins[last + 1]);
        continue;
      }
      if (col - ring >= 0) offer(begins[col - ring], begins[col - ring + 1]);
      if (col + ring < cols_) offer(begins[col + ring], begins[col + ring + 1]);
    }
  }
  return best;
}

}  // namespace scarp::fit
