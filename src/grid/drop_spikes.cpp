#include <algorithm>
#include <array>
#include <cmath>
#include <cstdint>
#include <limits>
#include <vector>

#include "base/parallel.h"
#include "grid/keep_points.h"
#include "scarp/points.h"

namespace scarp {

namespace {

constexpr std::size_t kNeighbours = 8, kAllowed = 1;
constexpr double kPerBucket = 2;

/// The points in square buckets over their extent.
class Buckets {
 public:
  explicit Buckets(const PointSet& points) : points_(points) {
    const auto [west, east] = std::minmax_element(points.x.begin(), points.x.end());
    const auto [south, north] = std::minmax_element(points.y.begin(), points.y.end());
    west_ = *west;
    south_ = *south;
    const double width = *east - *west, height = *north - *south, longest = std::max(width, height);
    const double count = std::max(1.0, static_cast<double>(points.size()) / kPerBucket);
    // Points along a line have as many buckets as others.
    side_ = std::max(std::sqrt(width * height / count), longest / count);
    if (!(side_ > 0)) side_ = 1;
    cols_ = static_cast<std::int64_t>(width / side_) + 1;
    rows_ = static_cast<std::int64_t>(height / side_) + 1;
    starts_.assign(static_cast<std::size_t>(cols_ * rows_) + 1, 0);
    for (std::size_t i = 0; i < points.size(); ++i) ++starts_[bucket_of(i) + 1];
    for (std::size_t b = 1; b < starts_.size(); ++b) starts_[b] += starts_[b - 1];
    std::vector<std::uint32_t> next(starts_.begin(), starts_.end() - 1);
    members_.resize(points.size());
    for (std::uint32_t i = 0; i < points.size(); ++i) members_[next[bucket_of(i)]++] = i;
  }

  /// True if the point's height differs by more than `most` from those of all but kAllowed of its nearest neighbours.
  bool is_spike(std::uint32_t point, double most) const {
    struct Neighbour {
      double square;
      std::uint32_t point;
      bool operator<(const Neighbour& other) const {
        return square != other.square ? square < other.square : point < other.point;
      }
    };
    std::array<Neighbour, kNeighbours> nearest;
    std::size_t found = 0;
    const double x = points_.x[point], y = points_.y[point];
    const std::int64_t col = col_of(x), row = row_of(y), farthest = std::max(cols_, rows_);
    for (std::int64_t ring = 0; ring <= farthest; ++ring) {
      // All points within (ring - 1) bucket sides were seen.
      const double seen = static_cast<double>(ring - 1) * side_;
      if (found == kNeighbours && ring > 0 && nearest.back().square <= seen * seen) break;
      for (std::int64_t r = std::max<std::int64_t>(row - ring, 0); r <= std::min(row + ring, rows_ - 1); ++r) {
        const bool is_whole = r == row - ring || r == row + ring;
        for (std::int64_t c = col - ring; c <= col + ring; c += is_whole || ring == 0 ? 1 : 2 * ring) {
          if (c < 0 || c >= cols_) continue;
          const auto b = static_cast<std::size_t>(r * cols_ + c);
          for (std::uint32_t k = starts_[b]; k < starts_[b + 1]; ++k) {
            const std::uint32_t other = members_[k];
            if (other == point) continue;
            const double dx = points_.x[other] - x, dy = points_.y[other] - y;
            const Neighbour here{dx * dx + dy * dy, other};
            if (found == kNeighbours && !(here < nearest.back())) continue;
            if (found < kNeighbours) ++found;
            std::size_t at = found - 1;
            for (; at > 0 && here < nearest[at - 1]; --at) nearest[at] = nearest[at - 1];
            nearest[at] = here;
          }
        }
      }
    }
    std::size_t near = 0;
    for (std::size_t k = 0; k < found; ++k) near += std::abs(points_.z[nearest[k].point] - points_.z[point]) <= most;
    return found > kAllowed && near <= kAllowed;
  }

 private:
  std::int64_t col_of(double x) const { return std::min(static_cast<std::int64_t>((x - west_) / side_), cols_ - 1); }
  std::int64_t row_of(double y) const { return std::min(static_cast<std::int64_t>((y - south_) / side_), rows_ - 1); }
  std::size_t bucket_of(std::size_t i) const {
    return static_cast<std::size_t>(row_of(points_.y[i]) * cols_ + col_of(points_.x[i]));
  }

  const PointSet& points_;
  double west_ = 0, south_ = 0, side_ = 1;
  std::int64_t cols_ = 1, rows_ = 1;
  std::vector<std::uint32_t> starts_, members_;
};

}  // namespace

std::uint64_t drop_spikes(double most, int threads, PointSet& points) {
  if (points.size() == 0 || !grid::has_finite_places(points)) return 0;
  std::vector<std::uint8_t> stays(points.size(), 1);
  for (const PointLine& line : points.lines) {
    for (const std::uint32_t point : line.points) stays[point] = 2;
  }
  const Buckets buckets(points);
  parallel_for_parts(points.size(), 1 << 14, threads, [&](std::size_t first, std::size_t end) {
    for (std::size_t i = first; i < end; ++i) {
      if (stays[i] == 1 && buckets.is_spike(static_cast<std::uint32_t>(i), most)) stays[i] = 0;
    }
  });
  const std::size_t given = points.size();
  grid::keep_points(points, [&](std::size_t i) { return stays[i] != 0; });
  const std::uint64_t dropped = given - points.size();
  points.spikes += dropped;
  return dropped;
}

}  // namespace scarp
