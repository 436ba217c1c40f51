// PMTiles, version 3: the numbers of tiles, the header and the directories (the public specification, 3.x).
//
// PMTiles has one tile at its top, a pyramid of the geographic grid two. So its level z is kept as zoom z + 1, whose
// upper half it fills; that of the Mercator grid as zoom z: x as it is, y from the north.
#pragma once

#include <array>
#include <cstdint>
#include <optional>
#include <span>
#include <vector>

#include "scarp/result.h"
#include "scarp/tile.h"

namespace scarp {

/// The zoom that level 0 is kept as.
int pmtiles_zoom_offset(const TileGrid& grid);
/// Its place on the Hilbert curves of all zooms, one after the other.
std::uint64_t pmtiles_number(TileId id, const TileGrid& grid);
/// The reverse; nothing where the grid has no such tile.
std::optional<TileId> find_pmtiles_id(std::uint64_t number, const TileGrid& grid);

/// Tiles `number` to `number + run - 1`, all with the same bytes; a directory if run is 0.
struct PmtilesEntry {
  std::uint64_t number = 0, offset = 0;
  std::uint32_t length = 0, run = 1;
};
/// Not compressed.
std::vector<std::uint8_t> encode_pmtiles_directory(std::span<const PmtilesEntry> entries);
/// Nothing for bytes that are no directory: numbers rise, lengths are above 0. At most `most` entries.
std::optional<std::vector<PmtilesEntry>> decode_pmtiles_directory(std::span<const std::uint8_t> bytes,
                                                                  std::uint64_t most);

/// Offset and length of a part of the file.
struct PmtilesPart {
  std::uint64_t offset = 0, length = 0;
};
enum class PmtilesCompression : std::uint8_t { kUnknown = 0, kNone = 1, kGzip = 2 };
inline constexpr std::size_t kPmtilesHeaderSize = 127;
struct PmtilesHeader {
  PmtilesPart root, metadata, leaves, tiles;
  std::uint64_t tile_count = 0, entry_count = 0, content_count = 0;
  PmtilesCompression inner = PmtilesCompression::kGzip, tile = PmtilesCompression::kUnknown;
  int min_zoom = 0, max_zoom = 0;
  bool is_clustered = true;
  DegreeBox bounds;
};
/// The header of a clustered archive whose tiles have a type that PMTiles does not know.
std::array<std::uint8_t, kPmtilesHeaderSize> encode_pmtiles_header(const PmtilesHeader& header);
/// Fails with kInput, with the end of a sentence, for other files and other versions. The bounds are omitted.
Result<PmtilesHeader> decode_pmtiles_header(std::span<const std::uint8_t> bytes);

/// Bytes of metadata that a reader unpacks from `packed` bytes: less than gzip can hold, more than text of tiles needs.
constexpr std::uint64_t most_pmtiles_metadata(std::uint64_t packed) {
  constexpr std::uint64_t kMost = std::uint64_t{1} << 30, kRatio = 256;
  return packed > kMost / kRatio ? kMost : (std::uint64_t{1} << 20) + kRatio * packed;
}

}  // namespace scarp
