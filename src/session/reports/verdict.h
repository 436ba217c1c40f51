// Does a measured mesh keep a bound?
#pragma once

#include <optional>
#include <string>

#include "scarp/height_field.h"
#include "scarp/measure.h"

namespace scarp::cli {

/// ", and values rounded to float32 by up to R,": the rounding that a max error does not count; empty where the samples
/// are the values.
std::string describe_rounding(double sample_rounding);

/// The sentence about why the mesh does not keep `bound` on the values in the raster's file, which lie up to
/// `sample_rounding` away from the float32 samples that were judged: too large an error and where, samples that no
/// triangle covers and the first of them, a fault of its topology. Nothing if it keeps it.
std::optional<std::string> find_broken_promise(const Measurement& measured, double sample_rounding, double bound,
                                               const HeightRange& heights);

/// "1 flipped triangle, 2 overlaps": what is_sound() objects to; empty if it is sound.
std::string list_faults(const Measurement& measured);

}  // namespace scarp::cli
