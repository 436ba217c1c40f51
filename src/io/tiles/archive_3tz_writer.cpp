// 3D Tiles Archive Format 1.3: a ZIP archive whose last entry lists the other entries' offsets, by the MD5 of their
// names.
#include <fmt/format.h>

#include <algorithm>
#include <tuple>

#include "io/mesh/file_bytes.h"
#include "io/tiles/md5.h"
#include "io/tiles/set_archive.h"
#include "io/tiles/tile_names.h"
#include "io/zip.h"

namespace scarp::io {
namespace {

using Bytes = std::vector<std::uint8_t>;

class ArchiveOf3tz {
 public:
  explicit ArchiveOf3tz(StagedFile& file) : output_(file) {}

  Result<void> add(std::string_view name, std::span<const std::uint8_t> bytes) {
    constexpr std::uint64_t kMost = 0xfffffffe;
    if (bytes.size() > kMost) return fail(ErrorKind::kOutput, fmt::format("{} is larger than 4 GB", name));
    ZipRecord record;
    record.name = name;
    record.offset = output_.position();
    record.packed = record.size = bytes.size();
    record.checksum = zip_checksum(bytes);
    Bytes header;
    append_zip_header(header, record);
    append_zip_record(directory_, record);
    index_.push_back({md5_of(name), record.offset});
    SCARP_RETURN_IF_ERROR(output_.add(header));
    return output_.add(bytes);
  }

  Result<void> finish() {
    // Sums are compared as two 64-bit numbers.
    std::sort(index_.begin(), index_.end(), [](const Place& a, const Place& b) { return a.key() < b.key(); });
    Bytes index(24 * index_.size());
    std::uint8_t* at = index.data();
    for (const Place& place : index_) {
      at = std::copy(place.sum.begin(), place.sum.end(), at);
      store_number(at, place.offset);
    }
    const std::uint64_t count = index_.size() + 1;
    SCARP_RETURN_IF_ERROR(add(kIndexOf3tz, index));
    const std::uint64_t start = output_.position(), size = directory_.size();
    append_zip_end(directory_, count, start, size);
    SCARP_RETURN_IF_ERROR(output_.add(directory_));
    return output_.flush();
  }

 private:
  struct Place {
    std::array<std::uint8_t, 16> sum;
    std::uint64_t offset;
    std::tuple<std::uint64_t, std::uint64_t> key() const {
      return {load_number<std::uint64_t>(sum.data()), load_number<std::uint64_t>(sum.data() + 8)};
    }
  };

  ChunkedOutput output_;
  Bytes directory_;
  std::vector<Place> index_;
};

}  // namespace

Result<void> write_3tz(TileSpool& spool, TileFormat format, StagedFile& file) {
  spool.sort_tiles([](const TileSpool::Tile& a, const TileSpool::Tile& b) {
    return std::tie(a.id.z, a.id.x, a.id.y) < std::tie(b.id.z, b.id.x, b.id.y);
  });
  spool.sort_files();
  ArchiveOf3tz archive(file);
  for (const TileSpool::File& one : spool.files()) {
    SCARP_TRY(const auto& bytes, spool.read(one));
    SCARP_RETURN_IF_ERROR(archive.add(one.name, bytes));
  }
  for (const TileSpool::Tile& tile : spool.tiles()) {
    SCARP_TRY(const auto& bytes, spool.read(tile));
    SCARP_RETURN_IF_ERROR(archive.add(tile_name(format, tile.id), bytes));
  }
  return archive.finish();
}

}  // namespace scarp::io
