#include "live/cell_mesh.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <utility>
#include <vector>

#include "grid/edge_line.h"
#include "scarp/simplify.h"

namespace scarp::live {

namespace {

/// The samples along a border, and along the rows or columns on either side of it.
class BorderRows {
 public:
  /// `first`: index of the border's first sample; `step`: index step to the next sample; `across`: index step across
  /// the border.
  BorderRows(const CellSamples& samples, std::ptrdiff_t first, std::ptrdiff_t step, std::ptrdiff_t across,
             std::int32_t count)
      : channels_(samples.channels.size()) {
    const auto most = static_cast<std::size_t>(count);
    heights_.reserve(most);
    bounds_.reserve(samples.tolerances.empty() ? 0 : most);
    for (std::vector<float>& channel : channels_) channel.reserve(most);
    for (std::vector<std::uint8_t>& valid : valid_) valid.reserve(most);
    for (std::int32_t k = 0; k < count; ++k, first += step) {
      const auto at = std::size_t(first);
      heights_.push_back(samples.heights[at]);
      if (!samples.tolerances.empty()) bounds_.push_back(samples.tolerances[at]);
      for (std::size_t c = 0; c < channels_.size(); ++c) channels_[c].push_back(samples.channels[c][at]);
      for (std::size_t side = 0; side < 2; ++side)
        valid_[side].push_back(!std::isnan(samples.heights[std::size_t(side == 0 ? first - across : first + across)]));
    }
  }

  /// The fewest vertices for the border. Where voids begin or end next to it, both cells need a vertex; these are kept,
  /// and the parts between them are simplified.
  std::vector<std::int32_t> simplify(double tolerance, const CellRules& rules) {
    if (rules.has_budget)
      tolerance = std::max(tolerance,
                           finest_bound(find_reach({{}, heights_, {}, {channels_.begin(), channels_.end()}}, rules)));
    for (double& bound : bounds_) bound = std::min(bound, tolerance);
    std::vector<std::int32_t> line;
    std::size_t begin = 0;
    for (std::size_t k = 1; k < heights_.size(); ++k) {
      if (k + 1 < heights_.size() && !is_corner(k)) continue;
      const std::size_t count = k - begin + 1;
      std::vector<grid::EdgeField> fields{{std::span(heights_).subspan(begin, count), rules.height_scale}};
      for (std::size_t c = 0; c < channels_.size(); ++c)
        fields.push_back({std::span(channels_[c]).subspan(begin, count), rules.channel_scales[c]});
      const std::span<const double> bounds =
          bounds_.empty() ? std::span<const double>() : std::span(bounds_).subspan(begin, count);
      for (const std::int32_t at : grid::simplify_edge(fields, rules.norm, tolerance, bounds)) {
        const std::int32_t vertex = at + static_cast<std::int32_t>(begin);
        if (line.empty() || line.back() < vertex) line.push_back(vertex);
      }
      begin = k;
    }
    return line;
  }

 private:
  /// True if an outline of voids may leave the border at sample k.
  bool is_corner(std::size_t k) const {
    return !std::isnan(heights_[k]) && std::any_of(valid_.begin(), valid_.end(), [k](const auto& valid) {
      return valid[k - 1] != valid[k] || valid[k] != valid[k + 1];
    });
  }

  std::vector<float> heights_;
  std::vector<double> bounds_;
  std::vector<std::vector<float>> channels_;
  std::array<std::vector<std::uint8_t>, 2> valid_;
};

EdgeVertices find_borders(const CellSamples& samples, const CellBounds& bounds, const CellRules& rules) {
  const std::ptrdiff_t row = samples.cell.cols() + 2, east = samples.cell.cols(), south = samples.cell.rows() * row;
  const auto simplify = [&](std::size_t side, BorderRows rows) {
    return rows.simplify(std::max(0.0, bounds.borders[side] - rules.sample_rounding), rules);
  };
  const auto along_row = [&](std::ptrdiff_t first) { return BorderRows(samples, first, 1, row, samples.cell.cols()); };
  const auto along_column = [&](std::ptrdiff_t first) {
    return BorderRows(samples, first, row, 1, samples.cell.rows());
  };
  return {simplify(0, along_row(row + 1)), simplify(1, along_row(south + 1)), simplify(2, along_column(row + 1)),
          simplify(3, along_column(row + east))};
}

std::vector<float> crop(std::span<const float> grown, std::int32_t cols, std::int32_t rows) {
  std::vector<float> values;
  values.reserve(std::size_t(cols) * std::size_t(rows));
  for (std::int32_t row = 1; row <= rows; ++row) {
    const auto first = grown.begin() + std::ptrdiff_t(row) * (cols + 2) + 1;
    values.insert(values.end(), first, first + cols);
  }
  return values;
}

/// True if a grid cell has three valid samples.
bool has_surface(std::span<const float> heights, std::int32_t cols, std::int32_t rows) {
  for (std::int32_t row = 0; row + 1 < rows; ++row) {
    const float* const upper = &heights[std::size_t(row) * std::size_t(cols)];
    const float* const lower = upper + cols;
    for (std::int32_t col = 0; col + 1 < cols; ++col) {
      const int voids =
          std::isnan(upper[col]) + std::isnan(upper[col + 1]) + std::isnan(lower[col]) + std::isnan(lower[col + 1]);
      if (voids <= 1) return true;
    }
  }
  return false;
}

}  // namespace

double find_reach(const CellSamples& samples, const CellRules& rules) {
  const auto largest = [](std::span<const float> values) {
    float most = 0;
    for (const float value : values) most = std::max(most, std::isfinite(value) ? std::abs(value) : 0);
    return double{most};
  };
  double reach = rules.height_scale * largest(samples.heights);
  for (std::size_t k = 0; k < samples.channels.size(); ++k)
    reach += rules.channel_scales[k] * largest(samples.channels[k]);
  return reach;
}

Result<LiveCell> make_cell(const CellSamples& samples, SampleAt place, const CellBounds& bounds,
                           const CellRules& rules) {
  LiveCell cell;
  cell.place = place;
  const std::int32_t cols = samples.cell.cols(), rows = samples.cell.rows();
  const std::vector<float> heights = crop(samples.heights, cols, rows);
  if (!has_surface(heights, cols, rows)) return cell;
  HeightField field;
  field.samples = heights.data();
  field.cols = cols;
  field.rows = rows;
  field.sample_rounding = rules.sample_rounding;
  field.height_scale = rules.height_scale;
  field.frame.affine = {double(samples.cell.west - place.col), 1, 0, double(place.row - samples.cell.north), 0, -1};
  std::vector<std::vector<float>> channels;
  for (const std::span<const float> channel : samples.channels) channels.push_back(crop(channel, cols, rows));
  for (std::size_t k = 0; k < channels.size(); ++k)
    field.channels.push_back({channels[k].data(), rules.channel_scales[k]});
  std::vector<float> tolerances;
  if (!samples.tolerances.empty()) tolerances = crop(samples.tolerances, cols, rows);
  SimplifyOptions asked;
  asked.goals.max_error = bounds.inside;
  asked.goals.norm = rules.norm;
  asked.tolerances.values = tolerances;
  asked.quality.effort = rules.effort;
  asked.domain.border.is_locked = true;
  asked.domain.border.vertices = find_borders(samples, bounds, rules);
  asked.run.threads = 1;
  SCARP_TRY(auto&& made, scarp::simplify(field, asked));
  cell.positions.reserve(made.mesh.positions.size());
  for (std::size_t v = 0; v < made.mesh.vertex_count(); ++v) {
    for (const double coordinate : made.mesh.vertex(v)) cell.positions.push_back(static_cast<float>(coordinate));
  }
  cell.channels = std::move(made.mesh.channels);
  cell.triangles.assign(made.mesh.triangles.begin(), made.mesh.triangles.end());
  const bool has_norm = !channels.empty() || rules.height_scale != 1;
  cell.max_error = has_norm ? made.combined_max_error : made.measurement.max_error;
  return cell;
}

}  // namespace scarp::live
