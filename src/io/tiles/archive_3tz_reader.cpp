#include <fmt/format.h>

#include <algorithm>
#include <map>
#include <utility>

#include "io/mesh/file_bytes.h"
#include "io/tiles/md5.h"
#include "io/tiles/set_archive.h"
#include "io/tiles/tile_levels.h"
#include "io/tiles/tile_names.h"
#include "io/zip.h"

namespace scarp::io {
namespace {

using Bytes = std::vector<std::uint8_t>;

class ReaderOf3tz final : public TileSetReader {
 public:
  static Result<std::unique_ptr<TileSetReader>> open(const std::string& path) {
    SCARP_TRY(auto&& source, ByteSource::open(path));
    std::unique_ptr<ReaderOf3tz> reader(new ReaderOf3tz(std::move(source)));
    SCARP_RETURN_IF_ERROR(reader->read_directory());
    return reader;
  }

  TileFormat format() const override { return format_; }
  const std::vector<std::vector<std::uint64_t>>& tiles() const override { return levels_.levels(); }
  std::vector<std::string> files() const override { return files_; }
  Result<Bytes> read_tile(TileId id) const override {
    if (!is_of_grid(id)) return refuse("holds no such tile");
    return read_file(tile_name(format_, id));
  }
  Result<Bytes> read_file(const std::string& name) const override {
    const auto found = std::lower_bound(records_.begin(), records_.end(), name, is_before);
    if (found == records_.end() || found->name != name) return refuse(fmt::format("holds no {}", name));
    SCARP_TRY(const auto& head, source_->read(found->offset, kZipHeaderSize));
    const std::uint64_t length = zip_header_length(head);
    if (length == 0) return refuse(fmt::format("is damaged: {} is not where it should be", name));
    SCARP_TRY(const auto& packed, source_->read(found->offset + length, found->packed));
    auto bytes = unpack_zip_entry(*found, packed);
    if (!bytes) return refuse(fmt::format("cannot be read: {}", bytes.error().message));
    return bytes;
  }
  std::vector<std::string> find_faults() const override {
    const auto because = [&](const std::string& why) {
      return std::vector<std::string>{fmt::format("{}: {}", source_->path(), why)};
    };
    const auto bytes = read_file(std::string(kIndexOf3tz));
    if (!bytes) return because("its index, by which clients find tiles, is missing or damaged");
    using Key = std::pair<std::uint64_t, std::uint64_t>;
    std::map<Key, std::uint64_t> places;
    const auto key_of = [](const std::uint8_t* at) {
      return Key{load_number<std::uint64_t>(at), load_number<std::uint64_t>(at + 8)};
    };
    constexpr std::size_t kEntry = 24;
    Key last;
    for (std::size_t at = 0; at + kEntry <= bytes->size(); at += kEntry) {
      const Key key = key_of(bytes->data() + at);
      if (at > 0 && !(last < key)) return because("its index is not in order, so that clients do not find tiles in it");
      last = key;
      places[key] = load_number<std::uint64_t>(bytes->data() + at + 16);
    }
    std::uint64_t others = 0;
    for (const ZipRecord& record : records_) {
      if (record.name == kIndexOf3tz) continue;
      ++others;
      const auto found = places.find(key_of(md5_of(record.name).data()));
      if (found == places.end()) return because(fmt::format("its index does not list {}", record.name));
      if (found->second != record.offset)
        return because(fmt::format("its index tells a wrong place of {}", record.name));
    }
    if (others * kEntry != bytes->size()) return because("its index lists more than it holds");
    return {};
  }

 private:
  explicit ReaderOf3tz(std::unique_ptr<ByteSource> source) : source_(std::move(source)) {}

  static bool is_before(const ZipRecord& record, std::string_view name) { return record.name < name; }

  tl::unexpected<Error> refuse(const std::string& why) const {
    return fail(ErrorKind::kInput, fmt::format("{} {}", source_->path(), why));
  }

  Result<void> read_directory() {
    const std::uint64_t size = source_->size(), tail_size = std::min(size, kLongestZipEnd);
    SCARP_TRY(const auto& tail, source_->read(size - tail_size, tail_size));
    const auto directory = find_zip_directory(tail, size);
    if (!directory) return refuse(fmt::format("is no .3tz: {}", directory.error().message));
    SCARP_TRY(directory_, source_->read(directory->start, size - directory->start));
    auto records = read_zip_directory(directory_, directory->count);
    if (!records) return refuse(fmt::format("is no .3tz: {}", records.error().message));
    records_ = std::move(*records);
    std::sort(records_.begin(), records_.end(), [](const ZipRecord& a, const ZipRecord& b) { return a.name < b.name; });
    const auto same = std::adjacent_find(records_.begin(), records_.end(),
                                         [](const ZipRecord& a, const ZipRecord& b) { return a.name == b.name; });
    if (same != records_.end()) return refuse("is damaged: it has a name twice");
    const bool is_terrain = std::any_of(records_.begin(), records_.end(), [](const ZipRecord& record) {
      return find_tile_id(TileFormat::kQuantizedMesh, record.name).has_value();
    });
    format_ = is_terrain ? TileFormat::kQuantizedMesh : TileFormat::kGlb;
    for (const ZipRecord& record : records_) {
      if (const auto id = find_tile_id(format_, record.name)) {
        levels_.add(*id);
      } else if (is_plain_name(record.name) && record.name[0] != '@') {
        files_.emplace_back(record.name);
      }
    }
    levels_.sort();
    if (levels_.count() == 0) return refuse("is no set of tiles: it holds none");
    return {};
  }

  std::unique_ptr<ByteSource> source_;
  TileFormat format_ = TileFormat::kGlb;
  Bytes directory_;
  std::vector<ZipRecord> records_;  ///< by name; names borrow the directory
  TileLevels levels_;
  std::vector<std::string> files_;
};

}  // namespace

Result<std::unique_ptr<TileSetReader>> open_3tz(const std::string& path) { return ReaderOf3tz::open(path); }

}  // namespace scarp::io
