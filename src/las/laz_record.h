// The record of a LAZ file that describes its compression, and its table of chunks.
#pragma once

#include <cstdint>
#include <span>
#include <string>
#include <vector>

#include "las/bytes.h"
#include "scarp/result.h"

namespace scarp::las {

/// A group of a point's fields that are compressed together. The enumerators have the numbers used in the file.
enum class LazItemType : std::uint16_t {
  kByte = 0,
  kPoint10 = 6,
  kGpsTime11 = 7,
  kRgb12 = 8,
  kWavePacket13 = 9,
  kPoint14 = 10,
  kRgb14 = 11,
  kRgbNir14 = 12,
  kWavePacket14 = 13,
  kByte14 = 14,
};

struct LazItem {
  LazItemType type = LazItemType::kByte;
  std::uint16_t bytes = 0, version = 0;
};

struct LazRecord {
  bool is_layered = false;
  bool has_chunks = false;
  std::uint32_t chunk_points = 0;  ///< 2^32 - 1: given per chunk in the table of chunks
  std::vector<LazItem> items;

  bool has_varying_chunks() const { return chunk_points == 0xFFFFFFFFU; }
  /// Total bytes of all items.
  std::uint64_t point_bytes() const;
};

/// Fails with kInput for an invalid record, and for features that this reader does not support.
Result<LazRecord> parse_laz_record(std::span<const std::uint8_t> bytes, unsigned point_format,
                                   std::uint16_t record_bytes, const std::string& name);

struct LazChunk {
  std::uint64_t offset = 0, bytes = 0;  ///< in the file
  std::uint64_t points = 0;
};

/// The chunks of the `points` points that begin at `offset`. Fails with kInput if the table does not describe them.
Result<std::vector<LazChunk>> read_chunk_table(const Source& source, const LazRecord& record, std::uint64_t offset,
                                               std::uint64_t points);

}  // namespace scarp::las
