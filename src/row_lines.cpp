#include "row_lines.h"

#include <algorithm>
#include <cmath>
#include <numeric>
#include <utility>

#include "geom/exact_error.h"
#include "grid/vertex_places.h"
#include "refine/lattice_judge.h"
#include "refine/refinement.h"

namespace scarp {

namespace {

/// A vertex on a shared row, in kLatticeSteps along it.
struct BorderVertex {
  std::int32_t x = 0;
  float height = 0;
  bool is_of_line = false;
};

/// Appends the samples that a chord needs between two vertices: the farthest splits it, again and again.
void split_border_chord(const float* samples, const BorderVertex& from, const BorderVertex& to, double threshold,
                        std::vector<std::int32_t>& kept) {
  std::vector<std::pair<BorderVertex, BorderVertex>> chords{{from, to}};
  while (!chords.empty()) {
    const auto [a, b] = chords.back();
    chords.pop_back();
    if (std::isnan(a.height) || std::isnan(b.height)) continue;
    const double rise = double{b.height} - a.height, steps = b.x - a.x;
    const double guard = 0x1p-50 * (std::abs(double{a.height}) + std::abs(rise) + threshold);
    double worst = -1;
    std::int32_t split = -1;
    for (std::int32_t col = a.x / kLatticeSteps + 1; col * kLatticeSteps < b.x; ++col) {
      const float height = samples[col];
      if (std::isnan(height)) continue;
      const double error = std::abs(a.height + rise * ((col * kLatticeSteps - a.x) / steps) - double{height});
      if (error <= worst || error < threshold - guard) continue;
      if (error <= threshold + guard &&
          !exceeds_exactly_between(a.height, b.height, col * kLatticeSteps - a.x, b.x - a.x, height, threshold))
        continue;
      worst = error;
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

RowLines::RowLines(const ConstraintGraph& graph)
    : graph_(graph), points_(graph.points.size()), edges_(graph.edges.size()), cut_(graph) {
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

/// In the row's own coordinates; points on shared rows are all there, with samples that split these.
ConstraintGraph RowLines::part_of(const TileRow& row, double threshold) const {
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
    if (std::max(row_of(a), row_of(b)) <= bottom) part.edges.push_back({number_of(a), number_of(b)});
  }
  part.cut = cut_.part_of(row.first, row.samples.rows, number_of);
  if (row.has_above) split_shared(row, true, threshold, part);
  if (row.has_below) split_shared(row, false, threshold, part);
  return part;
}

void RowLines::split_shared(const TileRow& row, bool is_top, double threshold, ConstraintGraph& part) const {
  const std::int32_t y = is_top ? 0 : row.samples.rows - 1;
  const float* samples = row.samples.row(y);
  std::vector<BorderVertex> vertices;
  for (std::size_t i = 0; i < part.points.size(); ++i) {
    const Point p = part.points[i];
    if (p.y != y * kLatticeSteps) continue;
    const bool is_sample = PlaceHeights::is_sample(p);
    vertices.push_back({p.x, is_sample ? samples[p.x / kLatticeSteps] : part.heights[i], true});
  }
  if (vertices.empty()) return;
  for (Vertex v = 0; v < row.tin.vertex_count(); ++v) {
    const Point p = row.tin.point(v);
    if (p.y == y) vertices.push_back({p.x * kLatticeSteps, samples[p.x], false});
  }
  // A vertex of a line before that of the mesh at the same place.
  std::sort(vertices.begin(), vertices.end(), [](const BorderVertex& a, const BorderVertex& b) {
    return std::pair(a.x, !a.is_of_line) < std::pair(b.x, !b.is_of_line);
  });
  vertices.erase(std::unique(vertices.begin(), vertices.end(), [](const auto& a, const auto& b) { return a.x == b.x; }),
                 vertices.end());
  std::vector<std::int32_t> kept;
  for (std::size_t i = 0; i + 1 < vertices.size(); ++i) {
    if (vertices[i].is_of_line || vertices[i + 1].is_of_line)
      split_border_chord(samples, vertices[i], vertices[i + 1], threshold, kept);
  }
  for (const std::int32_t col : kept) {
    part.points.push_back({col * kLatticeSteps, y * kLatticeSteps});
    part.heights.push_back(samples[col]);
    part.is_shared.push_back(1);
  }
}

Result<FinishedRow> RowLines::lay(TileRow row, double threshold,
                                  const std::function<bool(std::uint64_t vertices)>& goes_on) {
  const ConstraintGraph part = part_of(row, threshold);
  auto laid = ConstrainedMesh::lay(row.samples, row.tin, part);
  if (!laid) return tl::unexpected(laid.error());
  has_surface_ = has_surface_ || laid->has_surface();
  if (!has_surface_ && !row.has_below) return fail(ErrorKind::kInput, kNothingInCutline);
  const LatticeJudge judge(row.samples, laid->heights(), threshold, {});
  Refinement refinement(judge, row.tin, Algorithm::kHeap, {}, Refinement::Start::kClean);
  refinement.scan(laid->changed());
  for (std::uint64_t step = 0; !refinement.done(); ++step) {
    if (refinement.is_full())
      return fail(ErrorKind::kInput, "the mesh would have more than 1,431 million triangles: allow a larger error");
    if (step % 256 == 0 && !goes_on(row.tin.vertex_count()))
      return fail(ErrorKind::kCancelled, "cancelled while laying lines");
    refinement.insert_worst();
  }
  const Work work = refinement.work();
  work_.samples_scanned += work.samples_scanned;
  work_.triangles_scanned += work.triangles_scanned;
  work_.passes += work.passes;
  VertexPlaces places = laid->places();
  return FinishedRow{std::move(row.tin), std::move(places)};
}

}  // namespace scarp
