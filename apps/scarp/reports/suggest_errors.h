// Which max error gives a mesh of a given size?
#pragma once

#include <optional>
#include <span>
#include <vector>

#include "scarp/height_field.h"
#include "scarp/progress.h"
#include "scarp/result.h"

namespace scarp::cli {

struct Suggestion {
  double share = 0;             ///< of the full grid's triangles, 0..1
  std::optional<double> error;  ///< that keeps the default order's mesh within the share, and hardly any smaller one
                                ///< does: three significant digits; none if the outline needs more
};

struct Suggestions {
  std::vector<Suggestion> rows;
  bool is_estimate = false;  ///< from windows, not from the whole raster
  std::uint64_t samples_used = 0;
};

/// Runs the engine on the field, greedily until the last share (ascending) is used up, then in the default order with
/// the errors found, on all threads, and again with larger ones where that needs more triangles. Fields of more than 2
/// million samples are judged by up to 16 evenly spaced windows of 256×256, refined as one: the window with the largest
/// error gets the next vertex. Fails with kInput if no cell is valid, kCancelled if the callback says so.
Result<Suggestions> suggest_errors(const HeightField& field, std::span<const double> shares,
                                   const ProgressCallback& progress);

}  // namespace scarp::cli
