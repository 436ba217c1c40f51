#include "pieces/border_chain.h"

#include <algorithm>
#include <array>
#include <bit>
#include <cmath>
#include <utility>

#include "geom/exact_error.h"
#include "grid/window.h"

namespace scarp::pieces {

namespace {

/// Keeps the samples that the chord from `first` to `last` needs. REQUIRES: no nodata on [first, last].
void split_chord(const std::vector<float>& heights, std::int32_t first, std::int32_t last, const LineBound& bound,
                 std::vector<std::int32_t>& kept) {
  std::vector<std::pair<std::int32_t, std::int32_t>> chords{{first, last}};
  const auto at = [&](std::int32_t i) { return heights[static_cast<std::size_t>(i)]; };
  while (!chords.empty()) {
    const auto [a, b] = chords.back();
    chords.pop_back();
    const double from = at(a), rise = double{at(b)} - from, steps = b - a;
    // Five roundings, each at most the magnitude of its operands.
    const double guard_of_chord = 0x1p-50 * (std::abs(from) + std::abs(rise));
    double worst = -1;
    std::int32_t split = 0;
    for (std::int32_t i = a + 1; i < b; ++i) {
      const double error = std::abs(from + rise * ((i - a) / steps) - double{at(i)}), threshold = bound.at(i);
      const double guard = guard_of_chord + 0x1p-50 * threshold, rank = bound.rank(error, threshold);
      if (!(rank > worst) || error < threshold - guard || std::isinf(threshold)) continue;
      if (error <= threshold + guard && !geom::exceeds_exactly_between(at(a), at(b), i - a, b - a, at(i), threshold))
        continue;
      worst = rank;
      split = i;
    }
    if (split == 0) continue;
    kept.push_back(split);
    chords.push_back({split, b});
    chords.push_back({a, split});
  }
}

/// Samples before, on and after the line at each of its steps; NaN beyond the raster.
struct Strip {
  std::array<std::vector<float>, 3> heights;
  /// The valid corners of the cell between step i and i + 1 on one side (0 before, 1 after the line).
  unsigned corners(std::size_t side, std::size_t i) const {
    const auto bit = [&](std::size_t k, std::size_t j, unsigned n) { return std::isnan(heights[k][j]) ? 0u : 1u << n; };
    return bit(side, i, 0) | bit(side, i + 1, 1) | bit(side + 1, i, 2) | bit(side + 1, i + 1, 3);
  }
};

Result<Strip> read_strip(const HeightField& field, const BorderLine& line) {
  const auto count = static_cast<std::size_t>(line.steps) + 1;
  Strip strip;
  for (auto& heights : strip.heights) heights.assign(count, NAN);
  const std::int32_t across = line.is_vertical ? line.col : line.row;
  const std::int32_t most = (line.is_vertical ? field.cols : field.rows) - 1;
  const std::int32_t first = std::max(across - 1, 0), lines = std::min(across + 1, most) - first + 1;
  std::vector<float> window(count * static_cast<std::size_t>(lines));
  SCARP_RETURN_IF_ERROR(
      line.is_vertical
          ? grid::read_window(field, first, line.row, lines, line.steps + 1, window.data(), lines)
          : grid::read_window(field, line.col, first, line.steps + 1, lines, window.data(), line.steps + 1));
  for (std::size_t i = 0; i < count; ++i) {
    for (std::int32_t k = 0; k < lines; ++k) {
      const auto j = static_cast<std::size_t>(k);
      strip.heights[static_cast<std::size_t>(first + k - across + 1)][i] =
          line.is_vertical ? window[i * static_cast<std::size_t>(lines) + j] : window[j * count + i];
    }
  }
  return strip;
}

std::vector<BorderRun> runs_of(const Strip& strip, std::int32_t steps) {
  const auto is_full = [](unsigned corners) { return corners == 15; };
  const auto is_empty = [](unsigned corners) { return std::popcount(corners) < 3; };
  std::vector<BorderRun> runs;
  std::int32_t begin = 0;
  const auto end_run = [&](std::int32_t end) {
    const bool has_surface = !is_empty(strip.corners(0, static_cast<std::size_t>(begin))) ||
                             !is_empty(strip.corners(1, static_cast<std::size_t>(begin)));
    runs.push_back({begin, end, has_surface});
    begin = end;
  };
  for (std::int32_t i = 1; i < steps; ++i) {
    bool is_uniform = true;
    for (std::size_t side = 0; side < 2; ++side) {
      const unsigned before = strip.corners(side, static_cast<std::size_t>(i) - 1);
      const unsigned after = strip.corners(side, static_cast<std::size_t>(i));
      is_uniform = is_uniform && ((is_full(before) && is_full(after)) || (is_empty(before) && is_empty(after)));
    }
    if (!is_uniform) end_run(i);
  }
  end_run(steps);
  return runs;
}

}  // namespace

Result<std::vector<BorderRun>> find_border_runs(const HeightField& field, const BorderLine& line) {
  SCARP_TRY(const auto& strip, read_strip(field, line));
  return runs_of(strip, line.steps);
}

Result<std::vector<std::int32_t>> simplify_border(const HeightField& field, const BorderLine& line,
                                                  const LineBound& bound) {
  SCARP_TRY(const auto& strip, read_strip(field, line));
  std::vector<std::int32_t> kept;
  for (const BorderRun& run : runs_of(strip, line.steps)) {
    // A half cell with its missing corner on the line has no surface along the line; its run is one step.
    if (run.has_surface && run.end - run.begin > 1) split_chord(strip.heights[1], run.begin, run.end, bound, kept);
    if (run.end < line.steps) kept.push_back(run.end);
  }
  std::sort(kept.begin(), kept.end());
  return kept;
}

Result<std::vector<std::int32_t>> split_border(const HeightField& field, const BorderLine& line,
                                               std::span<const std::int32_t> kept, const LineBound& bound) {
  SCARP_TRY(const auto& strip, read_strip(field, line));
  std::vector<std::int32_t> more;
  auto end = kept.begin();
  for (const BorderRun& run : runs_of(strip, line.steps)) {
    for (std::int32_t from = run.begin; from < run.end;) {
      while (end != kept.end() && *end <= from) ++end;
      const std::int32_t to = end == kept.end() ? run.end : std::min(*end, run.end);
      if (run.has_surface && to - from > 1) split_chord(strip.heights[1], from, to, bound, more);
      from = to;
    }
  }
  std::sort(more.begin(), more.end());
  return more;
}

}  // namespace scarp::pieces
