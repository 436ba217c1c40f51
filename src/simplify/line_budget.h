// Budgets of meshes with lines, and of meshes that are made row by row, by fast effort.
//
// Insertion that stops at a budget does not know how closely lines are to follow the raster: that depends on the max
// error of the mesh to come. Nor can rows of tiles know what others will take. So the error is searched for whose mesh
// just fits:
//
//   the lines alone, with the outline   ── the least mesh there is; what is below it is refused
//   runs with errors far apart          ── triangles grow about as a power of the error
//   runs with errors on both sides      ── secants in log-log, by the Illinois rule
#pragma once

#include "scarp/result.h"
#include "scarp/simplify.h"
#include "simplify/error_search.h"

namespace scarp {

/// Of the meshes that the search has seen within the budgets the one with the least max error, at options.max_error if
/// that is given and reached; the exact one if the budgets leave room for it. Each is the mesh that fast effort makes
/// for some max error, which is told in Simplified::lines_for.
///
/// Guarantees: no budget is exceeded. The search ends with at least 99 % of a budget used (97 % from the fifth run on),
/// when two errors 0.2 % apart lie on both sides of the budget, or after kMostLineRuns. Fails as `run` does; with
/// kUsage, and the least number that would do, where lines and outline alone do not fit. A bound that cannot be kept
/// (kPromise) only ends what lies below it. `most`: an error that no mesh with these lines exceeds. `run`: simplify()
/// towards a max error, with lines. REQUIRES: a budget.
Result<Simplified> search_line_error(const SimplifyOptions& options, double most, const RunOnce& run);

inline constexpr int kMostLineRuns = 20;

/// Twice the range of the samples and of the heights of breaklines. Reads a source once; throws SourceFailure.
double largest_line_error(const HeightField& field, const SimplifyOptions& options);

}  // namespace scarp
