#include "live/sample_ring.h"

#include <algorithm>

namespace scarp::live {

Area Area::clipped(const Area& to) const {
  return {std::max(west, to.west), std::max(north, to.north), std::min(east, to.east), std::min(south, to.south)};
}

void Area::include(std::int32_t col, std::int32_t row) {
  *this = is_empty() ? Area{col, row, col, row}
                     : Area{std::min(west, col), std::min(north, row), std::max(east, col), std::max(south, row)};
}

std::array<Area, 4> Area::beyond(const Area& other) const {
  return {Area{west, north, east, std::min(south, other.north - 1)},
          Area{west, std::max(north, other.south + 1), east, south},
          Area{west, north, std::min(east, other.west - 1), south},
          Area{std::max(west, other.east + 1), north, east, south}};
}

template <class Visit>
void SampleRing::visit_runs(std::int32_t row, std::int32_t west, std::int32_t east, const Visit& visit) const {
  const std::size_t begin = std::size_t(modulo(row, rows_)) * std::size_t(cols_);
  for (std::int32_t col = west; col <= east;) {
    const std::int32_t at = modulo(col, cols_), count = std::min(cols_ - at, east - col + 1);
    visit(begin + std::size_t(at), std::size_t(count), std::size_t(col - west));
    col += count;
  }
}

void SampleRing::read(const Area& area, const Area& field, float* out) const {
  const Area inside = area.clipped(field);
  for (std::int32_t row = area.north; row <= area.south; ++row, out += area.cols()) {
    if (inside.is_empty() || row < inside.north || row > inside.south) {
      std::fill_n(out, area.cols(), missing_);
      continue;
    }
    std::fill_n(out, inside.west - area.west, missing_);
    std::fill(out + (inside.east + 1 - area.west), out + area.cols(), missing_);
    visit_runs(row, inside.west, inside.east, [&](std::size_t at, std::size_t count, std::size_t offset) {
      std::copy_n(&values_[at], count, out + (inside.west - area.west) + offset);
    });
  }
}

void SampleRing::write(const Area& area, std::span<const float> values) {
  for (std::int32_t row = area.north; row <= area.south; ++row) {
    visit_runs(row, area.west, area.east, [&](std::size_t at, std::size_t count, std::size_t offset) {
      std::copy_n(values.begin() + std::ptrdiff_t(offset), count, &values_[at]);
    });
    values = values.subspan(std::size_t(area.cols()));
  }
}

void SampleRing::clear(const Area& area) {
  for (std::int32_t row = area.north; row <= area.south; ++row) {
    visit_runs(row, area.west, area.east,
               [&](std::size_t at, std::size_t count, std::size_t) { std::fill_n(&values_[at], count, missing_); });
  }
}

}  // namespace scarp::live
