#include "pieces/shared_rows.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <utility>
#include <vector>

#include "base/sort.h"
#include "geom/exact_error.h"
#include "grid/vertex_lattice.h"
#include "pieces/border_chain.h"
#include "pieces/tiling.h"

namespace scarp::pieces {

namespace {

/// Samples that are vertices, strictly within a row, ascending.
std::vector<std::int32_t> vertices_along(const Piece& strip, std::int32_t y) {
  std::vector<std::int32_t> cols;
  for (tin::Vertex v = 0; v < strip.tin.vertex_count(); ++v) {
    const Point p = strip.tin.point(v);
    if (p.y == y && p.x > 0 && p.x < strip.samples.cols - 1) cols.push_back(p.x);
  }
  std::sort(cols.begin(), cols.end());
  return cols;
}

/// The aims of one row of a piece's samples.
template <class Float>
std::span<Float> along(std::span<Float> aims, const Piece& strip, std::int32_t y) {
  const auto cols = static_cast<std::size_t>(strip.samples.cols);
  return aims.subspan(static_cast<std::size_t>(y) * cols, cols);
}

LineBound bound_along(const Piece& strip, std::int32_t y, double threshold) {
  return strip.aims.empty() ? LineBound(threshold) : LineBound(along(strip.aims, strip, y));
}

/// A vertex on a shared row, in kLatticeSteps along it.
struct BorderVertex {
  std::int32_t x = 0;
  float height = 0;
  bool is_of_line = false;
};

/// A vertex of a line replaces a mesh vertex at the same point.
void sort_along(std::vector<BorderVertex>& vertices) {
  sort_rarely(vertices, [](const BorderVertex& a, const BorderVertex& b) {
    return std::pair(a.x, !a.is_of_line) < std::pair(b.x, !b.is_of_line);
  });
  vertices.erase(std::unique(vertices.begin(), vertices.end(), [](const auto& a, const auto& b) { return a.x == b.x; }),
                 vertices.end());
}

/// Vertices of lines on a row of the part.
std::vector<BorderVertex> line_vertices(const lines::ConstraintGraph& part, std::int32_t y, const float* samples) {
  std::vector<BorderVertex> vertices;
  for (std::size_t i = 0; i < part.points.size(); ++i) {
    const Point p = part.points[i];
    if (p.y != y * grid::kLatticeSteps) continue;
    const bool is_sample = metric::LatticeHeights::is_sample(p);
    vertices.push_back({p.x, is_sample ? samples[p.x / grid::kLatticeSteps] : part.heights[i], true});
  }
  return vertices;
}

/// Turns samples of a row into vertices of both strips that share it.
void share_samples(std::span<const std::int32_t> cols, std::int32_t y, const float* samples,
                   lines::ConstraintGraph& part) {
  for (const std::int32_t col : cols) {
    part.points.push_back({col * grid::kLatticeSteps, y * grid::kLatticeSteps});
    part.heights.push_back(samples[col]);
    part.is_shared.push_back(1);
  }
}

/// Appends the samples that a chord between two vertices needs: the farthest sample splits it recursively.
void split_border_chord(const float* samples, const BorderVertex& from, const BorderVertex& to, const LineBound& bound,
                        std::vector<std::int32_t>& kept) {
  std::vector<std::pair<BorderVertex, BorderVertex>> chords{{from, to}};
  while (!chords.empty()) {
    const auto [a, b] = chords.back();
    chords.pop_back();
    if (std::isnan(a.height) || std::isnan(b.height)) continue;
    const double rise = double{b.height} - a.height, steps = b.x - a.x;
    const double guard_of_chord = 0x1p-50 * (std::abs(double{a.height}) + std::abs(rise));
    double worst = -1;
    std::int32_t split = -1;
    for (std::int32_t col = a.x / grid::kLatticeSteps + 1; col * grid::kLatticeSteps < b.x; ++col) {
      const float height = samples[col];
      if (std::isnan(height)) continue;
      const double error = std::abs(a.height + rise * ((col * grid::kLatticeSteps - a.x) / steps) - double{height});
      const double threshold = bound.at(col), rank = bound.rank(error, threshold);
      const double guard = guard_of_chord + 0x1p-50 * threshold;
      if (!(rank > worst) || error < threshold - guard || std::isinf(threshold)) continue;
      if (error <= threshold + guard &&
          !geom::exceeds_exactly_between(a.height, b.height, col * grid::kLatticeSteps - a.x, b.x - a.x, height,
                                         threshold))
        continue;
      worst = rank;
      split = col;
    }
    if (split < 0) continue;
    kept.push_back(split);
    const BorderVertex middle{split * grid::kLatticeSteps, samples[split], false};
    chords.push_back({middle, b});
    chords.push_back({a, middle});
  }
}

}  // namespace

void split_shared_row(const Piece& strip, bool is_top, double threshold, lines::ConstraintGraph& part) {
  const std::int32_t y = is_top ? 0 : strip.samples.rows - 1;
  const float* samples = strip.samples.row(y);
  std::vector<BorderVertex> vertices = line_vertices(part, y, samples);
  if (vertices.empty() && strip.aims.empty()) return;
  for (tin::Vertex v = 0; v < strip.tin.vertex_count(); ++v) {
    const Point p = strip.tin.point(v);
    if (p.y == y) vertices.push_back({p.x * grid::kLatticeSteps, samples[p.x], false});
  }
  sort_along(vertices);
  std::vector<std::int32_t> kept;
  for (std::size_t i = 0; i + 1 < vertices.size(); ++i) {
    if (!strip.aims.empty() || vertices[i].is_of_line || vertices[i + 1].is_of_line)
      split_border_chord(samples, vertices[i], vertices[i + 1], bound_along(strip, y, threshold), kept);
  }
  share_samples(kept, y, samples, part);
}

Result<void> start_shared_row(const Piece& strip, bool is_top, double threshold, std::int32_t side,
                              lines::ConstraintGraph& part) {
  const std::int32_t y = is_top ? 0 : strip.samples.rows - 1, around = y + (strip.has_above ? 1 : 0);
  const float* samples = strip.samples.row(y);
  const HeightField field{strip.around.samples, strip.around.cols, strip.around.rows};
  std::vector<BorderVertex> vertices = line_vertices(part, y, samples);
  std::vector<std::int32_t> kept;
  if (vertices.empty()) {
    // The adjacent strip may consist of tiles.
    const Tiling tiling(field.cols, field.rows, side);
    for (std::size_t tile = 0; tile < tiling.per_row(); ++tile) {
      const refine::TileWindow window = tiling.window(tile);
      SCARP_TRY(const auto& chain, simplify_border(field, {window.col, around, window.cols - 1, false}, threshold));
      if (tile > 0) kept.push_back(window.col);
      for (const std::int32_t step : chain) kept.push_back(window.col + step);
    }
    if (!strip.aims.empty()) {
      vertices = {{0, samples[0], false}, {(field.cols - 1) * grid::kLatticeSteps, samples[field.cols - 1], false}};
      for (const std::int32_t col : kept) vertices.push_back({col * grid::kLatticeSteps, samples[col], false});
      sort_along(vertices);
      for (std::size_t i = 0; i + 1 < vertices.size(); ++i)
        split_border_chord(samples, vertices[i], vertices[i + 1], bound_along(strip, y, threshold), kept);
    }
    share_samples(kept, y, samples, part);
    return {};
  }
  SCARP_TRY(const auto& runs, find_border_runs(field, {0, around, field.cols - 1, false}));
  for (const BorderRun& run : runs) {
    vertices.push_back({run.begin * grid::kLatticeSteps, samples[run.begin], false});
    if (run.begin > 0) kept.push_back(run.begin);
  }
  vertices.push_back({runs.back().end * grid::kLatticeSteps, samples[runs.back().end], false});
  sort_along(vertices);
  auto run = runs.begin();
  for (std::size_t i = 0; i + 1 < vertices.size(); ++i) {
    while (run->end * grid::kLatticeSteps <= vertices[i].x) ++run;
    if (run->has_surface)
      split_border_chord(samples, vertices[i], vertices[i + 1], bound_along(strip, y, threshold), kept);
  }
  // Each point of the part occurs once.
  std::erase_if(kept, [&](std::int32_t col) {
    const auto at = std::lower_bound(vertices.begin(), vertices.end(), col * grid::kLatticeSteps,
                                     [](const BorderVertex& v, std::int32_t x) { return v.x < x; });
    return at != vertices.end() && at->x == col * grid::kLatticeSteps && at->is_of_line;
  });
  share_samples(kept, y, samples, part);
  return {};
}

Result<void> insert_shared_row(Piece& strip, bool is_top, bool is_whole) {
  const std::int32_t y = is_top ? 0 : strip.samples.rows - 1, around = y + (strip.has_above ? 1 : 0);
  const HeightField field{strip.around.samples, strip.around.cols, strip.around.rows};
  const BorderLine line{0, around, field.cols - 1, false};
  const LineBound bound(along(strip.aims, strip, y));
  SCARP_TRY(const auto& more, is_whole ? simplify_border(field, line, bound)
                                       : split_border(field, line, vertices_along(strip, y), bound));
  for (const std::int32_t col : more) {
    const Point p{col, y};
    strip.tin.insert(p, strip.tin.locate(p, strip.tin.last_touched()));
  }
  return {};
}

void settle_shared_rows(const Piece& strip, std::span<float> aims) {
  for (const bool is_top : {true, false}) {
    if (aims.empty() || !(is_top ? strip.has_above : strip.has_below)) continue;
    const std::span<float> shared = along(aims, strip, is_top ? 0 : strip.samples.rows - 1);
    std::fill(shared.begin(), shared.end(), std::numeric_limits<float>::infinity());
  }
}

}  // namespace scarp::pieces
