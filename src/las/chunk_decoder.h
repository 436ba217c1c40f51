// Decoders of one chunk of a LAZ file, whose points do not depend on other chunks.
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

/// Keeps its statistics, a megabyte, from chunk to chunk: one for each thread.
class ChunkDecoder {
 public:
  virtual ~ChunkDecoder() = default;
  /// Returns false if the bytes end before the points do, or cannot be those of a chunk.
  virtual bool decode(std::span<const std::uint8_t> bytes, std::uint64_t count, EmitPoints emit) = 0;
};

/// The layout of the record is POINT10, GPSTIME11, RGB12, WAVEPACKET13 or BYTE: all of a point is in one stream.
std::unique_ptr<ChunkDecoder> make_pointwise_decoder(const LazRecord& record);
/// POINT14 first: each of its fields is a stream. Those that are not needed are skipped, as are all other items.
std::unique_ptr<ChunkDecoder> make_layered_decoder(const LazRecord& record);

}  // namespace scarp::las
