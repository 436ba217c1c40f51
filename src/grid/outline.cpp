#include "grid/outline.h"

#include <algorithm>
#include <bit>
#include <cstdint>
#include <cstdlib>
#include <utility>

#include "base/sort.h"

namespace scarp::grid {

namespace {

constexpr Point kCorner[4] = {{0, 0}, {1, 0}, {1, 1}, {0, 1}};  // in positive orientation

struct DirectedEdge {
  Point from, to;
};

bool is_surface_cell(unsigned corners) { return std::popcount(corners) >= 3; }

/// True if side k of a surface cell belongs to the surface: both ends are heights.
bool has_side(unsigned corners, unsigned k) {
  return is_surface_cell(corners) && (corners >> k & 1) && (corners >> (k + 1) % 4 & 1);
}

/// Adds those sides of a surface cell where the surface ends. `beyond`: the corners of the cells at its four sides.
void add_cell(std::int32_t x, std::int32_t y, unsigned corners, const unsigned (&beyond)[4],
              std::vector<DirectedEdge>& edges) {
  const auto at = [&](unsigned k) { return Point{x + kCorner[k % 4].x, y + kCorner[k % 4].y}; };
  for (unsigned k = 0; k < 4; ++k) {
    // The neighbour shares the side's ends, so it has the side exactly if it is surface.
    if (has_side(corners, k) && !is_surface_cell(beyond[k])) edges.push_back({at(k), at(k + 1)});
    if (!(corners >> k & 1)) edges.push_back({at(k + 3), at(k + 1)});  // the diagonal of a half cell
  }
}

void sort_edges(std::vector<DirectedEdge>& edges) {
  sort_rarely(edges, [](const DirectedEdge& a, const DirectedEdge& b) {
    return a.from == b.from ? before(a.to, b.to) : before(a.from, b.from);
  });
}

/// valid_corners() of the cells of row y, with an empty cell before the first and after the last; all empty beyond the
/// raster.
void fill_cell_row(const Raster& raster, std::int32_t y, std::vector<unsigned char>& cells) {
  cells.assign(static_cast<std::size_t>(raster.cols) + 1, 0);
  if (y < 0 || y + 1 >= raster.rows) return;
  for (std::int32_t x = 0; x + 1 < raster.cols; ++x)
    cells[static_cast<std::size_t>(x) + 1] = static_cast<unsigned char>(valid_corners(raster, x, y));
}

std::vector<DirectedEdge> border_edges(const Raster& raster) {
  std::vector<DirectedEdge> edges;
  std::vector<unsigned char> above, here, below;
  fill_cell_row(raster, -1, above);
  fill_cell_row(raster, 0, here);
  for (std::int32_t y = 0; y + 1 < raster.rows; ++y) {
    fill_cell_row(raster, y + 1, below);
    for (std::int32_t x = 0; x + 1 < raster.cols; ++x) {
      const auto i = static_cast<std::size_t>(x) + 1;
      const unsigned corners = here[i];
      if (!is_surface_cell(corners)) continue;
      add_cell(x, y, corners, {above[i], here[i + 1], below[i], here[i - 1]}, edges);
    }
    std::swap(above, here);
    std::swap(here, below);
  }
  sort_edges(edges);
  return edges;
}

/// Four rows of samples as bits per column: the row above the current one, the current one, and two below.
class FourRows {
 public:
  explicit FourRows(std::span<const SampleRun> runs) : runs_(runs), row_(runs.front().row - 3) {
    std::int32_t right = 0;
    left_ = runs.front().begin;
    for (const SampleRun& run : runs) {
      left_ = std::min(left_, run.begin);
      right = std::max(right, run.end);
    }
    left_ -= 2;  // also for the left neighbour of the first cell
    columns_.resize(static_cast<std::size_t>(right + 2 - left_));
  }

  void go_to(std::int32_t row) {
    for (row_ = std::max(row_, row - 4); row_ < row;) {
      ++row_;
      for (unsigned char& column : columns_) column = static_cast<unsigned char>(column >> 1);
      for (; next_ < runs_.size() && runs_[next_].row == row_ + 2; ++next_) {
        for (std::int32_t x = runs_[next_].begin; x < runs_[next_].end; ++x) columns_[index(x)] |= 8;
      }
    }
  }

  /// valid_corners() of the cell `below` rows below the current row, −1 … 1.
  unsigned corners(std::int32_t x, int below) const {
    const std::size_t i = index(x);
    const unsigned left = static_cast<unsigned>(columns_[i]) >> (1 + below),
                   right = static_cast<unsigned>(columns_[i + 1]) >> (1 + below);
    return (left & 1) | (right & 1) << 1 | (right & 2) << 1 | (left & 2) << 2;
  }

  /// True if all cells around a cell are surface.
  bool is_inside(std::int32_t x) const {
    const std::size_t i = index(x);
    return (columns_[i - 1] & columns_[i] & columns_[i + 1] & columns_[i + 2]) == 15;
  }

 private:
  std::size_t index(std::int32_t x) const { return static_cast<std::size_t>(x - left_); }

  std::span<const SampleRun> runs_;
  std::size_t next_ = 0;
  std::int32_t left_ = 0, row_;
  std::vector<unsigned char> columns_;
};

std::vector<DirectedEdge> border_edges(std::span<const SampleRun> runs) {
  std::vector<DirectedEdge> edges;
  if (runs.empty()) return edges;
  FourRows rows(runs);
  for (const auto& [y, begin, end] : runs) {
    rows.go_to(y);
    // A cell with three valid samples has at least one in its upper row.
    for (std::int32_t x = begin - 1; x < end; ++x) {
      if (rows.is_inside(x)) continue;
      const unsigned corners = rows.corners(x, 0);
      if (!is_surface_cell(corners)) continue;
      add_cell(x, y, corners, {rows.corners(x, -1), rows.corners(x + 1, 0), rows.corners(x, 1), rows.corners(x - 1, 0)},
               edges);
    }
  }
  sort_edges(edges);
  return edges;
}

/// A sort key for the turn from `in` to `out`, for angles above −180° up to +180°; larger keys turn farther left.
double left_turn(Point in, Point out) {
  const int cross = in.x * out.y - in.y * out.x, dot = in.x * out.x + in.y * out.y;
  // Unit steps of a lattice: the eight turns have exact, distinct keys without trigonometry.
  const double along = static_cast<double>(dot) / (std::abs(dot) + std::abs(cross));
  return cross >= 0 ? 1 - along : along - 1;
}

Point step(const DirectedEdge& e) { return {e.to.x - e.from.x, e.to.y - e.from.y}; }

/// Joins the edges to closed polygons. REQUIRES: sorted.
Outline join_edges(const std::vector<DirectedEdge>& edges) {
  std::vector<bool> used(edges.size(), false);
  Outline outline;
  for (std::size_t start = 0; start < edges.size(); ++start) {
    if (used[start]) continue;
    std::vector<Point> polygon;
    std::size_t e = start;
    do {
      used[e] = true;
      const auto first = static_cast<std::size_t>(
          std::lower_bound(edges.begin(), edges.end(), edges[e].to,
                           [](const DirectedEdge& edge, Point p) { return before(edge.from, p); }) -
          edges.begin());
      // If polygons touch, the sharpest left turn stays in the same wedge of surface. The start edge remains a
      // candidate although it is used, since it closes the polygon.
      std::size_t next = edges.size(), end = first;
      for (; end < edges.size() && edges[end].from == edges[e].to; ++end) {
        if (used[end] && end != start) continue;
        if (next == edges.size() ||
            left_turn(step(edges[e]), step(edges[end])) > left_turn(step(edges[e]), step(edges[next])))
          next = end;
      }
      const bool touches = end - first > 1;
      if (touches || !(step(edges[e]) == step(edges[next]))) polygon.push_back(edges[e].to);
      e = next;
    } while (e != start);
    outline.push_back(std::move(polygon));
  }
  return outline;
}

}  // namespace

bool is_whole(const Raster& raster) {
  for (std::int32_t y = 0; y < raster.rows; ++y) {
    // No early exit within a row, for vectorisation.
    int nodata = 0;
    for (std::int32_t x = 0; x < raster.cols; ++x) nodata += std::isnan(raster.row(y)[x]) ? 1 : 0;
    if (nodata > 0) return false;
  }
  return true;
}

Outline trace_outline(const Raster& raster) {
  if (raster.cols > 1 && raster.rows > 1 && is_whole(raster))
    return {{{raster.cols - 1, 0}, {raster.cols - 1, raster.rows - 1}, {0, raster.rows - 1}, {0, 0}}};
  return join_edges(border_edges(raster));
}

Outline trace_outline(std::span<const SampleRun> runs) { return join_edges(border_edges(runs)); }

}  // namespace scarp::grid
