// Checks that a measured mesh satisfies a bound.
#pragma once

#include <optional>
#include <string>

#include "scarp/height_field.h"
#include "scarp/measure.h"

namespace scarp::cli {

/// ", and values rounded to float32 by up to R,": the rounding that a max error excludes; empty if samples are exact.
std::string describe_rounding(double sample_rounding);

/// Explains why the mesh does not satisfy `bound`: the largest error and its place, the number of uncovered samples and
/// the first one, or a topological fault. The bound applies to the values in the file, which differ by up to
/// `sample_rounding` from the judged float32 samples. Nothing if the mesh satisfies it.
std::optional<std::string> find_broken_promise(const Measurement& measured, double sample_rounding, double bound,
                                               const HeightRange& heights);

/// "1 flipped triangle, 2 overlaps": the faults that is_sound() finds; empty if sound.
std::string list_faults(const Measurement& measured);

}  // namespace scarp::cli
