#include <fmt/format.h>

#include <algorithm>
#include <map>
#include <nlohmann/json.hpp>
#include <set>
#include <utility>

#include "io/base64.h"
#include "io/gzip.h"
#include "io/tiles/pmtiles_parts.h"
#include "io/tiles/set_archive.h"
#include "io/tiles/tile_levels.h"
#include "io/tiles/tile_names.h"

namespace scarp::io {
namespace {

using Bytes = std::vector<std::uint8_t>;

class PmtilesReader final : public TileSetReader {
 public:
  static Result<std::unique_ptr<TileSetReader>> open(const std::string& path) {
    SCARP_TRY(auto&& source, ByteSource::open(path));
    std::unique_ptr<PmtilesReader> reader(new PmtilesReader(std::move(source)));
    SCARP_RETURN_IF_ERROR(reader->read_parts());
    return reader;
  }

  TileFormat format() const override { return format_; }
  const std::vector<std::vector<std::uint64_t>>& tiles() const override { return levels_.levels(); }
  std::vector<std::string> files() const override {
    std::vector<std::string> names;
    for (const auto& file : files_) names.push_back(file.first);
    return names;
  }
  Result<Bytes> read_tile(TileId id) const override {
    if (!is_of_grid(id) || !levels_.has(id)) return refuse(fmt::format("holds no {}", tile_name(format_, id)));
    const std::uint64_t number = pmtiles_number(id, grid_);
    const auto after =
        std::upper_bound(entries_.begin(), entries_.end(), number,
                         [](std::uint64_t one, const PmtilesEntry& entry) { return one < entry.number; });
    return source_->read(header_.tiles.offset + after[-1].offset, after[-1].length);
  }
  std::optional<bool> says_gzip() const override {
    if (header_.tile == PmtilesCompression::kUnknown) return std::nullopt;
    return header_.tile == PmtilesCompression::kGzip;
  }
  std::vector<std::string> find_faults() const override {
    std::vector<std::string> faults;
    const auto compare = [&](const char* what, std::uint64_t said, std::uint64_t found) {
      if (said != found && said != 0)
        faults.push_back(fmt::format("{}: its header says {} {}, and it has {}", source_->path(), said, what, found));
    };
    std::uint64_t end = 0;
    std::set<std::uint64_t> contents;
    bool is_clustered = true;
    for (const PmtilesEntry& entry : entries_) {
      if (!contents.insert(entry.offset).second) continue;
      is_clustered &= entry.offset >= end;
      end = entry.offset + entry.length;
    }
    compare("tiles", header_.tile_count, levels_.count());
    compare("entries", header_.entry_count, entries_.size());
    compare("different tiles", header_.content_count, contents.size());
    if (header_.is_clustered && !is_clustered)
      faults.push_back(
          fmt::format("{}: its header says that tiles lie in their order, which they do not", source_->path()));
    const auto& levels = levels_.levels();
    const auto first = std::find_if(levels.begin(), levels.end(), [](const auto& level) { return !level.empty(); });
    const int offset = pmtiles_zoom_offset(grid_), least = static_cast<int>(first - levels.begin()) + offset,
              most = static_cast<int>(levels.size()) - 1 + offset;
    if (header_.min_zoom != least || header_.max_zoom != most)
      faults.push_back(fmt::format("{}: its header says zooms {} to {}, and it has {} to {}", source_->path(),
                                   header_.min_zoom, header_.max_zoom, least, most));
    return faults;
  }
  Result<Bytes> read_file(const std::string& name) const override {
    const auto file = files_.find(name);
    if (file == files_.end()) return refuse(fmt::format("holds no {}", name));
    return file->second;
  }

 private:
  explicit PmtilesReader(std::unique_ptr<ByteSource> source)
      : source_(std::move(source)), most_tiles_(source_->size() + (std::uint64_t{1} << 16)) {}

  tl::unexpected<Error> refuse(const std::string& why) const {
    return fail(ErrorKind::kInput, fmt::format("{} {}", source_->path(), why));
  }

  /// A part, decompressed.
  Result<Bytes> read_inner(std::uint64_t offset, std::uint64_t length, std::size_t most) const {
    auto bytes = source_->read(offset, length);
    if (!bytes || header_.inner == PmtilesCompression::kNone) return bytes;
    auto whole = decompress_gzip(*bytes, most);
    if (!whole) return refuse("is damaged: a part of it cannot be decompressed");
    return whole;
  }

  Result<void> read_parts() {
    SCARP_TRY(const auto& head, source_->read(0, std::min<std::uint64_t>(source_->size(), kPmtilesHeaderSize)));
    const auto header = decode_pmtiles_header(head);
    if (!header) return refuse(header.error().message);
    header_ = *header;
    for (const PmtilesPart& part : {header_.root, header_.metadata, header_.leaves, header_.tiles}) {
      if (!source_->has(part.offset, part.length)) return refuse("was cut off");
    }
    SCARP_RETURN_IF_ERROR(read_metadata());
    SCARP_RETURN_IF_ERROR(read_directory(header_.root, 0));
    if (!levels_.sort()) return refuse("is damaged: it has a tile twice");
    return {};
  }

  Result<void> read_metadata() {
    SCARP_TRY(const auto& bytes, read_inner(header_.metadata.offset, header_.metadata.length,
                                            most_pmtiles_metadata(header_.metadata.length)));
    const nlohmann::json metadata = nlohmann::json::parse(bytes.begin(), bytes.end(), nullptr, false);
    if (!metadata.is_object()) return refuse("is damaged: its metadata are no JSON");
    const auto text = [&](const char* key) {
      const auto found = metadata.find(key);
      return found != metadata.end() && found->is_string() ? found->get<std::string>() : std::string();
    };
    const auto grid = TileGrid::find(text("grid"));
    if (!grid) return refuse("is no set of terrain tiles: its metadata name no grid that Scarp knows");
    grid_ = *grid;
    if (text("format") != media_type(TileFormat::kQuantizedMesh) && text("format") != media_type(TileFormat::kGlb))
      return refuse("is no set of terrain tiles: its metadata name no format that Scarp knows");
    format_ = text("format") == media_type(TileFormat::kGlb) ? TileFormat::kGlb : TileFormat::kQuantizedMesh;
    const auto files = metadata.find("files");
    if (files == metadata.end() || !files->is_object()) return {};
    for (const auto& [name, content] : files->items()) {
      if (!is_plain_name(name)) return refuse("is damaged: a name in it leads elsewhere");
      if (content.is_string()) {
        const auto& whole = content.get_ref<const std::string&>();
        files_[name] = Bytes(whole.begin(), whole.end());
      } else {
        const auto letters = content.is_object() ? content.find("base64") : content.end();
        if (!content.is_object() || letters == content.end() || !letters->is_string() ||
            !decode(letters->get_ref<const std::string&>(), files_[name]))
          return refuse(fmt::format("is damaged: {} in it cannot be read", name));
      }
    }
    return {};
  }

  static bool decode(const std::string& letters, Bytes& bytes) {
    if (letters.size() % 4 != 0) return false;
    std::size_t padding = 0;
    while (padding < 2 && padding < letters.size() && letters[letters.size() - 1 - padding] == '=') ++padding;
    std::span<const std::uint8_t> rest(reinterpret_cast<const std::uint8_t*>(letters.data()), letters.size());
    return read_base64(rest, letters.size() / 4 * 3 - padding, bytes) && rest.empty();
  }

  /// Numbers increase through all directories, so none is read twice.
  Result<void> read_directory(const PmtilesPart& part, int depth) {
    constexpr int kMostDepth = 3;
    const auto damaged = [&] { return refuse("is damaged: a directory of it makes no sense"); };
    constexpr std::size_t kMostBytes = std::size_t{1} << 28;
    SCARP_TRY(const auto& bytes, read_inner(part.offset, part.length, kMostBytes));
    const auto entries = decode_pmtiles_directory(bytes, most_tiles_ - levels_.count());
    if (!entries) return damaged();
    for (const PmtilesEntry& entry : *entries) {
      if (entry.number < next_) return damaged();
      const PmtilesPart& whole = entry.run == 0 ? header_.leaves : header_.tiles;
      if (entry.offset > whole.length || entry.length > whole.length - entry.offset) return damaged();
      if (entry.run == 0) {
        if (depth == kMostDepth) return damaged();
        const std::uint64_t before = levels_.count();
        SCARP_RETURN_IF_ERROR(read_directory({whole.offset + entry.offset, entry.length}, depth + 1));
        if (levels_.count() == before) return damaged();
        continue;
      }
      if (entry.run > most_tiles_ - levels_.count()) return damaged();
      entries_.push_back(entry);
      next_ = entry.number + entry.run;
      for (std::uint64_t number = entry.number; number < next_; ++number) {
        const auto id = find_pmtiles_id(number, grid_);
        if (!id) return damaged();
        levels_.add(*id);
      }
    }
    return {};
  }

  std::unique_ptr<ByteSource> source_;
  std::uint64_t most_tiles_;  ///< limit by the file's size, unless all tiles are equal
  PmtilesHeader header_;
  TileFormat format_ = TileFormat::kQuantizedMesh;
  TileGrid grid_;
  std::vector<PmtilesEntry> entries_;  ///< entries of tiles
  std::uint64_t next_ = 0;             ///< the smallest valid next number
  TileLevels levels_;
  std::map<std::string, Bytes> files_;
};

}  // namespace

Result<std::unique_ptr<TileSetReader>> open_pmtiles(const std::string& path) { return PmtilesReader::open(path); }

}  // namespace scarp::io
