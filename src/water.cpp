#include "scarp/water.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <optional>
#include <utility>

#include "breaklines.h"
#include "grid/affine_map.h"
#include "grid/raster.h"
#include "line_marks.h"

namespace scarp {
namespace {

/// Samples [col, col + cols) × [row, row + rows).
struct Box {
  int col = 0, row = 0, cols = 0, rows = 0;
};

class Waters {
 public:
  Waters(OwnedHeightField& field, const WaterOptions& options)
      : field_(field),
        options_(options),
        affine_(options.affine),
        to_samples_(options.affine),
        is_water_(field.samples.size(), 0) {}

  /// The percentile of the surface along the rings; nothing where it is nowhere valid.
  std::optional<double> level_of(std::span<const Line> rings) const {
    const Raster raster{field_.samples.data(), field_.cols, field_.rows};
    std::vector<float> heights;
    for (const Line& ring : rings) {
      for (std::size_t k = 0; k + 1 < ring.points.size(); ++k) {
        const auto p = place_of(ring.points[k]), q = place_of(ring.points[k + 1]);
        const double length = std::max(std::abs(q.col - p.col), std::abs(q.row - p.row));
        constexpr double kMostLooks = 1 << 20;
        const auto looks = static_cast<int>(std::min(std::ceil(2 * length), kMostLooks)) + 1;
        for (int i = 0; i < looks; ++i) {
          const double at = static_cast<double>(i) / looks;
          const double height = surface_at(raster, {p.col + at * (q.col - p.col), p.row + at * (q.row - p.row)});
          if (!std::isnan(height)) heights.push_back(static_cast<float>(height));
        }
      }
    }
    if (heights.empty()) return std::nullopt;
    const auto rank = static_cast<std::ptrdiff_t>(options_.percentile / 100 * static_cast<double>(heights.size() - 1));
    std::nth_element(heights.begin(), heights.begin() + rank, heights.end());
    return double{heights[static_cast<std::size_t>(rank)]};
  }

  /// REQUIRES: a level of level_of().
  Lake flatten(std::span<const Line> rings, double level) {
    Lake lake;
    lake.name = rings.front().name;
    lake.level = level;
    const Box box = box_of(rings);
    std::array<double, 6> affine = affine_;
    affine[0] += box.col * affine_[1] + box.row * affine_[2];
    affine[3] += box.col * affine_[4] + box.row * affine_[5];
    LineMarks marks(affine, box.cols, box.rows);
    marks.add_polygons(rings);
    // Lines are rounded to the lattice: what that puts into the lake is part of it.
    for (const Line& ring : rings) marks.add_course(ring, 1.0 / 128);
    each_mark(marks, box, [&](int col, int row) {
      is_water_[index(col, row)] = 1;
      lake.samples += put(index(col, row), static_cast<float>(lake.level), lake);
    });
    const auto rim = static_cast<float>(lake.level + options_.freeboard);
    each_mark(marks, box, [&](int col, int row) { lake.raised += raise_around(col, row, rim, lake); });
    for (Line ring : rings) {
      for (auto& point : ring.points) point[2] = lake.level;
      lake.shore.push_back(std::move(ring));
    }
    return lake;
  }

 private:
  std::size_t index(int col, int row) const {
    return static_cast<std::size_t>(row) * static_cast<std::size_t>(field_.cols) + static_cast<std::size_t>(col);
  }
  SamplePlace place_of(const std::array<double, 3>& point) const { return to_samples_.place(point[0], point[1]); }

  /// With a sample around.
  Box box_of(std::span<const Line> rings) const {
    double left = field_.cols, right = 0, top = field_.rows, bottom = 0;
    for (const Line& ring : rings) {
      for (const auto& point : ring.points) {
        const auto [col, row] = place_of(point);
        left = std::min(left, col);
        right = std::max(right, col);
        top = std::min(top, row);
        bottom = std::max(bottom, row);
      }
    }
    const auto within = [](double place, int size) {
      return static_cast<int>(std::clamp(place, 0.0, static_cast<double>(size)));
    };
    const int first_col = within(std::floor(left) - 1, field_.cols),
              first_row = within(std::floor(top) - 1, field_.rows);
    return {first_col, first_row, within(std::ceil(right) + 2, field_.cols) - first_col,
            within(std::ceil(bottom) + 2, field_.rows) - first_row};
  }

  template <class Visit>
  static void each_mark(const LineMarks& marks, const Box& box, const Visit& visit) {
    for (int row = 0; row < box.rows; ++row) {
      for (int col = 0; col < box.cols; ++col) {
        if (marks.has(static_cast<std::size_t>(row) * static_cast<std::size_t>(box.cols) +
                      static_cast<std::size_t>(col)))
          visit(box.col + col, box.row + row);
      }
    }
  }

  /// 1 if the sample is a height and was another.
  std::uint64_t put(std::size_t at, float height, Lake& lake) {
    float& sample = field_.samples[at];
    if (std::isnan(sample) || sample == height) return 0;
    lake.largest_change = std::max(lake.largest_change, std::abs(double{sample} - double{height}));
    sample = height;
    return 1;
  }

  std::uint64_t raise_around(int col, int row, float rim, Lake& lake) {
    std::uint64_t raised = 0;
    for (int y = std::max(row - 1, 0); y <= std::min(row + 1, field_.rows - 1); ++y) {
      for (int x = std::max(col - 1, 0); x <= std::min(col + 1, field_.cols - 1); ++x) {
        if (!is_water_[index(x, y)] && field_.samples[index(x, y)] < rim) raised += put(index(x, y), rim, lake);
      }
    }
    return raised;
  }

  OwnedHeightField& field_;
  WaterOptions options_;
  std::array<double, 6> affine_;
  MapToSamples to_samples_;
  std::vector<std::uint8_t> is_water_;
};

}  // namespace

Result<std::vector<Lake>> flatten_lakes(OwnedHeightField& field, std::span<const Line> lines,
                                        const WaterOptions& options) {
  if (!(options.percentile >= 0 && options.percentile <= 100))
    return fail(ErrorKind::kUsage,
                fmt::format("the percentile of a shore must lie in 0 … 100, not {}", options.percentile));
  if (!(options.freeboard > 0 && std::isfinite(options.freeboard)))
    return fail(ErrorKind::kUsage, fmt::format("the freeboard must be above 0, not {}", options.freeboard));
  if (field.source != nullptr) return fail(ErrorKind::kUsage, "lakes need the raster in memory as a whole");
  Waters waters(field, options);
  // All levels before any change: a lake's shore is the raster's, not what its neighbour has made of it.
  std::vector<std::pair<std::span<const Line>, double>> found;
  for (std::size_t first = 0, end = 0; first < lines.size(); first = end) {
    end = first + 1;
    if (!lines[first].is_ring()) continue;
    while (end < lines.size() && lines[end].polygon == lines[first].polygon) ++end;
    const auto rings = lines.subspan(first, end - first);
    if (const auto level = waters.level_of(rings)) found.emplace_back(rings, *level);
  }
  std::vector<Lake> lakes;
  for (const auto& [rings, level] : found) lakes.push_back(waters.flatten(rings, level));
  return lakes;
}

}  // namespace scarp
