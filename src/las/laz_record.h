// The record of a LAZ file that describes its compression, and its table of chunks.
#pragma once

#include <cstdint>
#include <span>
#include <string>
#include <vector>

#include "las/bytes.h"
#include "scarp/result.h"

namespace scarp::las {

/// The fields of a point that are compressed together, by their numbers in the file.
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
  std::uint32_t chunk_points = 0;  ///< 2^32 - 1: the table of chunks has it for each
  std::vector<LazItem> items;

  bool has_varying_chunks() const { return chunk_points == 0xFFFFFFFFU; }
  /// Bytes of the fields of all items.
  std::uint64_t point_bytes() const;
};

/// Fails with kInput for what this reader does not know, or the record does not allow.
Result<LazRecord> parse_laz_record(std::span<const std::uint8_t> bytes, unsigned point_format,
                                   std::uint16_t record_bytes, const std::string& name);

struct LazChunk {
  std::uint64_t offset = 0, bytes = 0;  ///< in the file
  std::uint64_t points = 0;
};

/// The chunks of `points` points that begin at the offset. Fails with kInput where the table does not describe them.
Result<std::vector<LazChunk>> read_chunk_table(const Source& source, const LazRecord& record, std::uint64_t offset,
                                               std::uint64_t points);

}  // namespace scarp::las
