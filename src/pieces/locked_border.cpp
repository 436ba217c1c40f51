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
#include "grid/edge_line.h"
#include "metric/criterion.h"
#include "pieces/recipe.h"

namespace scarp::pieces {

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
struct Chord {
  std::int32_t a, b;

  double value_at(std::span<const float> values, std::int32_t i) const { return grid::chord_value(values, a, b, i); }
  /// True if the sample's exact distance from the chord exceeds the bound.
  bool misses(std::span<const float> values, std::int32_t i, double bound) const {
    const float from = values[static_cast<std::size_t>(a)], to = values[static_cast<std::size_t>(b)];
    const float value = values[static_cast<std::size_t>(i)];
    const double error = std::abs(value_at(values, i) - double{value});
    const double rounding = 0x1p-50 * (std::abs(double{from}) + std::abs(double{to}));
    if (std::abs(error - bound) > rounding) return error > bound;
    return geom::exceeds_exactly_between(from, to, i - a, b - a, value, bound);
  }
};

/// `given` plus the ends of runs of valid heights.
std::vector<std::int32_t> complete(std::span<const std::int32_t> given, std::span<const float> heights) {
  const auto is_height = [&](std::size_t i) { return i < heights.size() && !std::isnan(heights[i]); };
  std::vector<std::int32_t> ends, all;
  all.reserve(given.size() + 2);
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
                                        const grid::Raster& raster) {
  LockedBorder border;
  border.cols_ = raster.cols;
  border.rows_ = raster.rows;
  border.samples_.assign(raster.samples, raster.row(raster.rows));
  for (const Channel& channel : field.channels)
    border.channels_.emplace_back(channel.samples, channel.samples + border.samples_.size());
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
                               const grid::Raster& raster) {
  const Border& asked = options.domain.border;
  const auto count = static_cast<std::size_t>(edge.count);
  std::vector<float> heights;
  std::vector<std::vector<float>> channels(field.channels.size());
  std::vector<double> bounds;
  heights.reserve(count);
  for (std::vector<float>& channel : channels) channel.reserve(count);
  bounds.reserve(count);
  for (std::int32_t i = 0; i < edge.count; ++i) {
    const Point p = edge.at(i);
    heights.push_back(raster.at(p));
    for (std::size_t k = 0; k < channels.size(); ++k) channels[k].push_back(field.channels[k].samples[index_of(p)]);
    const double bound = metric::asked_bound(options, asked.max_error, p, raster.cols);
    bounds.push_back(std::isinf(bound) ? bound : metric::tightened(bound, field.sample_rounding));
  }
  std::vector<grid::EdgeField> fields{{heights, field.height_scale}};
  for (std::size_t k = 0; k < channels.size(); ++k) fields.push_back({channels[k], field.channels[k].scale});
  const auto misses = [&](const Chord& chord, std::int32_t i) {
    const double bound = bounds[static_cast<std::size_t>(i)];
    if (!has_norm(field)) return chord.misses(heights, i, bound);
    return grid::chord_error(fields, options.goals.norm, chord.a, chord.b, i) > bound;
  };
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
    vertices = grid::simplify_edge(fields, options.goals.norm, 0, bounds);
  }
  vertices_.reserve(vertices_.size() + vertices.size());
  for (std::size_t k = 0; k < vertices.size(); ++k) {
    vertices_.push_back(edge.at(vertices[k]));
    if (k == 0 || !is_segment(heights, vertices[k - 1], vertices[k])) continue;
    const Chord chord{vertices[k - 1], vertices[k]};
    for (std::int32_t i = chord.a + 1; i < chord.b; ++i) {
      if (asked.vertices && misses(chord, i))
        return fail(ErrorKind::kUsage, fmt::format("the border's {} edge misses sample ({}, {}) by {}, more than {}",
                                                   edge.name, edge.at(i).x, edge.at(i).y,
                                                   grid::chord_error(fields, options.goals.norm, chord.a, chord.b, i),
                                                   bounds[static_cast<std::size_t>(i)]));
      const auto move = [&](std::span<const float> values, std::vector<float>& samples) {
        const double line = chord.value_at(values, i);
        const auto rounded = static_cast<float>(line);
        if (std::abs(rounded - line) < std::abs(line - double{values[static_cast<std::size_t>(i)]}) &&
            chord.misses(values, i, 0))
          samples[index_of(edge.at(i))] = rounded;
      };
      move(heights, samples_);
      for (std::size_t c = 0; c < channels.size(); ++c) move(channels[c], channels_[c]);
    }
  }
  return {};
}

HeightField LockedBorder::with_channels(HeightField field) const {
  for (std::size_t k = 0; k < channels_.size(); ++k) field.channels[k].samples = channels_[k].data();
  return field;
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

std::vector<Point> find_side_vertices(const tin::Triangulation& tin, const grid::Raster& raster, std::int32_t steps) {
  const std::int32_t right = (raster.cols - 1) * steps, bottom = (raster.rows - 1) * steps;
  std::vector<Point> points;
  for (tin::Vertex v = 0; v < tin.vertex_count(); ++v) {
    const Point p = tin.point(v);
    const bool is_on_row = p.y == 0 || p.y == bottom, is_on_column = p.x == 0 || p.x == right;
    if (is_on_row != is_on_column) points.push_back(p);
  }
  sort_rarely(points, before);
  return points;
}

}  // namespace scarp::pieces
