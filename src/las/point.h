// The needed fields of a LAS file's point, and the layouts of its records.
#pragma once

#include <array>
#include <cstdint>

#include "las/bytes.h"

namespace scarp::las {

/// Coordinates are whole multiples of the file's scale.
struct LasPoint {
  std::int32_t x = 0, y = 0, z = 0;
  std::uint8_t number = 0;         ///< its class: 2 for ground
  std::uint8_t return_number = 0;  ///< 1 for the first of a pulse; 0 if the file has none
  std::uint8_t return_count = 0;   ///< number of returns of the pulse
  bool is_withheld = false;        ///< the file's producer wants it to be treated as deleted
  bool is_overlap = false;         ///< in the overlap of flight lines
};

/// True for formats 6 to 10, with wider fields for returns, flags and class.
constexpr bool is_extended(unsigned format) { return format >= 6; }

constexpr unsigned kFormats = 11;
/// Bytes of the fields of each format; records may have additional user-defined bytes.
constexpr std::array<std::uint16_t, kFormats> kRecordBytes{20, 28, 26, 34, 57, 63, 30, 36, 38, 59, 67};

inline LasPoint legacy_point(std::int32_t x, std::int32_t y, std::int32_t z, unsigned returns, unsigned class_byte) {
  constexpr unsigned kOverlap = 12;
  const unsigned number = class_byte & 31;
  return {x,
          y,
          z,
          static_cast<std::uint8_t>(number),
          static_cast<std::uint8_t>(returns & 7),
          static_cast<std::uint8_t>(returns >> 3 & 7),
          (class_byte & 0x80) != 0,
          number == kOverlap};
}

inline LasPoint extended_point(std::int32_t x, std::int32_t y, std::int32_t z, unsigned returns, unsigned flags,
                               unsigned number) {
  return {x,
          y,
          z,
          static_cast<std::uint8_t>(number),
          static_cast<std::uint8_t>(returns & 15),
          static_cast<std::uint8_t>(returns >> 4 & 15),
          (flags & 4) != 0,
          (flags & 8) != 0};
}

/// REQUIRES: a record of that format.
inline LasPoint decode_record(const std::uint8_t* record, bool is_extended_format) {
  const auto x = load<std::int32_t>(record), y = load<std::int32_t>(record + 4), z = load<std::int32_t>(record + 8);
  return is_extended_format ? extended_point(x, y, z, record[14], record[15], record[16])
                            : legacy_point(x, y, z, record[14], record[15]);
}

}  // namespace scarp::las
