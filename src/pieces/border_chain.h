// The border between two tiles: a line of samples, simplified separately.
//
// The result depends only on the samples on the line and the cells next to it, so both tiles compute the same points.
// Their meshes meet without a crack, although the tiles exchange no data.
#pragma once

#include <cstdint>
#include <span>
#include <vector>

#include "scarp/height_field.h"
#include "scarp/result.h"

namespace scarp::pieces {

/// A straight run of samples: from (col, row), `steps` steps to the right or down.
struct BorderLine {
  std::int32_t col = 0, row = 0, steps = 1;
  bool is_vertical = false;
};

/// The bounds of the samples of a line.
struct LineBound {
  LineBound(double same) : of_all(same) {}                     // NOLINT: implicit by design
  LineBound(std::span<const float> by_step) : own(by_step) {}  // NOLINT
  double of_all = 0;
  std::span<const float> own;  ///< bounds by step from step 0, +infinity: none; EMPTY: `of_all` applies everywhere

  double at(std::int32_t step) const { return own.empty() ? of_all : double{own[static_cast<std::size_t>(step)]}; }
  /// The sample with the largest rank splits the chord. The rank is the error, or error / bound if bounds differ.
  double rank(double error, double bound) const { return own.empty() ? error : error / bound; }
};

/// Returns the steps that become vertices, ascending and strictly between 0 and line.steps. Every sample of the line
/// that belongs to the surface on either side lies within its bound of the chain of vertices, in exact arithmetic. A
/// chord is split recursively at its farthest sample (ties: the first). A sample where the surface next to the line
/// changes (a cell with nodata) is also kept, so every corner of an outline on the line is a vertex. The line lies
/// inside the raster; its field may have nodata. Cost: O(steps · log steps), expected. Fails if the field's source
/// fails.
Result<std::vector<std::int32_t>> simplify_border(const HeightField& field, const BorderLine& line,
                                                  const LineBound& bound);

/// The additional steps that `bound` needs, ascending. `kept`: the result of simplify_border() for a larger bound.
Result<std::vector<std::int32_t>> split_border(const HeightField& field, const BorderLine& line,
                                               std::span<const std::int32_t> kept, const LineBound& bound);

/// A run of steps along which neither side changes between surface (cells with four heights) and no surface.
struct BorderRun {
  std::int32_t begin = 0, end = 0;
  bool has_surface = false;  ///< on at least one side
};

/// Splits the whole line into such runs. Fails if the field's source fails.
Result<std::vector<BorderRun>> find_border_runs(const HeightField& field, const BorderLine& line);

}  // namespace scarp::pieces
