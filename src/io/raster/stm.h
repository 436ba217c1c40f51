// STM, the height fields of Garland & Heckbert's Scape.
#pragma once

#include <cstdint>
#include <span>
#include <string>

#include "scarp/io.h"

namespace scarp::io {

/// True if the bytes begin like an STM.
bool is_stm(std::span<const std::uint8_t> bytes);

/// Decodes a text header "STM width height ", four bytes that are 0x04030201 in the writer's byte order, a newline, and
/// unsigned 16-bit samples in that byte order, by rows from the north-west corner. 65535 is nodata unless
/// options.nodata is another value. Heights are in the grid frame. Fails with kInput for other files, an unknown byte
/// order, a size below 2×2, missing samples, and trailing bytes.
Result<OwnedHeightField> decode_stm(std::span<const std::uint8_t> bytes, const std::string& name,
                                    const ReadOptions& options = {});

}  // namespace scarp::io
