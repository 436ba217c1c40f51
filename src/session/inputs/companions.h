// Rasters and scripts that set bounds sample by sample.
#pragma once

#include <cstdint>
#include <optional>
#include <string>
#include <vector>

#include "scarp/io.h"
#include "scarp/simplify.h"
#include "scarp/tolerances.h"
#include "session/options/region_options.h"

namespace scarp::cli {

/// The contents of the files; empty for options not given.
struct Companions {
  OwnedWeights mask;  ///< has a source if the heights have one, like the tolerances
  OwnedTolerances tolerances;
  Script script;
  std::vector<std::string> warnings;

  bool has_tolerance() const { return !tolerances.values.empty() || tolerances.source; }
  /// Bytes in addition to those of heights with a source.
  std::uint64_t bytes = 0;

  bool has_weights() const { return !mask.empty() || has_tolerance(); }
  /// True if the script removes bounds of samples, which still count in the largest errors.
  bool ignores_samples() const { return !script.ignored.empty(); }
  bool inserts_samples() const { return !script.inserted.empty(); }
  /// The bounds that simplify() and judge_mesh() borrow.
  Tolerances bounds() const;
};

/// Settings for reading them. `memory` and `threads` matter only for heights with a source.
struct CompanionRun {
  const ProgressCallback& progress;
  std::uint64_t memory = 0;  ///< the process's limit; REQUIRED for heights with a source
  int threads = 0;           ///< number of threads that read windows
};

/// Reads and checks the files, which must lie on the grid of `raster`.
/// Refuses negative values. Mask: if the largest value exceeds 1, all values are divided by it; a missing value means
/// weight 0. Tolerance: a missing value means no bound. A sample in a region of interest has the smaller of the
/// region's tolerance and the raster's; `bound` holds elsewhere. `raster`: the field's metadata, as read. Fails with
/// kUsage if the values do not fit in memory next to heights with a source.
Result<Companions> read_companions(const GivenOptions& given, const RasterInfo& raster, const OwnedHeightField& field,
                                   std::optional<double> bound, const CompanionRun& run);

/// The length unit of `values` in units of the heights; 1 if either is unknown.
double units_of(const RasterInfo& values, const RasterInfo& heights);

/// Fails with a remedy unless `other`, given by `option`, lies on the grid of `raster`.
Result<void> check_grid(const RasterInfo& raster, int cols, int rows, const std::string& option,
                        const RasterInfo& other, int other_cols, int other_rows);

}  // namespace scarp::cli
