// Combines several sources in the order of their priority.
#include <algorithm>
#include <cmath>
#include <cstddef>
#include <limits>
#include <utility>
#include <vector>

#include "scarp/tile.h"

namespace scarp {
namespace {

/// Degrees by which a source's rounding may extend its cover.
constexpr double kBeyond = 1e-9;

/// Columns or rows of a window: first and one past the last.
struct Range {
  int first = 0, end = 0;

  void add(int k) {
    first = end == 0 ? k : std::min(first, k);
    end = std::max(end, k + 1);
  }
  void add(std::int64_t from, int count) {
    add(static_cast<int>(from));
    add(static_cast<int>(from) + count - 1);
  }
  bool is_empty() const { return end == 0; }
};

NodeWindow within(NodeWindow window, const Range& cols, const Range& rows) {
  window.col += cols.first;
  window.cols = cols.end - cols.first;
  window.row += rows.first;
  window.rows = rows.end - rows.first;
  return window;
}

bool is_between(double low, double value, double high) { return value >= low - kBeyond && value <= high + kBeyond; }

class StackedNodes final : public NodeSource {
 public:
  explicit StackedNodes(std::vector<StackedSource> sources) : sources_(std::move(sources)) {}

  bool has_samples() const override { return sources_.size() == 1 && sources_.front().nodes->has_samples(); }

  Result<void> visit_samples(const DegreeBox& box, const SampleVisitor& visit) const override {
    return has_samples() ? sources_.front().nodes->visit_samples(box, visit) : Result<void>();
  }

  NodeWindow land(const NodeWindow& window) const override {
    Range cols, rows;
    for (const StackedSource& source : sources_) {
      NodeWindow part = window;
      if (!narrow(source.covered, {}, part)) continue;
      cols.add(part.col - window.col, part.cols);
      rows.add(part.row - window.row, part.rows);
    }
    return within(window, cols, rows);
  }

  Result<void> read(const NodeWindow& window, std::span<float> out) const override {
    std::fill(out.begin(), out.end(), std::numeric_limits<float>::quiet_NaN());
    std::vector<float> nodes;
    for (const StackedSource& source : sources_) {
      NodeWindow part = window;
      if (!narrow(source.covered, out, part)) continue;
      nodes.resize(static_cast<std::size_t>(part.cols) * static_cast<std::size_t>(part.rows));
      SCARP_RETURN_IF_ERROR(source.nodes->read(part, nodes));
      for (int j = 0; j < part.rows; ++j) {
        float* row = out.data() + (part.row - window.row + j) * window.cols + (part.col - window.col);
        const float* from = nodes.data() + std::ptrdiff_t{j} * part.cols;
        for (int i = 0; i < part.cols; ++i) {
          if (std::isnan(row[i])) row[i] = from[i];
        }
      }
    }
    return {};
  }

 private:
  /// Narrows the window to the part where the source may have heights missing in `heights`, which is empty or has all
  /// nodes of the window. False if there is none.
  static bool narrow(const DegreeBox& covered, std::span<const float> heights, NodeWindow& window) {
    if (window.latitude(window.row) < covered.south - kBeyond ||
        window.latitude(window.row + window.rows - 1) > covered.north + kBeyond)
      return false;
    std::vector<char> is_across(static_cast<std::size_t>(window.cols));
    bool any = false;
    for (int i = 0; i < window.cols; ++i) {
      const double longitude = window.longitude(window.col + i);
      for (const double turn : window.grid.turns())
        is_across[static_cast<std::size_t>(i)] |= is_between(covered.west, longitude + turn, covered.east);
      any |= is_across[static_cast<std::size_t>(i)] != 0;
    }
    Range cols, rows;
    for (int j = 0; j < window.rows; ++j) {
      // A pole is one place at all longitudes.
      const bool is_pole = window.is_pole(window.row + j);
      if (!any && !is_pole) continue;
      if (!is_between(covered.south, window.latitude(window.row + j), covered.north)) continue;
      const float* row = heights.empty() ? nullptr : heights.data() + std::ptrdiff_t{j} * window.cols;
      Range missing;
      for (int i = 0; i < window.cols; ++i) {
        if (is_pole || is_across[static_cast<std::size_t>(i)] != 0) {
          if (row == nullptr || std::isnan(row[i])) missing.add(i);
        }
      }
      if (missing.is_empty()) continue;
      rows.add(j);
      cols.add(missing.first);
      cols.add(missing.end - 1);
    }
    if (rows.is_empty()) return false;
    window = within(window, cols, rows);
    return true;
  }

  std::vector<StackedSource> sources_;
};

}  // namespace

std::unique_ptr<NodeSource> make_stacked_source(std::vector<StackedSource> sources) {
  return std::make_unique<StackedNodes>(std::move(sources));
}

}  // namespace scarp
