#include "measure/band.h"

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <limits>
#include <utility>

#include "base/sort.h"
#include "grid/height_range.h"

namespace scarp::judge {
namespace {

/// Doubles of a cache line.
constexpr std::size_t kLine = 8;

/// Sets 1 for each valid sample. Returns true if all are valid.
bool mark_heights(const float* samples, std::vector<std::uint8_t>& marks) {
  bool all = true;
  for (std::size_t i = 0; i < marks.size(); ++i) {
    const bool is_height = !std::isnan(samples[i]);
    marks[i] = is_height;
    all &= is_height;
  }
  return all;
}

}  // namespace

Result<Band> Band::read(const HeightField& field, int first, int rows, const Limits& limits, double guard,
                        Histogram& histogram) {
  Band band(field, first, rows, limits, guard, histogram);
  SCARP_RETURN_IF_ERROR(band.take_heights(field));
  if (limits.source != nullptr) {
    band.tolerances_.resize(static_cast<std::size_t>(rows) * static_cast<std::size_t>(field.cols));
    SCARP_RETURN_IF_ERROR(limits.source->read(0, first, field.cols, rows, band.tolerances_.data(), field.cols));
  }
  band.classify();
  if (limits.region != nullptr) band.cut();
  band.is_whole_ = true;
  for (int row = first; row < band.end(); ++row) band.is_whole_ = band.is_whole_ && band.is_whole(row);
  return band;
}

Band::Band(const HeightField& field, int first, int rows, const Limits& limits, double guard, Histogram& histogram)
    : cols_(field.cols),
      stride_(static_cast<int>((static_cast<std::size_t>(field.cols) + kLine - 1) / kLine * kLine)),
      first_(first),
      rows_(rows),
      has_row_below_(first + rows < field.rows),
      limits_(limits),
      least_limit_(limits.by_sample.empty() && limits.source == nullptr ? limits.everywhere : -HUGE_VAL),
      guard_(guard),
      histogram_(histogram),
      valid_(static_cast<std::size_t>(rows) + 2, 0) {
  const std::size_t errors = static_cast<std::size_t>(rows) * static_cast<std::size_t>(stride_) + kKernelPadding;
  errors_.resize(errors + kLine);
  all_errors_ = errors_.data() + (-reinterpret_cast<std::uintptr_t>(errors_.data()) / sizeof(double)) % kLine;
  std::fill_n(all_errors_, errors, std::numeric_limits<double>::quiet_NaN());
  row_nodata_cells_.assign(static_cast<std::size_t>(rows), 0);
  report_.rows.resize(static_cast<std::size_t>(rows));
  if (limits.region != nullptr) places_ = limits.region->places(first, rows);
}

Result<void> Band::take_heights(const HeightField& field) {
  const auto cols = static_cast<std::size_t>(cols_);
  const int top = std::max(first_ - 1, 0), bottom = std::min(end() + 1, field.rows);
  if (borrow_heights(field, top, bottom)) return {};
  const std::size_t size = (static_cast<std::size_t>(rows_) + 2) * cols;
  constexpr float kNone = std::numeric_limits<float>::quiet_NaN();
  heights_.resize(size + kKernelPadding);
  all_heights_ = heights_.data();
  std::fill(heights_.end() - kKernelPadding, heights_.end(), kNone);
  if (field.samples == nullptr) {
    SCARP_RETURN_IF_ERROR(field.source->read(0, top, cols_, bottom - top, &heights_[height_at(0, top)], cols_));
  }
  const float nodata = field.samples != nullptr ? field.nodata.value_or(kNone) : kNone;
  std::vector<RowHeights> taken;
  taken.reserve(static_cast<std::size_t>(rows_) + 2);
  for (int row = first_ - 1; row <= end(); ++row) {
    float* heights = &heights_[height_at(0, row)];
    if (row < top || row >= bottom) {
      std::fill_n(heights, cols, kNone);
      continue;
    }
    const float* from = field.samples != nullptr ? field.samples + static_cast<std::size_t>(row) * cols : heights;
    taken.push_back(judge_kernels().take_row(from, cols_, nodata, heights));
    valid_[static_cast<std::size_t>(row - first_ + 1)] = static_cast<std::int32_t>(taken.back().valid);
  }
  note_range(taken, top);
  return {};
}

bool Band::borrow_heights(const HeightField& field, int top, int bottom) {
  // Kernels read beyond a row, which is safe only if another row follows in memory.
  const bool has_both = top == first_ - 1 && bottom == end() + 1 && cols_ >= static_cast<int>(kKernelPadding);
  if (field.samples == nullptr || limits_.region != nullptr || !has_both) return false;
  const float* const from = field.samples + static_cast<std::size_t>(top) * static_cast<std::size_t>(cols_);
  const float nodata = field.nodata.value_or(std::numeric_limits<float>::quiet_NaN());
  std::vector<RowHeights> taken;
  taken.reserve(static_cast<std::size_t>(rows_) + 2);
  for (int row = top; row < bottom; ++row) {
    const float* heights = from + static_cast<std::ptrdiff_t>(row - top) * cols_;
    taken.push_back(judge_kernels().take_row(heights, cols_, nodata, nullptr));
    if (taken.back().valid != static_cast<std::uint32_t>(cols_)) return false;
  }
  std::fill(valid_.begin(), valid_.end(), cols_);
  all_heights_ = from;
  note_range(taken, top);
  return true;
}

/// Adds the range of the band's rows, the lowest and the highest row first, so that most other rows need no scan.
void Band::note_range(const std::vector<RowHeights>& rows, int top) {
  int lowest = first_, highest = first_;
  const auto heights_of = [&](int row) -> const RowHeights& { return rows[static_cast<std::size_t>(row - top)]; };
  for (int row = first_; row < end(); ++row) {
    if (heights_of(row).least < heights_of(lowest).least) lowest = row;
    if (heights_of(row).most > heights_of(highest).most) highest = row;
  }
  const auto note = [&](int row) {
    const RowHeights& found = heights_of(row);
    grid::add_samples(report_.heights, {heights(row), static_cast<std::size_t>(cols_)}, found.least, found.most,
                      found.valid);
  };
  note(lowest);
  if (highest != lowest) note(highest);
  for (int row = first_; row < end(); ++row) {
    if (row != lowest && row != highest) note(row);
  }
}

void Band::drop(int col, int row) {
  heights_[height_at(col, row)] = std::numeric_limits<float>::quiet_NaN();
  --valid_[static_cast<std::size_t>(row - first_ + 1)];
}

void Band::classify() {
  const auto cols = static_cast<std::size_t>(cols_);
  const auto all_are_whole = [this](int first, int last) {
    while (first <= last && is_whole(first)) ++first;
    return first > last;
  };
  if (has_row_below_ ? all_are_whole(first_, end()) : all_are_whole(rows_ > 1 ? first_ : first_ - 1, end() - 1)) return;
  // marks: rows r − 1, r, r + 1. counts[c]: heights among the four corners of a cell, above and below row r.
  std::vector<std::uint8_t> before(cols), here(cols), after(cols), above(cols, 0), below(cols, 0);
  const auto count_cells = [&](const std::vector<std::uint8_t>& top, const std::vector<std::uint8_t>& bottom,
                               std::vector<std::uint8_t>& counts) {
    for (std::size_t c = 0; c + 1 < cols; ++c) {
      counts[c] = static_cast<std::uint8_t>(top[c] + top[c + 1] + bottom[c] + bottom[c + 1]);
    }
  };
  mark_heights(heights(first_ - 1), before);
  bool here_is_whole = mark_heights(heights(first_), here);
  count_cells(before, here, above);
  for (int row = first_; row < end(); ++row) {
    const bool after_is_whole = mark_heights(heights(row + 1), after);
    if (here_is_whole && after_is_whole) {
      std::fill(below.begin(), below.end(), std::uint8_t{4});
    } else {
      count_cells(here, after, below);
    }
    // Two successive whole rows need no check of single samples; both count arrays remain valid for the next row.
    const bool has_cells = row + 1 < end() || has_row_below_;
    if (!(here_is_whole && after_is_whole && has_cells)) {
      for (std::size_t c = 0; c < cols; ++c) {
        if (!here[c]) continue;
        const bool left = c > 0 && (above[c - 1] >= 3 || below[c - 1] >= 3);
        const bool right = c + 1 < cols && (above[c] >= 3 || below[c] >= 3);
        if (left || right) continue;
        drop(static_cast<int>(c), row);
        const bool is_cut_off =
            limits_.region != nullptr && place(static_cast<int>(c), row) == CutRegion::Place::kOutside;
        ++(is_cut_off ? report_.cut_off : report_.stray);
      }
      for (std::size_t c = 0; has_cells && c + 1 < cols; ++c) {
        if (below[c] == 4) continue;
        if (cells_.empty()) cells_.assign(static_cast<std::size_t>(rows_) * cols, kWhole);
        std::uint8_t kind = kNodata;
        if (below[c] == 3) {
          const int missing = !here[c] ? 0 : !here[c + 1] ? 1 : !after[c] ? 2 : 3;
          kind = static_cast<std::uint8_t>(kHalf + missing);
        }
        cells_[at(static_cast<int>(c), row)] = kind;
        row_nodata_cells_[static_cast<std::size_t>(row - first_)] = 1;
        has_nodata_cells_ = true;
      }
    }
    std::swap(here, after);
    std::swap(above, below);
    here_is_whole = after_is_whole;
  }
}

void Band::cut() {
  for (int row = first_; row < end(); ++row) {
    for (int c = 0; c < cols_; ++c) {
      if (std::isnan(heights(row)[c]) || place(c, row) != CutRegion::Place::kOutside) continue;
      drop(c, row);
      ++report_.cut_off;
    }
  }
}

std::optional<std::array<double, 2>> Band::nodata_point(int col, int row) const {
  const std::uint8_t kind = cells_[at(col, row)];
  if (kind == kWhole || kind == kCounted) return std::nullopt;
  if (kind == kNodata) return std::array<double, 2>{col + 0.5, row + 0.5};
  // The nodata half is the triangle of the missing corner and its two neighbours.
  const int missing = kind - kHalf;
  return std::array<double, 2>{col + ((missing & 1) ? 2.0 : 1.0) / 3, row + ((missing & 2) ? 2.0 : 1.0) / 3};
}

void Band::count_nodata_cell(int col, int row) {
  cells_[at(col, row)] = kCounted;
  ++report_.nodata_cells_covered;
}

bool Band::find_missing() {
  bool any = false;
  row_missing_.assign(static_cast<std::size_t>(rows_), 0);
  for (int row = first_; row < end(); ++row) {
    const auto index = static_cast<std::size_t>(row - first_);
    const Buckets buckets = sum(row);
    const bool is_covered = report_.rows[index].samples == static_cast<std::uint64_t>(valid_[index + 1]);
    if (!is_covered && find_missing(row)) {
      row_missing_[index] = 1;
      any = true;
    } else {
      histogram_.add(buckets);
    }
  }
  return any;
}

bool Band::find_missing(int row) {
  bool any = false;
  const float* height = heights(row);
  const double* error = errors(row);
  for (int c = 0; c < cols_; ++c) {
    if (!std::isnan(error[c]) || std::isnan(height[c])) continue;
    if (limits_.region != nullptr && place(c, row) == CutRegion::Place::kNear) {
      ++report_.cut_off;
      continue;
    }
    if (nearest_.empty()) nearest_.assign(static_cast<std::size_t>(rows_) * static_cast<std::size_t>(cols_), {});
    any = true;
    nearest_[at(c, row)].distance = HUGE_VAL;
  }
  return any;
}

void Band::offer_nearest(int col, int row, double distance, std::uint32_t triangle, double error) {
  Nearest& nearest = nearest_[at(col, row)];
  double& held = errors(row)[col];
  if (distance > nearest.distance || (distance == nearest.distance && std::abs(error) <= std::abs(held))) return;
  nearest = {distance, triangle};
  held = error;
}

Buckets Band::sum(int row) {
  Buckets buckets;
  report_.rows[static_cast<std::size_t>(row - first_)] =
      sum_row({errors(row), static_cast<std::size_t>(cols_)}, scratch_, buckets);
  return buckets;
}

void Band::find_largest() {
  int row = -1;
  for (int r = first_; r < end(); ++r) {
    const double largest = report_.rows[static_cast<std::size_t>(r - first_)].largest;
    if (!(largest > report_.largest)) continue;
    report_.largest = largest;
    row = r;
  }
  if (row < 0) return;
  const double* error = errors(row);
  int col = 0;
  while (std::abs(error[col]) != report_.largest) ++col;
  report_.largest_at = {col, row};
}

BandReport Band::finish(Keep keep) {
  for (int row = first_; row < end(); ++row) {
    if (row_has_missing(row)) histogram_.add(sum(row));
    const double* error = errors(row);
    for (int c = 0; has_tolerances() && c < cols_; ++c) {
      if (std::abs(error[c]) > tolerance(c, row)) ++report_.over_tolerance;
    }
    for (int c = 0; !nearest_.empty() && c < cols_; ++c) {
      if (!is_missing(c, row)) continue;
      if (std::isnan(error[c])) {
        if (report_.uncovered++ == 0) report_.uncovered_at = {c, row};
        if (limits_.with_uncovered) report_.uncovered_offenders.push_back({c, row, HUGE_VAL});
      } else if (is_offender(c, row, error[c])) {
        add_offender(nearest_[at(c, row)].triangle, {c, row, error[c]});
      }
    }
  }
  find_largest();
  // Keep only the worst sample of each triangle; ties by the lowest row, then column.
  auto& offenders = report_.offenders;
  sort_rarely(offenders, is_worse_of_triangle);
  const auto same = [](const TriangleOffender& a, const TriangleOffender& b) { return a.triangle == b.triangle; };
  offenders.erase(std::unique(offenders.begin(), offenders.end(), same), offenders.end());
  if (keep != Keep::kNothing) {
    report_.kept.resize(static_cast<std::size_t>(rows_) * static_cast<std::size_t>(cols_));
    for (int row = first_; row < end(); ++row) {
      const float* height = heights(row);
      const double* error = errors(row);
      float* kept = &report_.kept[at(0, row)];
      for (int c = 0; c < cols_; ++c)
        kept[c] = static_cast<float>(keep == Keep::kHeights ? double{height[c]} + error[c] : error[c]);
    }
  }
  return std::move(report_);
}

}  // namespace scarp::judge
