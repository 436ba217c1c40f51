#include "lines/line_samples.h"

#include <algorithm>
#include <bit>
#include <utility>

#include "grid/outline.h"
#include "grid/vertex_lattice.h"
#include "grid/window.h"

namespace scarp::lines {

namespace {

/// Wider gaps between lines are not read.
constexpr std::int32_t kWideGap = 4096;

/// Valid corners of a cell, as in valid_corners().
unsigned corners_near(const LineSamples& samples, std::int32_t col, std::int32_t row) {
  const auto bit = [&](std::int32_t i, std::int32_t j, unsigned k) { return samples.is_valid({i, j}) ? 1u << k : 0u; };
  return bit(col, row, 0) | bit(col + 1, row, 1) | bit(col + 1, row + 1, 2) | bit(col, row + 1, 3);
}

/// True if the surface of a cell includes the side between two of its corners.
bool reaches(unsigned corners, unsigned a, unsigned b) {
  return std::popcount(corners) >= 3 && (corners >> a & 1u) != 0 && (corners >> b & 1u) != 0;
}

geom::Segment in_steps(Point from, Point to) {
  return {{from.x * grid::kLatticeSteps, from.y * grid::kLatticeSteps},
          {to.x * grid::kLatticeSteps, to.y * grid::kLatticeSteps}};
}

}  // namespace

Result<LineSamples> LineSamples::read(const HeightField& field, std::span<const geom::Segment> near) {
  LineSamples samples(field.cols, field.rows);
  for (const geom::Segment& segment : near) samples.mark(segment);
  samples.merge_marks();
  samples.begins_.assign(static_cast<std::size_t>(field.rows) + 1, 0);
  for (const Run& run : samples.runs_) ++samples.begins_[static_cast<std::size_t>(run.row) + 1];
  for (std::size_t row = 1; row < samples.begins_.size(); ++row) samples.begins_[row] += samples.begins_[row - 1];
  // Sources read whole rows fast, so only wide gaps are omitted.
  std::vector<float> row(static_cast<std::size_t>(field.cols));
  for (std::size_t i = 0; i < samples.runs_.size();) {
    const std::int32_t at = samples.runs_[i].row, first = samples.runs_[i].col;
    std::size_t end = i + 1;
    while (end < samples.runs_.size() && samples.runs_[end].row == at &&
           samples.runs_[end].col - samples.runs_[end - 1].end < kWideGap)
      ++end;
    const std::int32_t count = samples.runs_[end - 1].end - first;
    SCARP_RETURN_IF_ERROR(grid::read_window(field, first, at, count, 1, row.data(), count));
    for (; i < end; ++i) {
      const Run& run = samples.runs_[i];
      std::copy(row.begin() + (run.col - first), row.begin() + (run.end - first),
                samples.heights_.begin() + static_cast<std::ptrdiff_t>(run.first));
    }
  }
  return samples;
}

void LineSamples::mark(const geom::Segment& segment) {
  auto [p, q] = segment;
  if (p.y > q.y) std::swap(p, q);
  constexpr double kSteps = grid::kLatticeSteps;
  const auto row_of = [](double y) { return static_cast<std::int32_t>(std::floor(y / kSteps)); };
  const double height = static_cast<double>(q.y) - p.y,
               slope = height > 0 ? (static_cast<double>(q.x) - p.x) / height : 0;
  // Row by row of cells, including one above and one below that share a row of samples.
  for (std::int32_t row = std::max(row_of(p.y), -1); row <= std::min(row_of(q.y), rows()); ++row) {
    const double top = std::max<double>(p.y, kSteps * row), bottom = std::min<double>(q.y, kSteps * (row + 1.0));
    const double from = height > 0 ? p.x + slope * (top - p.y) : p.x,
                 to = height > 0 ? p.x + slope * (bottom - p.y) : q.x;
    const auto first = static_cast<std::int32_t>(std::floor(std::min(from, to) / kSteps)) - 1,
               last = static_cast<std::int32_t>(std::floor(std::max(from, to) / kSteps)) + 2;
    if (last < 0 || first >= cols()) continue;
    for (std::int32_t k = std::max(row - 1, 0); k <= std::min(row + 2, rows() - 1); ++k)
      runs_.push_back({k, std::max(first, 0), std::min(last, cols() - 1) + 1, 0});
  }
  // Millions of short adjacent segments repeat the same marks.
  if (runs_.size() > heights_.size() / 2 + (1u << 16)) merge_marks();
}

void LineSamples::merge_marks() {
  std::sort(runs_.begin(), runs_.end(),
            [](const Run& a, const Run& b) { return std::pair(a.row, a.col) < std::pair(b.row, b.col); });
  std::size_t kept = 0, count = 0;
  for (const Run& run : runs_) {
    if (kept > 0 && runs_[kept - 1].row == run.row && run.col <= runs_[kept - 1].end) {
      runs_[kept - 1].end = std::max(runs_[kept - 1].end, run.end);
    } else {
      runs_[kept++] = run;
    }
  }
  runs_.resize(kept);
  for (Run& run : runs_) {
    run.first = count;
    count += static_cast<std::size_t>(run.end - run.col);
  }
  heights_.resize(count);
}

std::size_t LineSamples::find(Point p) const {
  const auto row = static_cast<std::size_t>(p.y);
  const auto first = runs_.begin() + static_cast<std::ptrdiff_t>(begins_[row]),
             last = runs_.begin() + static_cast<std::ptrdiff_t>(begins_[row + 1]);
  auto run = std::upper_bound(first, last, p.x, [](std::int32_t x, const Run& of) { return x < of.col; });
  if (run == first) return kNowhere;
  --run;
  if (p.x >= run->end) return kNowhere;
  return run->first + static_cast<std::size_t>(p.x - run->col);
}

float LineSamples::change(Point p, float height) {
  const float before = at(p);
  if (!std::isnan(before)) heights_[find(p)] = height;
  return before;
}

bool LineSamples::has_cell(std::int32_t col, std::int32_t row) const {
  if (col < 0 || row < 0 || col + 1 >= cols() || row + 1 >= rows()) return false;
  return find({col, row}) != kNowhere && find({col + 1, row}) != kNowhere && find({col, row + 1}) != kNowhere &&
         find({col + 1, row + 1}) != kNowhere;
}

std::vector<geom::Segment> LineSamples::outline_near() const {
  std::vector<geom::Segment> outline;
  for (const Run& run : runs_) {
    const std::int32_t row = run.row;
    for (std::int32_t col = run.col; col < run.end; ++col) {
      if (!has_cell(col, row)) continue;
      const unsigned here = corners_near(*this, col, row);
      if (has_cell(col - 1, row) && reaches(here, 0, 3) != reaches(corners_near(*this, col - 1, row), 1, 2))
        outline.push_back(in_steps({col, row}, {col, row + 1}));
      if (has_cell(col, row - 1) && reaches(here, 0, 1) != reaches(corners_near(*this, col, row - 1), 3, 2))
        outline.push_back(in_steps({col, row}, {col + 1, row}));
      if (std::popcount(here) != 3) continue;
      // The diagonal opposite to the missing corner.
      if ((here & 5u) == 5u)
        outline.push_back(in_steps({col, row}, {col + 1, row + 1}));
      else
        outline.push_back(in_steps({col + 1, row}, {col, row + 1}));
    }
  }
  return outline;
}

}  // namespace scarp::lines
