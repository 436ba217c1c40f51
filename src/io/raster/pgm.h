// PGM, plain (P2) and raw (P5).
#pragma once

#include <cstdint>
#include <span>
#include <string>

#include "scarp/io.h"

namespace scarp::io {

/// True if the bytes begin like a PGM.
bool is_pgm(std::span<const std::uint8_t> bytes);

/// The picture as heights in the grid frame. Comments are allowed anywhere in the header, and between the numbers of a
/// P2. Samples of a P5 have one byte up to maxval 255, else two, high byte first. No value is nodata unless
/// options.nodata sets it. `name` is for messages. Fails with kInput for other files, a size below 2×2 or larger than
/// the data, a maxval outside 1 … 65535, a sample above maxval, missing samples, and trailing bytes other than white
/// space.
Result<OwnedHeightField> decode_pgm(std::span<const std::uint8_t> bytes, const std::string& name,
                                    const ReadOptions& options = {});

}  // namespace scarp::io
