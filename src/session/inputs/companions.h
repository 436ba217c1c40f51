// Rasters and scripts next to INPUT that set, sample by sample, what counts.
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

/// The contents of the files; empty where none was given.
struct Companions {
  OwnedWeights mask;  ///< with a source where the heights have one, as tolerances
  OwnedTolerances tolerances;
  Script script;
  std::vector<std::string> warnings;

  bool has_tolerance() const { return !tolerances.values.empty() || tolerances.source; }
  /// Bytes in addition to those of heights that have a source.
  std::uint64_t bytes = 0;

  bool has_weights() const { return !mask.empty() || has_tolerance(); }
  /// The script removes samples' bounds; they count in the largest errors all the same.
  bool ignores_samples() const { return !script.ignored.empty(); }
  bool inserts_samples() const { return !script.inserted.empty(); }
  /// The bounds that simplify() and judge_mesh() borrow.
  Tolerances bounds() const;
};

/// How a run reads them. The rest counts where the heights have a source.
struct CompanionRun {
  const ProgressCallback& progress;
  std::uint64_t memory = 0;  ///< the process's limit; REQUIRED then
  int threads = 0;           ///< number of threads that read windows
};

/// Reads and checks the files, which must lie on the grid of `raster`.
/// Mask: values below 0 are refused; if the largest is above 1, all are divided by it; no value means weight 0.
/// Tolerance: values below 0 are refused; no value means no bound. Regions of interest: a sample in one has the smaller
/// of its tolerance and the raster's; `bound` holds beyond them. `raster`: that of the field, as it was read. Fails
/// with kUsage if the memory has no room for them in addition to heights that have a source.
Result<Companions> read_companions(const GivenOptions& given, const RasterInfo& raster, const OwnedHeightField& field,
                                   std::optional<double> bound, const CompanionRun& run);

/// Fails, with the way out, unless `other` lies on the grid of `raster`. `option` named it.
Result<void> check_grid(const RasterInfo& raster, int cols, int rows, const std::string& option,
                        const RasterInfo& other, int other_cols, int other_rows);

}  // namespace scarp::cli
