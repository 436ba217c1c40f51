#include <fmt/format.h>

#include <algorithm>
#include <cstdint>
#include <limits>
#include <vector>

#include "grid/outline.h"
#include "grid/raster.h"
#include "scarp/water.h"

namespace scarp {
namespace {

class Flats {
 public:
  Flats(const OwnedHeightField& field, const std::array<double, 6>& affine)
      : raster_{field.samples.data(), field.cols, field.rows}, affine_(affine), is_seen_(field.samples.size(), 0) {}

  std::vector<Lake> find(std::uint64_t min_samples) {
    std::vector<Lake> lakes;
    for (std::int32_t y = 0; y < raster_.rows; ++y) {
      for (std::int32_t x = 0; x < raster_.cols; ++x) {
        if (is_seen_[index({x, y})] != 0 || !raster_.is_valid({x, y})) continue;
        flood({x, y});
        if (members_.size() < min_samples) continue;
        Lake lake = outline(static_cast<std::uint32_t>(lakes.size()));
        if (!lake.shore.empty()) lakes.push_back(std::move(lake));
      }
    }
    return lakes;
  }

 private:
  std::size_t index(Point p) const {
    return static_cast<std::size_t>(p.y) * static_cast<std::size_t>(raster_.cols) + static_cast<std::size_t>(p.x);
  }

  /// Collects all samples of this height that are connected with it, side by side.
  void flood(Point first) {
    const float height = raster_.at(first);
    members_.assign(1, first);
    is_seen_[index(first)] = 1;
    for (std::size_t i = 0; i < members_.size(); ++i) {
      const Point p = members_[i];
      for (const Point q : {Point{p.x - 1, p.y}, Point{p.x + 1, p.y}, Point{p.x, p.y - 1}, Point{p.x, p.y + 1}}) {
        const bool is_in = q.x >= 0 && q.y >= 0 && q.x < raster_.cols && q.y < raster_.rows;
        if (!is_in || is_seen_[index(q)] != 0 || raster_.at(q) != height) continue;
        is_seen_[index(q)] = 1;
        members_.push_back(q);
      }
    }
  }

  /// The surface of the samples alone.
  Lake outline(std::uint32_t number) const {
    const auto [left, right] =
        std::minmax_element(members_.begin(), members_.end(), [](Point a, Point b) { return a.x < b.x; });
    const auto [top, bottom] =
        std::minmax_element(members_.begin(), members_.end(), [](Point a, Point b) { return a.y < b.y; });
    const Point first{left->x, top->y};
    const std::int32_t cols = right->x - first.x + 1, rows = bottom->y - first.y + 1;
    std::vector<float> heights(static_cast<std::size_t>(cols) * static_cast<std::size_t>(rows),
                               std::numeric_limits<float>::quiet_NaN());
    for (const Point p : members_)
      heights[static_cast<std::size_t>(p.y - first.y) * static_cast<std::size_t>(cols) +
              static_cast<std::size_t>(p.x - first.x)] = raster_.at(p);
    Lake lake;
    lake.level = raster_.at(members_.front());
    lake.name = fmt::format("flat at column {}, row {}", members_.front().x, members_.front().y);
    for (const std::vector<Point>& polygon : trace_outline({heights.data(), cols, rows})) {
      Line ring;
      ring.role = lake.shore.empty() ? LineRole::kOuter : LineRole::kHole;
      ring.polygon = number;
      ring.name = lake.name;
      for (const Point p : polygon) ring.points.push_back(place_of({first.x + p.x, first.y + p.y}, lake.level));
      ring.points.push_back(ring.points.front());
      lake.shore.push_back(std::move(ring));
    }
    return lake;
  }

  std::array<double, 3> place_of(Point p, double height) const {
    return {affine_[0] + p.x * affine_[1] + p.y * affine_[2], affine_[3] + p.x * affine_[4] + p.y * affine_[5], height};
  }

  Raster raster_;
  std::array<double, 6> affine_;
  std::vector<std::uint8_t> is_seen_;
  std::vector<Point> members_;
};

}  // namespace

Result<std::vector<Lake>> find_flats(const OwnedHeightField& field, const FlatOptions& options) {
  if (options.min_samples < 3)
    return fail(ErrorKind::kUsage,
                fmt::format("a flat area has at least 3 samples, not {}: fewer have no area", options.min_samples));
  if (field.source != nullptr) return fail(ErrorKind::kUsage, "flat areas need the raster in memory as a whole");
  return Flats(field, options.affine).find(options.min_samples);
}

}  // namespace scarp
