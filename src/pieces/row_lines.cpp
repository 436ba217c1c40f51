#include "pieces/row_lines.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <numeric>
#include <utility>

#include "geom/exact_error.h"
#include "grid/vertex_places.h"
#include "metric/lattice_judge.h"
#include "pieces/row_refinement.h"
#include "pieces/tile_plan.h"
#include "refine/refinement.h"

namespace scarp {

namespace {

/// A vertex on a shared row, in kLatticeSteps along it.
struct BorderVertex {
  std::int32_t x = 0;
  float height = 0;
  bool is_of_line = false;
};

/// A vertex of a line before that of the mesh at the same place, which goes.
void sort_along(std::vector<BorderVertex>& vertices) {
  std::sort(vertices.begin(), vertices.end(), [](const BorderVertex& a, const BorderVertex& b) {
    return std::pair(a.x, !a.is_of_line) < std::pair(b.x, !b.is_of_line);
  });
  vertices.erase(std::unique(vertices.begin(), vertices.end(), [](const auto& a, const auto& b) { return a.x == b.x; }),
                 vertices.end());
}

/// Those that lines have on a row of the part.
std::vector<BorderVertex> line_vertices(const ConstraintGraph& part, std::int32_t y, const float* samples) {
  std::vector<BorderVertex> vertices;
  for (std::size_t i = 0; i < part.points.size(); ++i) {
    const Point p = part.points[i];
    if (p.y != y * kLatticeSteps) continue;
    const bool is_sample = PlaceHeights::is_sample(p);
    vertices.push_back({p.x, is_sample ? samples[p.x / kLatticeSteps] : part.heights[i], true});
  }
  return vertices;
}

/// Samples of a row become vertices for both rows that share it.
void share_samples(std::span<const std::int32_t> cols, std::int32_t y, const float* samples, ConstraintGraph& part) {
  for (const std::int32_t col : cols) {
    part.points.push_back({col * kLatticeSteps, y * kLatticeSteps});
    part.heights.push_back(samples[col]);
    part.is_shared.push_back(1);
  }
}

/// Appends the samples that a chord needs between two vertices: the farthest splits it, again and again.
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
    for (std::int32_t col = a.x / kLatticeSteps + 1; col * kLatticeSteps < b.x; ++col) {
      const float height = samples[col];
      if (std::isnan(height)) continue;
      const double error = std::abs(a.height + rise * ((col * kLatticeSteps - a.x) / steps) - double{height});
      const double threshold = bound.at(col), rank = bound.rank(error, threshold);
      const double guard = guard_of_chord + 0x1p-50 * threshold;
      if (!(rank > worst) || error < threshold - guard || std::isinf(threshold)) continue;
      if (error <= threshold + guard &&
          !exceeds_exactly_between(a.height, b.height, col * kLatticeSteps - a.x, b.x - a.x, height, threshold))
        continue;
      worst = rank;
      split = col;
    }
    if (split < 0) continue;
    kept.push_back(split);
    const BorderVertex middle{split * kLatticeSteps, samples[split], false};
    chords.push_back({middle, b});
    chords.push_back({a, middle});
  }
}

}  // namespace

RowLines::RowLines(const ConstraintGraph& graph, std::int32_t side, bool releases_starts)
    : graph_(graph),
      side_(side),
      releases_starts_(releases_starts),
      points_(graph.points.size()),
      edges_(graph.edges.size()),
      cut_(graph) {
  std::iota(points_.begin(), points_.end(), 0u);
  std::sort(points_.begin(), points_.end(),
            [&](std::uint32_t a, std::uint32_t b) { return before(graph_.points[a], graph_.points[b]); });
  const auto upper_end = [&](std::uint32_t edge) {
    return std::min(graph_.points[graph_.edges[edge][0]].y, graph_.points[graph_.edges[edge][1]].y);
  };
  std::iota(edges_.begin(), edges_.end(), 0u);
  std::stable_sort(edges_.begin(), edges_.end(),
                   [&](std::uint32_t a, std::uint32_t b) { return upper_end(a) < upper_end(b); });
}

/// Whether lines have points on rows of samples, both included.
bool RowLines::has_points(std::int32_t top, std::int32_t bottom) const {
  const auto first = std::partition_point(points_.begin(), points_.end(),
                                          [&](auto p) { return graph_.points[p].y < top * kLatticeSteps; });
  return first != points_.end() && graph_.points[*first].y <= bottom * kLatticeSteps;
}

bool RowLines::makes_whole(std::int32_t first, std::int32_t rows) const {
  return graph_.is_laid_first && has_points(first, first + rows - 1);
}

/// In the row's own coordinates; points on shared rows are all there.
ConstraintGraph RowLines::part_of(const TileRow& row) const {
  const std::int32_t top = row.first * kLatticeSteps, bottom = top + (row.samples.rows - 1) * kLatticeSteps;
  ConstraintGraph part;
  std::vector<std::uint32_t> numbers;  // of points_[first + k]
  const auto row_of = [&](std::uint32_t point) { return graph_.points[point].y; };
  const auto first = std::partition_point(points_.begin(), points_.end(), [&](auto p) { return row_of(p) < top; });
  const auto last = std::partition_point(first, points_.end(), [&](auto p) { return row_of(p) <= bottom; });
  for (auto p = first; p != last; ++p) {
    const Point at = graph_.points[*p];
    part.points.push_back({at.x, at.y - top});
    part.heights.push_back(graph_.heights[*p]);
    part.is_shared.push_back((at.y == top && row.has_above) || (at.y == bottom && row.has_below) ? 1 : 0);
  }
  const auto number_of = [&](std::uint32_t point) {
    const Point at = graph_.points[point];
    const auto found =
        std::lower_bound(first, last, at, [&](std::uint32_t p, Point to) { return before(graph_.points[p], to); });
    return static_cast<std::uint32_t>(found - first);
  };
  const auto upper_end = [&](std::uint32_t edge) {
    return std::min(row_of(graph_.edges[edge][0]), row_of(graph_.edges[edge][1]));
  };
  auto edge = std::partition_point(edges_.begin(), edges_.end(), [&](auto e) { return upper_end(e) < top; });
  for (; edge != edges_.end() && upper_end(*edge) <= bottom; ++edge) {
    const auto [a, b] = graph_.edges[*edge];
    if (std::max(row_of(a), row_of(b)) > bottom) continue;
    part.edges.push_back({number_of(a), number_of(b)});
    if (!graph_.is_start.empty()) part.is_start.push_back(graph_.is_start[*edge]);
  }
  part.cut = cut_.part_of(row.first, row.samples.rows, number_of);
  return part;
}

/// Tiles have split the others, to the threshold.
void RowLines::split_shared(const TileRow& row, bool is_top, const Bounds& bounds, ConstraintGraph& part) const {
  const std::int32_t y = is_top ? 0 : row.samples.rows - 1;
  const float* samples = row.samples.row(y);
  std::vector<BorderVertex> vertices = line_vertices(part, y, samples);
  if (vertices.empty() && bounds.own.empty()) return;
  for (Vertex v = 0; v < row.tin.vertex_count(); ++v) {
    const Point p = row.tin.point(v);
    if (p.y == y) vertices.push_back({p.x * kLatticeSteps, samples[p.x], false});
  }
  sort_along(vertices);
  std::vector<std::int32_t> kept;
  for (std::size_t i = 0; i + 1 < vertices.size(); ++i) {
    if (!bounds.own.empty() || vertices[i].is_of_line || vertices[i + 1].is_of_line)
      split_border_chord(samples, vertices[i], vertices[i + 1], bounds.of(row, y), kept);
  }
  share_samples(kept, y, samples, part);
}

/// The domain, and the shared borders with all their vertices.
Result<void> RowLines::start(TileRow& row, const Bounds& bounds, ConstraintGraph& part) const {
  if (auto started = start_row(row); !started) return started;
  if (row.has_above) {
    if (auto top = start_border(row, true, bounds, part); !top) return top;
  }
  return row.has_below ? start_border(row, false, bounds, part) : Result<void>();
}

Result<void> RowLines::start_border(const TileRow& row, bool is_top, const Bounds& bounds,
                                    ConstraintGraph& part) const {
  const std::int32_t y = is_top ? 0 : row.samples.rows - 1, around = y + (row.has_above ? 1 : 0);
  const float* samples = row.samples.row(y);
  const HeightField field{row.around.samples, row.around.cols, row.around.rows};
  std::vector<BorderVertex> vertices = line_vertices(part, y, samples);
  std::vector<std::int32_t> kept;
  if (vertices.empty()) {
    // The row beyond may be of tiles.
    const TilePlan plan(field.cols, field.rows, side_);
    for (std::size_t tile = 0; tile < plan.per_row(); ++tile) {
      const TileWindow window = plan.window(tile);
      const auto chain = simplify_border(field, {window.col, around, window.cols - 1, false}, bounds.threshold);
      if (!chain) return tl::unexpected(chain.error());
      if (tile > 0) kept.push_back(window.col);
      for (const std::int32_t step : *chain) kept.push_back(window.col + step);
    }
    if (!bounds.own.empty()) {
      vertices = {{0, samples[0], false}, {(field.cols - 1) * kLatticeSteps, samples[field.cols - 1], false}};
      for (const std::int32_t col : kept) vertices.push_back({col * kLatticeSteps, samples[col], false});
      sort_along(vertices);
      for (std::size_t i = 0; i + 1 < vertices.size(); ++i)
        split_border_chord(samples, vertices[i], vertices[i + 1], bounds.of(row, y), kept);
    }
    share_samples(kept, y, samples, part);
    return {};
  }
  const auto runs = find_border_runs(field, {0, around, field.cols - 1, false});
  if (!runs) return tl::unexpected(runs.error());
  for (const BorderRun& run : *runs) {
    vertices.push_back({run.begin * kLatticeSteps, samples[run.begin], false});
    if (run.begin > 0) kept.push_back(run.begin);
  }
  vertices.push_back({runs->back().end * kLatticeSteps, samples[runs->back().end], false});
  sort_along(vertices);
  auto run = runs->begin();
  for (std::size_t i = 0; i + 1 < vertices.size(); ++i) {
    while (run->end * kLatticeSteps <= vertices[i].x) ++run;
    if (run->has_surface) split_border_chord(samples, vertices[i], vertices[i + 1], bounds.of(row, y), kept);
  }
  // Each point of the part once.
  std::erase_if(kept, [&](std::int32_t col) {
    const auto at = std::lower_bound(vertices.begin(), vertices.end(), col * kLatticeSteps,
                                     [](const BorderVertex& v, std::int32_t x) { return v.x < x; });
    return at != vertices.end() && at->x == col * kLatticeSteps && at->is_of_line;
  });
  share_samples(kept, y, samples, part);
  return {};
}

Result<FinishedRow> RowLines::lay(TileRow row, double threshold, std::span<float> own) {
  const Bounds bounds{threshold, own};
  const bool is_whole = makes_whole(row.first, row.samples.rows);
  ConstraintGraph part = part_of(row);
  if (is_whole) {
    if (auto started = start(row, bounds, part); !started) return tl::unexpected(started.error());
  } else {
    if (row.has_above) split_shared(row, true, bounds, part);
    if (row.has_below) split_shared(row, false, bounds, part);
  }
  for (const bool is_top : {true, false}) {
    if (own.empty() || !(is_top ? row.has_above : row.has_below)) continue;
    const std::span<float> shared = along(own, row, is_top ? 0 : row.samples.rows - 1);
    std::fill(shared.begin(), shared.end(), std::numeric_limits<float>::infinity());
  }
  auto laid = ConstrainedMesh::lay(row.samples, row.tin, part);
  if (!laid) return tl::unexpected(laid.error());
  has_surface_ = has_surface_ || laid->has_surface();
  if (!has_surface_ && !row.has_below) return fail(ErrorKind::kInput, kNothingInCutline);
  const LatticeJudge judge(row.samples, laid->heights(), threshold, own);
  const bool is_clean = !is_whole && own.empty();
  Refinement refinement(judge, row.tin, Algorithm::kHeap, {},
                        is_clean ? Refinement::Start::kClean : Refinement::Start::kScan);
  if (is_clean) refinement.scan(laid->changed());
  if (auto refined = refine_row(row, refinement, work_); !refined) return tl::unexpected(refined.error());
  if (releases_starts_) laid->release_starts(row.tin);
  VertexPlaces places = laid->places();
  return FinishedRow{std::move(row.tin), std::move(places)};
}

}  // namespace scarp
