// Decoders of the chunks of a LAZ file, which are independent of each other.
#pragma once

#include <cstdint>
#include <memory>
#include <span>
#include <vector>

#include "base/function_ref.h"
#include "las/laz_record.h"
#include "las/point.h"

namespace scarp::las {

/// Receives the points of a chunk in order, many at a time.
using EmitPoints = FunctionRef<void(std::span<const LasPoint>)>;

/// Reuses the memory of its statistics, a megabyte, from chunk to chunk. Each thread needs its own decoder.
class ChunkDecoder {
 public:
  virtual ~ChunkDecoder() = default;
  /// Returns false if the bytes end before the points do, or cannot be a chunk.
  virtual bool decode(std::span<const std::uint8_t> bytes, std::uint64_t count, EmitPoints emit) = 0;
};

/// For records of POINT10, GPSTIME11, RGB12, WAVEPACKET13 and BYTE items: one stream has all items of a point.
std::unique_ptr<ChunkDecoder> make_pointwise_decoder(const LazRecord& record);
/// For records that begin with POINT14: each of its fields has a separate stream. Skips streams that are not needed,
/// and all other items.
std::unique_ptr<ChunkDecoder> make_layered_decoder(const LazRecord& record);

}  // namespace scarp::las
