// The mesh of one cell: a pure function of the samples in it and of the validity of those around it.
//
//     ●──────●───────●      ● corners and vertices of the borders' lines, which depend on samples that both cells have
//     │  cell    cell │     · a void next to the border: its corners on the border are vertices of both cells
//     ●───·●─●───────●
//     │    ··    cell │
//     ●──────●───────●
#pragma once

#include <memory>
#include <span>
#include <vector>

#include "live/bound_ladder.h"
#include "live/sample_ring.h"
#include "scarp/live.h"
#include "scarp/result.h"

namespace scarp::live {

/// Samples of a cell and one more on each side, row by row; heights outside the field are NaN.
struct CellSamples {
  Area cell;                          ///< clipped to the field
  std::span<const float> heights;     ///< those in cell.grown(1)
  std::span<const float> tolerances;  ///< those in cell.grown(1), or empty
  std::vector<std::span<const float>> channels;
};

/// Settings of all cells of a field.
struct CellRules {
  bool has_budget = false;
  Effort effort = Effort::kFast;
  Norm norm = Norm::kSum;
  double sample_rounding = 0, height_scale = 1;
  std::vector<double> channel_scales;
};

/// The largest possible norm of the samples.
double find_reach(const CellSamples& samples, const CellRules& rules);
/// A quarter of the step between float32 values of that size: a smaller bound would change little, or could not be
/// satisfied.
inline double finest_bound(double reach) { return reach * 0x1p-26; }

/// `place`: the first sample of the whole cell, which the field may clip. Slot and version are not set. Fails as
/// simplify() does.
Result<LiveCell> make_cell(const CellSamples& samples, SampleAt place, const CellBounds& bounds,
                           const CellRules& rules);

}  // namespace scarp::live
