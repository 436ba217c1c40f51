// The max error for a mesh of a given size.
#pragma once

#include <cstdint>
#include <optional>
#include <span>
#include <vector>

#include "scarp/height_field.h"
#include "scarp/progress.h"
#include "scarp/result.h"

#pragma GCC visibility push(default)

namespace scarp {

/// A max error for a share of the triangles.
struct Suggestion {
  double share = 0;             ///< share of the full grid's triangles, above 0, at most 1
  std::optional<double> error;  ///< max error, in z units: a default run with it stays within the share, and may use
                                ///< far less of it. Three significant digits. None: the outline alone needs more.
};

struct Suggestions {
  std::vector<Suggestion> rows;    ///< one a share, in the order of the shares
  bool is_estimate = false;        ///< made from windows of the raster, not from all of it
  std::uint64_t samples_used = 0;  ///< samples of these windows, or of the raster
};

/// Suggests a max error for each share. The engine first runs greedily on the field until the last share is used up. It
/// then runs in the default order with the errors found, on all threads, and again with larger errors where a run needs
/// more triangles. For fields of more than 2 million samples it uses up to 16 evenly spaced windows of 256 × 256
/// samples, refined as one: the window with the largest error gets the next vertex. Windows have more border for their
/// area than the raster, so the estimate is a little too large. The result depends on the samples and the shares only.
///
/// The field is borrowed during the call. Its channels are omitted: errors are those of heights.
/// `progress`: of the pass "estimate"; may be empty.
/// Fails with kUsage for no shares, for shares not above 0, above 1 or not ascending, and for a field without samples
/// in memory; with kInput if no cell is valid; with kCancelled. Memory: as a greedy run and a default run of simplify()
/// on the samples used. Cost: some two default runs on the samples used, and one a share.
Result<Suggestions> suggest_errors(const HeightField& field, std::span<const double> shares,
                                   const ProgressCallback& progress = {});

}  // namespace scarp

#pragma GCC visibility pop
