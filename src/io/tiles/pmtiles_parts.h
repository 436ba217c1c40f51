// PMTiles, version 3 (public specification 3.x): the numbers of tiles, the header and the directories.
//
// PMTiles has one tile at zoom 0. A pyramid of the geographic grid has two at level 0, so its level z is stored in the
// upper half of zoom z + 1. Level z of the Mercator grid is stored as zoom z. x is unchanged, y counts from the north.
#pragma once

#include <array>
#include <cstdint>
#include <optional>
#include <span>
#include <vector>

#include "scarp/result.h"
#include "scarp/tile.h"

namespace scarp::io {

/// The zoom that stores level 0.
int pmtiles_zoom_offset(const TileGrid& grid);
/// The tile's position on the concatenated Hilbert curves of all zooms.
std::uint64_t pmtiles_number(TileId id, const TileGrid& grid);
/// The inverse; nothing for a tile outside the grid.
std::optional<TileId> find_pmtiles_id(std::uint64_t number, const TileGrid& grid);

/// Tiles `number` to `number + run - 1`, all with the same bytes; a directory if run is 0.
struct PmtilesEntry {
  std::uint64_t number = 0, offset = 0;
  std::uint32_t length = 0, run = 1;
};
/// Uncompressed.
std::vector<std::uint8_t> encode_pmtiles_directory(std::span<const PmtilesEntry> entries);
/// Nothing unless numbers increase, lengths exceed 0, and there are at most `most` entries.
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
/// The header of a clustered archive with a tile type unknown to PMTiles.
std::array<std::uint8_t, kPmtilesHeaderSize> encode_pmtiles_header(const PmtilesHeader& header);
/// Fails with kInput and the end of a sentence for other files and versions. Does not read the bounds.
Result<PmtilesHeader> decode_pmtiles_header(std::span<const std::uint8_t> bytes);

/// Size limit for the metadata unpacked from `packed` bytes: below gzip's maximum, and above the needs of tile
/// metadata.
constexpr std::uint64_t most_pmtiles_metadata(std::uint64_t packed) {
  constexpr std::uint64_t kMost = std::uint64_t{1} << 30, kRatio = 256;
  return packed > kMost / kRatio ? kMost : (std::uint64_t{1} << 20) + kRatio * packed;
}

}  // namespace scarp::io
