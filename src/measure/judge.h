// Judges a mesh by heights, channels, masks, tolerances and ignored samples.
//
// measure() returns the distance of a mesh from the heights. judge_mesh() also checks the bound of simplify() with a
// mask, tolerances, a script or channels. Both are independent of how the mesh was built.
#pragma once

#include <array>
#include <cstdint>
#include <functional>
#include <optional>
#include <span>
#include <vector>

#include "scarp/height_field.h"
#include "scarp/measure.h"
#include "scarp/mesh.h"
#include "scarp/options.h"
#include "scarp/result.h"
#include "scarp/run.h"
#include "scarp/tolerances.h"

#pragma GCC visibility push(default)

namespace scarp::judge {

/// The largest of some absolute errors, and its sample (col, row): (−1, −1) if all are 0.
struct LargestError {
  double value = 0;
  std::array<std::int32_t, 2> at{-1, -1};
};

/// Errors of heights, or norms, that are weighted by a mask or tolerances and compared with a bound. They are rounded
/// to float32.
struct WeighedErrors {
  LargestError largest;    ///< over all judged samples, without HeightField::sample_rounding
  LargestError bounded;    ///< over the judged samples with a bound
  double rmse = 0;         ///< root of the mean square over all judged samples
  std::uint64_t over = 0;  ///< samples above their bound, including HeightField::sample_rounding
};

/// weight · error.
double weigh_by_mask(float weight, double error);
/// error / tolerance; 0 for an error of 0.
double weigh_by_tolerance(float tolerance, double error);

/// The most by which rounding in double arithmetic can raise an error of measure() above `bound`: 1e-12 · bound + 1e-12
/// · max |z|.
double judging_allowance(double bound, const HeightRange& heights);

struct JudgeOptions {
  Tolerances tolerances = {};  ///< like SimplifyOptions::tolerances; not together with weights
  /// The bound of all samples, at least 0: on the weighted error under a mask, on the norm with channels, otherwise on
  /// the height error. With tolerances it also bounds samples whose tolerance is infinite. DEFAULT: none.
  std::optional<double> max_error = std::nullopt;
  /// How to combine a sample's errors in heights and channels.
  Norm norm = Norm::kSum;
  const Cutline* cutline = nullptr;  ///< Like MeasureOptions::cutline. Borrowed.
  bool topology = true;              ///< like MeasureOptions::topology
  /// False: omits Judgement::combined and weighted, and Judgement::ignored if bounds are read in windows. This saves a
  /// pass over the bounds, and the memory of errors. DEFAULT: true.
  bool weigh = true;
  bool keep_errors = false;  ///< fill Judgement::height_errors and norms. DEFAULT: false.
  /// Like MeasureOptions::on_row: signed errors of the heights by row, as an alternative to keep_errors.
  std::function<void(int row, std::span<const float> errors)> on_row = {};
  Run run = {};
};

struct Judgement {
  Measurement heights;                ///< without offenders and over_tolerance
  std::vector<Measurement> channels;  ///< one per channel, in its own units; without topology
  std::uint64_t ignored = 0;          ///< valid samples without a bound: ignored, of weight 0 or of infinite tolerance
  LargestError bounded;               ///< largest height error of covered samples that are not ignored
  std::optional<WeighedErrors> combined;  ///< with channels: norms, compared with max_error
  /// With a mask: weighted errors, compared with max_error. With tolerances: error / tolerance, compared with 1. With
  /// channels, the errors are norms.
  std::optional<WeighedErrors> weighted;
  std::vector<float> height_errors;  ///< if kept: mesh − sample, one per sample; NaN if nodata or uncovered
  std::vector<double> norms;         ///< if kept, with channels: norm of all errors of a sample, one per sample
};

/// Judges heights, then each channel as if it were the height, then the combined and weighted errors. A sample counts
/// as above its bound only if the excess is larger than the rounding of the judge: 1e-12 of the largest value, plus
/// 2⁻²³ of the bound because errors are float32.
///
/// `mesh` has as many channels as `field`, with values in Mesh::channels. Borrows its arguments for the call. Reads a
/// field with a source, and sources of weights and tolerances, in bands of rows; reads them twice if errors are above
/// their bound. Fails with kUsage if weights or tolerances do not have the field's size, or both are given; if
/// max_error is below 0; if the numbers of channels differ; if a field with a source has channels, or an array of
/// weights or tolerances; if a field in space has channels; or if an ignored sample is outside the raster. Also fails
/// if measure() or a source fails. Memory: as measure(), plus 4 bytes per sample with weights, an array of tolerances,
/// channels or keep_errors; 8 more with channels; 4 more if samples in memory are ignored. Cost: as measure(), once for
/// the heights and once per channel.
Result<Judgement> judge_mesh(const HeightField& field, const Mesh& mesh, const JudgeOptions& options = {});

/// The errors that take_error_raster() returns.
enum class ErrorsOf {
  kHeights,  ///< signed height errors
  kNorms,    ///< norms over heights and channels; without channels, like kHeights
};
/// The kept errors as a raster, NaN for nodata or uncovered samples. REQUIRES: JudgeOptions::keep_errors.
std::vector<float> take_error_raster(Judgement judgement, ErrorsOf of);

}  // namespace scarp::judge

#pragma GCC visibility pop
