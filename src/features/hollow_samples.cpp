#include "features/hollow_samples.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <span>

#include "grid/bands.h"

namespace scarp::features {

namespace {

constexpr std::int32_t kNearHollow = 2;
constexpr std::int32_t kReach = kHollowReach + kNearHollow;

}  // namespace

Result<HollowSamples> HollowSamples::find(const HeightField& field, const Question& question) {
  HollowSamples found;
  found.begins_.reserve(static_cast<std::size_t>(field.rows) + 1);
  found.begins_.push_back(0);
  const auto cols = static_cast<std::size_t>(field.cols);
  std::vector<float> turned;
  std::vector<std::uint8_t> is_near(cols);
  const auto visit = [&](const grid::RowRange& strip) -> Result<void> {
    grid::Raster raster = strip.samples;
    if (question.is_upside_down) {
      turned.assign(raster.samples, raster.row(raster.rows));
      for (float& height : turned) height = -height;
      raster.samples = turned.data();
    }
    const std::int32_t from = std::max(strip.begin - kNearHollow, strip.first),
                       to = std::min(strip.end + kNearHollow, strip.first + raster.rows);
    const std::vector<Hollow> hollows =
        find_hollows(raster, question.height, question.threads, from - strip.first, to - strip.first);
    const auto hollows_of = [&](std::int32_t row) {
      return std::span(hollows).subspan(static_cast<std::size_t>(row - from) * cols, cols);
    };
    for (std::int32_t row = strip.begin; row < strip.end; ++row) {
      std::fill(is_near.begin(), is_near.end(), 0);
      for (std::int32_t y = std::max(row - kNearHollow, from); y <= std::min(row + kNearHollow, to - 1); ++y) {
        const auto of = hollows_of(y);
        for (std::size_t x = 0; x < cols; ++x) {
          if (of[x] == Hollow::kNone) continue;
          const std::size_t first = x - std::min<std::size_t>(x, kNearHollow),
                            end = std::min(x + kNearHollow + 1, cols);
          std::fill(is_near.begin() + static_cast<std::ptrdiff_t>(first),
                    is_near.begin() + static_cast<std::ptrdiff_t>(end), 1);
        }
      }
      const float* heights = raster.row(row - strip.first);
      for (std::int32_t col = 0; col < field.cols; ++col) {
        const auto x = static_cast<std::size_t>(col);
        if (is_near[x] == 0 || std::isnan(heights[col]) || question.is_left_out({col, row})) continue;
        found.heights_.push_back(heights[col]);
        found.cols_.push_back(col);
        found.hollows_.push_back(hollows_of(row)[x]);
      }
      if (found.size() > std::numeric_limits<std::uint32_t>::max() - 1)
        return fail(ErrorKind::kInput,
                    "the raster has more than 4,294 million samples near ridges: ask for higher ones");
      found.begins_.push_back(static_cast<std::uint32_t>(found.size()));
    }
    return question.check(found.size(), static_cast<double>(strip.end) / field.rows);
  };
  SCARP_RETURN_IF_ERROR(grid::sweep_rows(field, kReach, visit));
  return found;
}

std::uint64_t HollowSamples::bytes(const HeightField& field) {
  // The strip, its negated copy, and the results for it.
  return 2 * grid::sweep_bytes(field, kReach) + grid::sweep_bytes(field, kReach) / 4 +
         sizeof(std::uint32_t) * static_cast<std::uint64_t>(field.rows);
}

Point HollowSamples::point(std::uint32_t i) const {
  const auto row = std::upper_bound(begins_.begin(), begins_.end(), i) - begins_.begin() - 1;
  return {cols_[i], static_cast<std::int32_t>(row)};
}

/// The first sample in the row of p at or after p's column.
std::uint32_t HollowSamples::first_from(Point p) const {
  const std::uint32_t end = end_of(p.y);
  if (end == 0) return 0;
  const auto at = [&](std::uint32_t i) { return cols_.begin() + static_cast<std::ptrdiff_t>(i); };
  const std::uint32_t begin = begins_[static_cast<std::size_t>(p.y)];
  return static_cast<std::uint32_t>(std::lower_bound(at(begin), at(end), p.x) - cols_.begin());
}

}  // namespace scarp::features
