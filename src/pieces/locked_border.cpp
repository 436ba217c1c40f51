#include "pieces/locked_border.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <iterator>
#include <limits>
#include <span>
#include <utility>

#include "base/sort.h"
#include "geom/exact_error.h"
#include "metric/criterion.h"

namespace scarp {

/// One of the four edges, from west to east or from north to south.
struct LockedBorder::Edge {
  const char* name;
  Point first, step;
  std::int32_t count;
  const std::vector<std::int32_t> EdgeVertices::*given;

  Point at(std::int32_t i) const { return {first.x + i * step.x, first.y + i * step.y}; }
};

namespace {

/// A piece of the line, between two vertices.
class Chord {
 public:
  Chord(std::span<const float> heights, std::int32_t a, std::int32_t b)
      : heights_(heights), a_(a), steps_(b - a), from_(at(a)), to_(at(b)) {}

  double height_at(std::int32_t i) const {
    return double{from_} + (double{to_} - double{from_}) * (static_cast<double>(i - a_) / steps_);
  }
  /// True if the sample is farther from the chord than the bound, as real numbers.
  bool misses(std::int32_t i, double bound) const {
    const double error = std::abs(height_at(i) - double{at(i)});
    const double rounding = 0x1p-50 * (std::abs(double{from_}) + std::abs(double{to_}));
    if (std::abs(error - bound) > rounding) return error > bound;
    return exceeds_exactly_between(from_, to_, i - a_, steps_, at(i), bound);
  }

 private:
  float at(std::int32_t i) const { return heights_[static_cast<std::size_t>(i)]; }

  std::span<const float> heights_;
  std::int32_t a_, steps_;
  float from_, to_;
};

/// `given` plus the ends of runs of valid heights.
std::vector<std::int32_t> complete(std::span<const std::int32_t> given, std::span<const float> heights) {
  const auto is_height = [&](std::size_t i) { return i < heights.size() && !std::isnan(heights[i]); };
  std::vector<std::int32_t> ends, all;
  for (std::size_t i = 0; i < heights.size(); ++i) {
    if (is_height(i) && !(is_height(i - 1) && is_height(i + 1))) ends.push_back(static_cast<std::int32_t>(i));
  }
  std::set_union(given.begin(), given.end(), ends.begin(), ends.end(), std::back_inserter(all));
  return all;
}

/// True if the line has a segment there: all samples between the vertices are valid.
bool is_segment(std::span<const float> heights, std::int32_t a, std::int32_t b) {
  return std::none_of(heights.begin() + a, heights.begin() + b, [](float z) { return std::isnan(z); });
}

}  // namespace

Result<LockedBorder> LockedBorder::make(const HeightField& field, const SimplifyOptions& options,
                                        const Raster& raster) {
  LockedBorder border;
  border.cols_ = raster.cols;
  border.rows_ = raster.rows;
  border.samples_.assign(raster.samples, raster.row(raster.rows));
  const std::int32_t right = raster.cols - 1, bottom = raster.rows - 1;
  const Edge edges[] = {{"top", {0, 0}, {1, 0}, raster.cols, &EdgeVertices::top},
                        {"bottom", {0, bottom}, {1, 0}, raster.cols, &EdgeVertices::bottom},
                        {"left", {0, 0}, {0, 1}, raster.rows, &EdgeVertices::left},
                        {"right", {right, 0}, {0, 1}, raster.rows, &EdgeVertices::right}};
  for (const Edge& edge : edges) {
    SCARP_RETURN_IF_ERROR(border.add(edge, field, options, raster));
  }
  return border;
}

Result<void> LockedBorder::add(const Edge& edge, const HeightField& field, const SimplifyOptions& options,
                               const Raster& raster) {
  const Border& asked = options.domain.border;
  std::vector<float> heights;
  std::vector<double> bounds;
  for (std::int32_t i = 0; i < edge.count; ++i) {
    heights.push_back(raster.at(edge.at(i)));
    const double bound = asked_bound(options, asked.max_error, edge.at(i), raster.cols);
    bounds.push_back(std::isinf(bound) ? bound : tightened(bound, field.sample_rounding));
  }
  std::vector<std::int32_t> vertices;
  if (asked.vertices) {
    const std::vector<std::int32_t>& given = (*asked.vertices).*edge.given;
    for (std::size_t k = 0; k < given.size(); ++k) {
      const std::int32_t i = given[k];
      if (i < 0 || i >= edge.count || (k > 0 && i <= given[k - 1]) || std::isnan(heights[static_cast<std::size_t>(i)]))
        return fail(ErrorKind::kUsage,
                    fmt::format("vertex {} of the border's {} edge is no sample with a height beyond the one before it",
                                i, edge.name));
    }
    vertices = complete(given, heights);
  } else {
    vertices = simplify_edge(heights, 0, bounds);
  }
  for (std::size_t k = 0; k < vertices.size(); ++k) {
    vertices_.push_back(edge.at(vertices[k]));
    if (k == 0 || !is_segment(heights, vertices[k - 1], vertices[k])) continue;
    for (std::int32_t i = vertices[k - 1] + 1; i < vertices[k]; ++i) {
      const Chord chord(heights, vertices[k - 1], vertices[k]);
      const double bound = bounds[static_cast<std::size_t>(i)], line = chord.height_at(i);
      const double error = std::abs(line - double{heights[static_cast<std::size_t>(i)]});
      if (asked.vertices && chord.misses(i, bound))
        return fail(ErrorKind::kUsage, fmt::format("the border's {} edge misses sample ({}, {}) by {}, more than {}",
                                                   edge.name, edge.at(i).x, edge.at(i).y, error, bound));
      const auto rounded = static_cast<float>(line);
      if (std::abs(rounded - line) >= error || !chord.misses(i, 0)) continue;
      const Point p = edge.at(i);
      samples_[static_cast<std::size_t>(p.y) * static_cast<std::size_t>(cols_) + static_cast<std::size_t>(p.x)] =
          rounded;
    }
  }
  return {};
}

Result<void> LockedBorder::check(std::span<const Point> points, std::int32_t steps) const {
  std::vector<Point> sorted = vertices_;
  sort_rarely(sorted, before);
  const std::int32_t right = (cols_ - 1) * steps, bottom = (rows_ - 1) * steps;
  for (const Point p : points) {
    if (p.x != 0 && p.y != 0 && p.x != right && p.y != bottom) continue;
    const Point sample{p.x / steps, p.y / steps};
    if (p.x % steps == 0 && p.y % steps == 0 && std::binary_search(sorted.begin(), sorted.end(), sample, before))
      continue;
    return fail(
        ErrorKind::kUsage,
        fmt::format("a line meets the raster's edge at sample ({:.9g}, {:.9g}), and the edge is locked and has no "
                    "vertex there: end the line inside the raster, or at a vertex of the edge",
                    p.x / double(steps), p.y / double(steps)));
  }
  return {};
}

std::vector<Point> find_side_vertices(const Triangulation& tin, const Raster& raster, std::int32_t steps) {
  const std::int32_t right = (raster.cols - 1) * steps, bottom = (raster.rows - 1) * steps;
  std::vector<Point> points;
  for (Vertex v = 0; v < tin.vertex_count(); ++v) {
    const Point p = tin.point(v);
    const bool is_on_row = p.y == 0 || p.y == bottom, is_on_column = p.x == 0 || p.x == right;
    if (is_on_row != is_on_column) points.push_back(p);
  }
  sort_rarely(points, before);
  return points;
}

}  // namespace scarp
