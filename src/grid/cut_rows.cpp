#include "grid/cut_rows.h"

#include <algorithm>
#include <bit>
#include <cmath>
#include <utility>

#include "base/sort.h"
#include "grid/mask_samples.h"
#include "grid/outline.h"
#include "grid/vertex_lattice.h"

namespace scarp::grid {

namespace {

/// Floor of a / b. REQUIRES: b > 0.
std::int64_t floor_divide(std::int64_t a, std::int64_t b) { return a / b - (a % b < 0 ? 1 : 0); }

/// Calls visit(run) for the raster's cells that an edge crosses, plus some neighbours.
template <class Visit>
void visit_cells(Point p, Point q, std::int32_t cols, std::int32_t rows, const Visit& visit) {
  if (p.y > q.y) std::swap(p, q);
  const auto cell = [](double steps, std::int32_t cells) {
    return std::clamp(static_cast<std::int32_t>(std::floor(steps / kLatticeSteps)), 0, cells - 1);
  };
  const double height = q.y - p.y, slope = height > 0 ? (q.x - p.x) / height : 0;
  for (std::int32_t row = cell(p.y, rows - 1); row <= cell(q.y, rows - 1); ++row) {
    const double top = std::max<double>(p.y, double{kLatticeSteps} * row),
                 bottom = std::min<double>(q.y, double{kLatticeSteps} * (row + 1.0));
    const double from = height > 0 ? p.x + slope * (top - p.y) : p.x,
                 to = height > 0 ? p.x + slope * (bottom - p.y) : q.x;
    visit(SampleRun{row, cell(std::min(from, to), cols - 1), cell(std::max(from, to), cols - 1) + 1});
  }
}

}  // namespace

CutRows::CutRows(std::span<const std::array<Point, 2>> outline, std::int32_t cols, std::int32_t rows)
    : cols_(cols), rows_(rows), within_({}, rows), on_({}, rows), cells_({}, rows) {
  SampleRuns cells, on, within;
  std::vector<Point> turns;  // the first samples to the right of the outline
  const auto add_point = [&](Point p) {
    const std::int32_t col = p.x / kLatticeSteps;
    if (p.x % kLatticeSteps == 0 && p.y % kLatticeSteps == 0) on.add({p.y / kLatticeSteps, col, col + 1});
  };
  for (auto [p, q] : outline) {
    visit_cells(p, q, cols, rows, [&](const SampleRun& run) { cells.add(run); });
    add_point(p);
    add_point(q);
    if (before(q, p)) std::swap(p, q);
    if (p.y == q.y) {
      const std::int32_t first = (p.x + kLatticeSteps - 1) / kLatticeSteps, end = q.x / kLatticeSteps + 1;
      if (p.y % kLatticeSteps == 0 && first < end) on.add({p.y / kLatticeSteps, first, end});
      continue;
    }
    const std::int64_t dx = q.x - p.x, dy = q.y - p.y, step = kLatticeSteps * dy;
    // The interval is half open, so that a vertex on a row counts once.
    for (std::int32_t row = (p.y + kLatticeSteps - 1) / kLatticeSteps; row * kLatticeSteps < q.y; ++row) {
      const std::int64_t along = p.x * dy + (std::int64_t{row} * kLatticeSteps - p.y) * dx;
      const auto left = static_cast<std::int32_t>(floor_divide(along, step));
      if (left * step == along) on.add({row, left, left + 1});
      if (left + 1 < cols) turns.push_back({left + 1, row});
    }
  }
  sort_rarely(turns, before);
  for (std::size_t i = 0; i < turns.size(); ++i) {
    const Point from = turns[i];
    const bool has_end = i + 1 < turns.size() && turns[i + 1].y == from.y;
    if (has_end) ++i;
    const std::int32_t end = has_end ? turns[i].x : cols;
    if (from.x < end) within.add({from.y, from.x, end});
  }
  for (const auto& [runs, set] : {std::pair(&cells, &cells_), {&on, &on_}, {&within, &within_}}) {
    runs->merge();
    *set = SampleSet(runs->all(), rows);
  }
}

CutSide CutRows::side(Point sample) const {
  return on_.has(sample) ? CutSide::kOnWall : within_.has(sample) ? CutSide::kWithin : CutSide::kBeyond;
}

/// Adds the cells with a sample of this row on or within the cut.
void CutRows::add_held(std::int32_t row, SampleRuns& cells) const {
  for (const SampleSet* samples : {&within_, &on_}) {
    for (const auto& [y, begin, end] : samples->row(row)) {
      const SampleRun run{0, std::max(begin - 1, 0), std::min(end, cols_ - 1)};
      if (run.begin < run.end) cells.add(run);
    }
  }
}

/// The cells of a row that contain or touch the cut surface. The returned runs have row number 0.
SampleRuns CutRows::near_cells(std::int32_t row) const {
  SampleRuns cells;
  for (const auto& [y, begin, end] : cells_.row(row)) cells.add({0, begin, end});
  add_held(row, cells);
  add_held(row + 1, cells);
  cells.merge();
  return cells;
}

void CutRows::mask_beyond(std::int32_t col, std::int32_t row, std::int32_t cols, std::int32_t rows, float* samples,
                          std::ptrdiff_t stride) const {
  std::array<SampleRuns, 4> near;  // runs of cells of rows row − 2 to row + 1, at index mod 4
  const auto place_of = [&](std::int32_t cell_row) -> SampleRuns& {
    return near[static_cast<std::size_t>(cell_row) % 4];
  };
  const auto has_cells = [&](std::int32_t cell_row) { return cell_row >= 0 && cell_row + 1 < rows_; };
  for (std::int32_t k = row - 2; k <= row; ++k) {
    if (has_cells(k)) place_of(k) = near_cells(k);
  }
  for (std::int32_t y = row; y < row + rows; ++y) {
    if (has_cells(y + 1)) place_of(y + 1) = near_cells(y + 1);
    SampleRuns kept;
    for (std::int32_t k = y - 2; k <= y + 1; ++k) {
      if (!has_cells(k)) continue;
      // Cell i has the samples i and i + 1; each adjacent cell adds one.
      for (const auto& [none, begin, end] : place_of(k).all()) kept.add({0, begin - 1, end + 2});
    }
    kept.merge();
    mask_beside(kept.all(), col, col + cols, samples + (y - row) * stride);
  }
}

bool CutRows::has_surface(const Raster& raster) const {
  for (std::int32_t row = 0; row + 1 < rows_; ++row) {
    const SampleRuns near = near_cells(row);
    for (const auto& [none, begin, end] : near.all()) {
      for (std::int32_t col = begin; col < end; ++col) {
        if (std::popcount(valid_corners(raster, col, row)) >= 3) return true;
      }
    }
  }
  return false;
}

}  // namespace scarp::grid
