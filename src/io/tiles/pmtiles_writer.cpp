#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <nlohmann/json.hpp>
#include <string>
#include <utility>

#include "io/base64.h"
#include "io/gzip.h"
#include "io/tiles/pmtiles_parts.h"
#include "io/tiles/set_archive.h"
#include "scarp/version.h"

namespace scarp::io {
namespace {

using Bytes = std::vector<std::uint8_t>;

/// Readers request the header and the root at once, 16,384 bytes.
constexpr std::size_t kMostRoot = 16384 - kPmtilesHeaderSize;
/// Size limit of all files other than tiles.
constexpr std::size_t kMostFiles = std::size_t{1} << 29;

struct Directories {
  Bytes root, leaves;
};

/// Puts all entries in the root if they fit, else in leaf directories of equal size, as many as fit the root.
Result<Directories> make_directories(std::span<const PmtilesEntry> entries) {
  constexpr std::size_t kMostTried = 16384, kLeastLeaf = 4096;
  if (entries.size() <= kMostTried) {
    SCARP_TRY(auto&& root, compress_gzip(encode_pmtiles_directory(entries)));
    if (root.size() <= kMostRoot) return Directories{std::move(root), {}};
  }
  for (std::size_t per_leaf = std::max(kLeastLeaf, entries.size() / 3500);; per_leaf += per_leaf / 5) {
    Directories directories;
    std::vector<PmtilesEntry> root;
    for (std::size_t begin = 0; begin < entries.size(); begin += per_leaf) {
      const auto part = entries.subspan(begin, std::min(per_leaf, entries.size() - begin));
      SCARP_TRY(const auto& leaf, compress_gzip(encode_pmtiles_directory(part)));
      root.push_back({part[0].number, directories.leaves.size(), static_cast<std::uint32_t>(leaf.size()), 0});
      directories.leaves.insert(directories.leaves.end(), leaf.begin(), leaf.end());
    }
    SCARP_TRY(directories.root, compress_gzip(encode_pmtiles_directory(root)));
    if (directories.root.size() <= kMostRoot) return directories;
  }
}

/// Other files are members of "files": JSON files as text, others as base64 of their bytes.
Result<Bytes> make_metadata(const TileSpool& spool, TileFormat format, const SetFacts& facts) {
  using Json = nlohmann::ordered_json;
  Json files = Json::object();
  std::size_t size = 0;
  const auto too_large = [&] {
    return fail(ErrorKind::kOutput,
                fmt::format("PMTiles holds {} MB of other files than tiles at most, and this set has more: {}",
                            kMostFiles >> 20, "write a folder, .mbtiles or .3tz"));
  };
  for (const TileSpool::File& file : spool.files()) {
    SCARP_TRY(const auto& bytes, spool.read(file));
    size += bytes.size();
    if (size > kMostFiles) return too_large();
    if (Json::accept(bytes.begin(), bytes.end())) {
      files[file.name] = std::string(bytes.begin(), bytes.end());
    } else {
      files[file.name] = Json{{"base64", write_base64(bytes)}};
    }
  }
  const Json metadata{{"name", facts.name},
                      {"description", facts.description},
                      {"attribution", facts.attribution},
                      {"format", media_type(format)},
                      {"grid", facts.grid.name()},
                      {"zoom_offset", pmtiles_zoom_offset(facts.grid)},
                      {"generator", std::string("scarp ") + version()},
                      {"files", std::move(files)}};
  const std::string text = metadata.dump(-1, ' ', false, Json::error_handler_t::replace);
  if (text.size() > most_pmtiles_metadata(UINT64_MAX)) return too_large();
  auto packed = compress_gzip({reinterpret_cast<const std::uint8_t*>(text.data()), text.size()});
  if (packed && text.size() > most_pmtiles_metadata(packed->size()))
    return fail(ErrorKind::kOutput, "a file of the set is too even for the metadata of PMTiles: write a folder");
  return packed;
}

}  // namespace

Result<void> write_pmtiles(TileSpool& spool, TileFormat format, StagedFile& file) {
  const SetFacts facts = facts_of(spool);
  const auto number = [&](const TileSpool::Tile& tile) { return pmtiles_number(tile.id, facts.grid); };
  spool.sort_tiles([&](const TileSpool::Tile& a, const TileSpool::Tile& b) { return number(a) < number(b); });
  spool.sort_files();
  std::vector<PmtilesEntry> entries;
  entries.reserve(spool.tiles().size());
  PmtilesHeader header;
  for (const TileSpool::Tile& tile : spool.tiles()) {
    entries.push_back({number(tile), header.tiles.length, tile.length, 1});
    header.tiles.length += tile.length;
  }
  if (entries.empty()) return fail(ErrorKind::kOutput, fmt::format("{} would hold no tile", file.path()));
  SCARP_TRY(const auto& directories, make_directories(entries));
  SCARP_TRY(const auto& metadata, make_metadata(spool, format, facts));

  header.root = {kPmtilesHeaderSize, directories.root.size()};
  header.metadata = {header.root.offset + header.root.length, metadata.size()};
  header.leaves = {header.metadata.offset + header.metadata.length, directories.leaves.size()};
  header.tiles.offset = header.leaves.offset + header.leaves.length;
  header.tile_count = header.entry_count = header.content_count = entries.size();
  header.tile = spool.all_gzip()  ? PmtilesCompression::kGzip
                : spool.no_gzip() ? PmtilesCompression::kNone
                                  : PmtilesCompression::kUnknown;
  header.min_zoom = spool.tiles().front().id.z + pmtiles_zoom_offset(facts.grid);
  header.max_zoom = spool.tiles().back().id.z + pmtiles_zoom_offset(facts.grid);
  header.bounds = facts.bounds;

  ChunkedOutput output(file);
  const auto head = encode_pmtiles_header(header);
  for (const std::span<const std::uint8_t> part :
       {std::span<const std::uint8_t>(head), std::span<const std::uint8_t>(directories.root),
        std::span<const std::uint8_t>(metadata), std::span<const std::uint8_t>(directories.leaves)}) {
    SCARP_RETURN_IF_ERROR(output.add(part));
  }
  for (const TileSpool::Tile& tile : spool.tiles()) {
    SCARP_TRY(const auto& bytes, spool.read(tile));
    SCARP_RETURN_IF_ERROR(output.add(bytes));
  }
  return output.flush();
}

}  // namespace scarp::io
