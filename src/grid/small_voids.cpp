// Fills small voids, also in rasters that are read window by window.
//
// Problem: a void must have the same heights in every window that cuts it, without reading the whole raster.
//
// Idea: voids are 8-connected. So the search of fill_nodata() in each of eight directions ends at a height next to the
// sample's own void, and the result depends only on the heights around the void. If a void of at most s × s samples
// reaches into a window, it lies within s samples of the window, and the heights around it within s + 1.
//
// Runs of missing samples are joined row by row (Rosenfeld & Pfaltz 1966).
#include "grid/small_voids.h"

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <limits>
#include <utility>

#include "grid/window.h"

namespace scarp::grid {
namespace {

/// An 8-connected area of missing samples.
struct SmallVoid {
  int left, top, right, bottom;  ///< all inclusive
  std::uint64_t samples = 0;
  bool is_open = false;  ///< touches the border of the scanned part
  float least = std::numeric_limits<float>::infinity(), most = -std::numeric_limits<float>::infinity();  ///< range of
                                                                                                         ///< the
                                                                                                         ///< adjacent
                                                                                                         ///< heights

  bool is_small(int side) const { return !is_open && right - left < side && bottom - top < side; }
};

struct VoidRun {
  int row, begin, end;
  std::size_t area;
};

class VoidFinder {
 public:
  /// `keep`: store the runs of all rows, not only of the last row.
  VoidFinder(int cols, bool keep) : cols_(cols), keep_(keep) {}

  void add(std::span<const float> row) {
    std::vector<VoidRun> runs;
    std::size_t above = first_above_;
    for (int begin = 0; begin < cols_; ++begin) {
      if (std::isfinite(row[static_cast<std::size_t>(begin)])) continue;
      int end = begin + 1;
      while (end < cols_ && !std::isfinite(row[static_cast<std::size_t>(end)])) ++end;
      VoidRun run{row_, begin, end, parents_.size()};
      parents_.push_back(run.area);
      voids_.push_back({begin, row_, end - 1, row_, static_cast<std::uint64_t>(end - begin),
                        row_ == 0 || begin == 0 || end == cols_});
      while (above < runs_.size() && runs_[above].end < begin) ++above;
      for (std::size_t k = above; k < runs_.size() && runs_[k].begin <= end; ++k) join(run.area, runs_[k].area);
      see(run.area, row, begin, end);
      see(run.area, last_, begin, end);
      runs.push_back(run);
      begin = end;
    }
    for (std::size_t k = first_above_; k < runs_.size(); ++k) see(runs_[k].area, row, runs_[k].begin, runs_[k].end);
    if (!keep_) runs_.clear();
    first_above_ = runs_.size();
    runs_.insert(runs_.end(), runs.begin(), runs.end());
    last_.assign(row.begin(), row.end());
    ++row_;
  }
  /// Must be called after the last row.
  void finish() {
    for (std::size_t k = first_above_; k < runs_.size(); ++k) voids_[root(runs_[k].area)].is_open = true;
  }

  std::size_t root(std::size_t area) {
    while (parents_[area] != area) area = parents_[area] = parents_[parents_[area]];
    return area;
  }
  const std::vector<VoidRun>& runs() const { return runs_; }
  const SmallVoid& area(std::size_t of_run) { return voids_[root(of_run)]; }

  VoidCount count(int side) {
    VoidCount count{.filled = 0, .left = 0, .least = -HUGE_VAL, .most = HUGE_VAL};
    for (std::size_t k = 0; k < voids_.size(); ++k) {
      if (root(k) != k) continue;
      const SmallVoid& one = voids_[k];
      (one.is_small(side) ? count.filled : count.left) += one.samples;
      if (one.is_small(side) || one.least > one.most) continue;
      count.least = std::max(count.least, double{one.least});
      count.most = std::min(count.most, double{one.most});
    }
    if (count.left == 0 || count.least == -HUGE_VAL) count.least = count.most = 0;
    return count;
  }

 private:
  void join(std::size_t one, std::size_t other) {
    const std::size_t a = std::min(root(one), root(other)), b = std::max(root(one), root(other));
    if (a == b) return;
    parents_[b] = a;
    SmallVoid &to = voids_[a], &from = voids_[b];
    to = {std::min(to.left, from.left),     std::min(to.top, from.top),  std::max(to.right, from.right),
          std::max(to.bottom, from.bottom), to.samples + from.samples,   to.is_open || from.is_open,
          std::min(to.least, from.least),   std::max(to.most, from.most)};
  }
  /// Adds to a run's void the heights of `row` above, below or next to the run.
  void see(std::size_t area, std::span<const float> row, int begin, int end) {
    if (row.empty()) return;
    SmallVoid& one = voids_[root(area)];
    for (int col = std::max(begin - 1, 0); col < std::min(end + 1, cols_); ++col) {
      const float height = row[static_cast<std::size_t>(col)];
      if (!std::isfinite(height)) continue;
      one.least = std::min(one.least, height);
      one.most = std::max(one.most, height);
    }
  }

  int cols_, row_ = 0;
  bool keep_;
  std::vector<std::size_t> parents_;
  std::vector<SmallVoid> voids_;
  std::vector<VoidRun> runs_;
  std::size_t first_above_ = 0;
  std::vector<float> last_;
};

VoidFinder find_voids(const float* samples, int cols, int rows, std::ptrdiff_t stride) {
  VoidFinder finder(cols, true);
  for (int row = 0; row < rows; ++row) finder.add({samples + row * stride, static_cast<std::size_t>(cols)});
  finder.finish();
  return finder;
}

/// Samples of some columns and rows; row-major, `stride` apart.
struct Samples2d {
  float* data;
  int cols, rows;
  std::ptrdiff_t stride;

  float* row(int at) const { return data + at * stride; }
};

/// Fills one void from the heights around it. `runs`: the void's runs.
void fill(const Samples2d& samples, const SmallVoid& one, const std::vector<VoidRun>& runs, int side) {
  OwnedHeightField box;
  box.cols = one.right - one.left + 3;
  box.rows = one.bottom - one.top + 3;
  for (int row = one.top - 1; row <= one.bottom + 1; ++row) {
    const float* const from = samples.row(row) + one.left - 1;
    box.samples.insert(box.samples.end(), from, from + box.cols);
  }
  fill_nodata(box, side);
  for (const VoidRun& run : runs) {
    const std::ptrdiff_t at = std::ptrdiff_t{run.row - one.top + 1} * box.cols + run.begin - one.left + 1;
    std::copy_n(box.samples.data() + at, run.end - run.begin, samples.row(run.row) + run.begin);
  }
}

void fill_all(const Samples2d& samples, VoidFinder& finder, int side) {
  std::vector<std::pair<std::size_t, VoidRun>> runs;
  for (const VoidRun& run : finder.runs()) {
    if (finder.area(run.area).is_small(side)) runs.emplace_back(finder.root(run.area), run);
  }
  std::stable_sort(runs.begin(), runs.end(), [](const auto& a, const auto& b) { return a.first < b.first; });
  std::vector<VoidRun> of_one;
  for (std::size_t k = 0; k < runs.size(); ++k) {
    of_one.push_back(runs[k].second);
    if (k + 1 < runs.size() && runs[k + 1].first == runs[k].first) continue;
    fill(samples, finder.area(runs[k].first), of_one, side);
    of_one.clear();
  }
}

class FilledSource final : public SampleSource {
 public:
  FilledSource(const HeightField& field, int side, std::shared_ptr<const SampleSource> owner)
      : field_(field), owner_(std::move(owner)), cols_(field.cols), rows_(field.rows), side_(side) {}

  Result<void> read(int col, int row, int cols, int rows, float* out, std::ptrdiff_t stride) const override {
    SCARP_RETURN_IF_ERROR(read_window(field_, col, row, cols, rows, out, stride));
    const Samples2d window{out, cols, rows, stride};
    VoidFinder finder = find_voids(out, cols, rows, stride);
    if (finder.runs().empty()) return {};
    if (!reaches_beyond(finder, col, row, cols, rows)) {
      fill_all(window, finder, side_);
      return {};
    }
    const int margin = side_ + 1, left = std::max(col - margin, 0), top = std::max(row - margin, 0);
    const auto end = [&](int first, int count, int all) {
      return static_cast<int>(std::min<std::int64_t>(std::int64_t{first} + count + margin, all));
    };
    const int width = end(col, cols, cols_) - left, height = end(row, rows, rows_) - top;
    std::vector<float> samples(static_cast<std::size_t>(width) * static_cast<std::size_t>(height));
    SCARP_RETURN_IF_ERROR(read_window(field_, left, top, width, height, samples.data(), width));
    const Samples2d wide{samples.data(), width, height, width};
    VoidFinder all = find_voids(samples.data(), width, height, width);
    fill_all(wide, all, side_);
    for (int k = 0; k < rows; ++k) std::copy_n(wide.row(row - top + k) + (col - left), cols, window.row(k));
    return {};
  }
  bool is_in_memory() const override { return field_.source == nullptr || field_.source->is_in_memory(); }

 private:
  /// True if a small void may continue across a window border that lies inside the raster.
  bool reaches_beyond(VoidFinder& finder, int col, int row, int cols, int rows) const {
    for (const VoidRun& run : finder.runs()) {
      const SmallVoid& one = finder.area(run.area);
      const bool is_long = one.right - one.left >= side_ || one.bottom - one.top >= side_;
      const bool goes_on = (one.left == 0 && col > 0) || (one.top == 0 && row > 0) ||
                           (one.right == cols - 1 && col + cols < cols_) ||
                           (one.bottom == rows - 1 && row + rows < rows_);
      if (goes_on && !is_long) return true;
    }
    return false;
  }

  HeightField field_;
  std::shared_ptr<const SampleSource> owner_;
  int cols_, rows_, side_;
};

}  // namespace

VoidCount fill_small_voids(OwnedHeightField& field, int side) {
  VoidFinder finder = find_voids(field.view().samples, field.cols, field.rows, field.cols);
  if (finder.runs().empty()) return {};
  field.own();
  fill_all({field.samples.data(), field.cols, field.rows, field.cols}, finder, side);
  return finder.count(side);
}

std::shared_ptr<const SampleSource> without_small_voids(const HeightField& field, int side,
                                                        std::shared_ptr<const SampleSource> owner) {
  return std::make_shared<FilledSource>(field, side, std::move(owner));
}

Result<VoidCount> count_voids(const HeightField& field, int side) {
  constexpr std::int64_t kTogether = 1 << 20;
  const int cols = field.cols, rows = field.rows;
  const int together = static_cast<int>(std::clamp<std::int64_t>(kTogether / cols, 1, rows));
  std::vector<float> samples(static_cast<std::size_t>(cols) * static_cast<std::size_t>(together));
  VoidFinder finder(cols, false);
  for (int row = 0; row < rows; row += together) {
    const int count = std::min(together, rows - row);
    SCARP_RETURN_IF_ERROR(read_window(field, 0, row, cols, count, samples.data(), cols));
    for (int k = 0; k < count; ++k)
      finder.add({samples.data() + std::ptrdiff_t{k} * cols, static_cast<std::size_t>(cols)});
  }
  finder.finish();
  return finder.count(side);
}

}  // namespace scarp::grid
