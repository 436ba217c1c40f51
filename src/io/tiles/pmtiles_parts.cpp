#include "io/tiles/pmtiles_parts.h"

#include <algorithm>
#include <bit>
#include <cmath>
#include <cstring>
#include <string_view>
#include <utility>

#include "io/mesh/file_bytes.h"
#include "io/tiles/tile_levels.h"

namespace scarp::io {
namespace {

constexpr std::string_view kMagic = "PMTiles";
constexpr std::uint8_t kPmtilesVersion = 3;

/// Number of tiles of all lower zooms.
std::uint64_t first_number(int zoom) { return ((std::uint64_t{1} << (2 * zoom)) - 1) / 3; }

/// One step of the Hilbert curve: rotates a quadrant of side `size`.
void turn(std::uint64_t size, bool right, bool upper, std::uint64_t& x, std::uint64_t& y) {
  if (upper) return;
  if (right) {
    x = size - 1 - x;
    y = size - 1 - y;
  }
  std::swap(x, y);
}

void append_varint(std::vector<std::uint8_t>& bytes, std::uint64_t value) {
  for (; value >= 0x80; value >>= 7) bytes.push_back(static_cast<std::uint8_t>(value | 0x80));
  bytes.push_back(static_cast<std::uint8_t>(value));
}

/// False at the end, and for more than 64 bits.
bool read_varint(std::span<const std::uint8_t>& bytes, std::uint64_t& value) {
  value = 0;
  for (int shift = 0; shift < 64; shift += 7) {
    if (bytes.empty()) return false;
    const std::uint8_t byte = bytes.front();
    bytes = bytes.subspan(1);
    if (shift == 63 && byte > 1) return false;
    value |= std::uint64_t{byte & 0x7fu} << shift;
    if (byte < 0x80) return true;
  }
  return false;
}

std::int32_t in_e7(double degrees) {
  return static_cast<std::int32_t>(std::lround(std::clamp(degrees, -180.0, 180.0) * 1e7));
}

}  // namespace

int pmtiles_zoom_offset(const TileGrid& grid) { return std::countr_zero(grid.roots()); }

std::uint64_t pmtiles_number(TileId id, const TileGrid& grid) {
  const int zoom = id.z + pmtiles_zoom_offset(grid);
  std::uint64_t number = 0, x = id.x, y = std::uint64_t{grid.rows(id.z)} - 1 - id.y;
  for (int bit = zoom - 1; bit >= 0; --bit) {
    const std::uint64_t size = std::uint64_t{1} << bit;
    const bool right = (x & size) != 0, upper = (y & size) != 0;
    number += size * size * ((right ? 3u : 0u) ^ (upper ? 1u : 0u));
    turn(size, right, upper, x, y);
  }
  return first_number(zoom) + number;
}

std::optional<TileId> find_pmtiles_id(std::uint64_t number, const TileGrid& grid) {
  const int offset = pmtiles_zoom_offset(grid);
  int zoom = offset;
  while (zoom <= kMaxTileLevel + offset && number >= first_number(zoom + 1)) ++zoom;
  if (zoom > kMaxTileLevel + offset || number < first_number(offset)) return {};
  std::uint64_t rest = number - first_number(zoom), x = 0, y = 0;
  for (int bit = 0; bit < zoom; ++bit, rest /= 4) {
    const std::uint64_t size = std::uint64_t{1} << bit;
    const bool right = (rest & 2) != 0, upper = ((rest ^ (rest >> 1)) & 1) != 0;
    turn(size, right, upper, x, y);
    x += right ? size : 0;
    y += upper ? size : 0;
  }
  const std::uint64_t rows = grid.rows(zoom - offset);
  if (y >= rows) return {};
  return TileId{zoom - offset, static_cast<std::uint32_t>(x), static_cast<std::uint32_t>(rows - 1 - y)};
}

std::vector<std::uint8_t> encode_pmtiles_directory(std::span<const PmtilesEntry> entries) {
  std::vector<std::uint8_t> bytes;
  append_varint(bytes, entries.size());
  std::uint64_t last = 0;
  for (const PmtilesEntry& entry : entries) append_varint(bytes, entry.number - std::exchange(last, entry.number));
  for (const PmtilesEntry& entry : entries) append_varint(bytes, entry.run);
  for (const PmtilesEntry& entry : entries) append_varint(bytes, entry.length);
  std::uint64_t end = 0;
  for (const PmtilesEntry& entry : entries) {
    append_varint(bytes, &entry != entries.data() && entry.offset == end ? 0 : entry.offset + 1);
    end = entry.offset + entry.length;
  }
  return bytes;
}

std::optional<std::vector<PmtilesEntry>> decode_pmtiles_directory(std::span<const std::uint8_t> bytes,
                                                                  std::uint64_t most) {
  std::uint64_t count = 0, value = 0;
  if (!read_varint(bytes, count) || count == 0 || count > most || count > bytes.size() / 4) return {};
  std::vector<PmtilesEntry> entries(count);
  std::uint64_t next = 0;  // the smallest valid next number
  for (PmtilesEntry& entry : entries) {
    const bool is_first = &entry == entries.data();
    const std::uint64_t last = is_first ? 0 : (&entry)[-1].number;
    if (!read_varint(bytes, value) || value > first_number(31) - last || last + value < next) return {};
    entry.number = last + value;
    next = entry.number + 1;
  }
  for (PmtilesEntry& entry : entries) {
    if (!read_varint(bytes, value) || value > UINT32_MAX) return {};
    entry.run = static_cast<std::uint32_t>(value);
  }
  for (PmtilesEntry& entry : entries) {
    if (!read_varint(bytes, value) || value == 0 || value > UINT32_MAX) return {};
    entry.length = static_cast<std::uint32_t>(value);
  }
  constexpr std::uint64_t kMostOffset = std::uint64_t{1} << 62;
  std::uint64_t end = 0;
  for (PmtilesEntry& entry : entries) {
    if (!read_varint(bytes, value) || value > kMostOffset) return {};
    if (value == 0 && &entry == entries.data()) return {};
    entry.offset = value == 0 ? end : value - 1;
    if (entry.offset > kMostOffset) return {};
    end = entry.offset + entry.length;
  }
  return entries;
}

std::array<std::uint8_t, kPmtilesHeaderSize> encode_pmtiles_header(const PmtilesHeader& header) {
  std::array<std::uint8_t, kPmtilesHeaderSize> bytes{};
  std::copy(kMagic.begin(), kMagic.end(), bytes.begin());
  std::uint8_t* at = bytes.data() + kMagic.size();
  store_number(at, kPmtilesVersion);
  for (const PmtilesPart& part : {header.root, header.metadata, header.leaves, header.tiles}) {
    store_number(at, part.offset);
    store_number(at, part.length);
  }
  for (const std::uint64_t count : {header.tile_count, header.entry_count, header.content_count})
    store_number(at, count);
  store_number(at, std::uint8_t{header.is_clustered});
  store_number(at, static_cast<std::uint8_t>(header.inner));
  store_number(at, static_cast<std::uint8_t>(header.tile));
  store_number(at, std::uint8_t{0});  // tile type: unknown
  store_number(at, static_cast<std::uint8_t>(header.min_zoom));
  store_number(at, static_cast<std::uint8_t>(header.max_zoom));
  const DegreeBox& box = header.bounds;
  for (const double degrees : {box.west, box.south, box.east, box.north}) store_number(at, in_e7(degrees));
  store_number(at, static_cast<std::uint8_t>(header.min_zoom));
  for (const double degrees : {(box.west + box.east) / 2, (box.south + box.north) / 2})
    store_number(at, in_e7(degrees));
  return bytes;
}

Result<PmtilesHeader> decode_pmtiles_header(std::span<const std::uint8_t> bytes) {
  if (bytes.size() < kPmtilesHeaderSize || !std::equal(kMagic.begin(), kMagic.end(), bytes.begin()))
    return fail(ErrorKind::kInput, "is no PMTiles archive");
  if (bytes[kMagic.size()] != kPmtilesVersion)
    return fail(ErrorKind::kInput, "is a PMTiles archive of another version than 3");
  PmtilesHeader header;
  const std::uint8_t* at = bytes.data() + 8;
  for (PmtilesPart* part : {&header.root, &header.metadata, &header.leaves, &header.tiles}) {
    part->offset = load_number<std::uint64_t>(at);
    part->length = load_number<std::uint64_t>(at + 8);
    at += 16;
  }
  for (std::uint64_t* count : {&header.tile_count, &header.entry_count, &header.content_count}) {
    *count = load_number<std::uint64_t>(at);
    at += 8;
  }
  if (at[1] != 1 && at[1] != 2)
    return fail(ErrorKind::kInput, "is a PMTiles archive whose directories are compressed otherwise than by gzip");
  header.is_clustered = at[0] == 1;
  header.inner = static_cast<PmtilesCompression>(at[1]);
  header.tile = at[2] <= 2 ? static_cast<PmtilesCompression>(at[2]) : PmtilesCompression::kUnknown;
  header.min_zoom = at[4];
  header.max_zoom = at[5];
  return header;
}

}  // namespace scarp::io
