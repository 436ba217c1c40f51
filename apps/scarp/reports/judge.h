// Judging a mesh with everything that counts: heights, channels, masks and tolerances.
#pragma once

#include <optional>
#include <string>
#include <vector>

#include "inputs/channels.h"
#include "inputs/companions.h"
#include "reports/error_weigher.h"
#include "scarp/cutline.h"
#include "scarp/height_field.h"
#include "scarp/measure.h"
#include "scarp/mesh.h"

namespace scarp::cli {

struct Judgement {
  Measurement heights;
  std::vector<Measurement> channels;     ///< without topology
  std::vector<float> height_errors;      ///< signed, NaN where void or uncovered; if they were to be kept
  std::vector<double> norms;             ///< of all errors of a sample; with channels, if they were to be kept
  LargestError bounded;                  ///< of heights, over covered samples that are no JudgeOptions::exceptions
  std::optional<WeighedErrors> weighed;  ///< by JudgeOptions::weigh_by
  std::string uncovered_sample;          ///< "the first at column 3, row 7"; empty if there is none
};

struct JudgeOptions {
  bool keep_errors = false;
  bool topology = true;
  const Exceptions* exceptions = nullptr;  ///< null or empty: none
  /// Tolerances by which errors are weighed as they are found. Where some are above theirs they are judged twice, since
  /// the range of the heights decides how much is rounding. Null: none.
  const SampleSource* weigh_by = nullptr;
  const Cutline* cutline = nullptr;  ///< as MeasureOptions::cutline
  int threads = 0;
  ProgressCallback progress = {};
};

/// Judges heights, then each channel as if it were the height. `mesh` has as many channels as `channels`.
Result<Judgement> judge(const HeightField& heights, const Mesh& mesh, const Channels& channels, Norm norm,
                        const JudgeOptions& options);

/// The kept errors as a raster: signed errors of the heights, or the norms over heights and channels.
enum class ErrorsOf { kHeights, kNorms };
std::vector<float> take_error_raster(Judgement judgement, ErrorsOf of);

/// Fills mesh.channels from its 8-bit colours where the file holds nothing else, and checks their number. `path` is
/// the mesh's, for the sentence.
Result<void> restore_channels(Mesh& mesh, const Channels& channels, const std::string& path);

/// REQUIRES: the errors were kept. A sample is above `bound` by more than the rounding of the judge: 1e-12 of the
/// largest value, and 2^-23 of the bound, since the judge hands out errors as float32.
WeighedErrors weigh_errors(const Judgement& judgement, const HeightField& heights, const Channels& channels,
                           const Companions& companions, const Exceptions& exceptions, double bound);

}  // namespace scarp::cli
