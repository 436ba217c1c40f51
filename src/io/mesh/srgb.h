// Colours as bytes, and as the linear light of glTF.
#pragma once

#include <array>
#include <cstdint>

namespace scarp {

/// Linear light (0 … 1) of each sRGB byte (IEC 61966-2-1), the same on every machine.
extern const std::array<float, 256> kLinearOfSrgb;

/// The byte of the nearest sRGB colour; b for kLinearOfSrgb[b]. Values outside 0 … 1 and NaN give the nearest end.
std::uint8_t srgb_of_linear(double linear);

}  // namespace scarp
