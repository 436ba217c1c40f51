// Colours as bytes, and as the linear light of glTF.
#pragma once

#include <array>
#include <cstdint>

namespace scarp::io {

/// Linear light (0 … 1) of each sRGB byte (IEC 61966-2-1), the same on every machine.
extern const std::array<float, 256> kLinearOfSrgb;

/// The byte of the nearest sRGB colour; b for kLinearOfSrgb[b]. Negative values and NaN give 0, values above 1 give
/// 255.
std::uint8_t srgb_of_linear(double linear);

}  // namespace scarp::io
