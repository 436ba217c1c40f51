// Blocks on the disk, between the processes that make them and the one that joins them.
//
// A file: "SCARPTIL", version, key; then records: their payload's length and CRC-32, and the payload. All numbers are
// little-endian.
#include <fcntl.h>
#include <fmt/format.h>
#include <unistd.h>
#include <zlib.h>

#include <algorithm>
#include <bit>
#include <cerrno>
#include <cstring>
#include <filesystem>
#include <map>
#include <optional>
#include <tuple>
#include <utility>

#include "io/file_reason.h"
#include "io/tiles/byte_source.h"
#include "io/tiles/part_writer.h"

namespace scarp {
namespace {

namespace fs = std::filesystem;

constexpr char kPartMark[] = "SCARPTIL";
constexpr std::uint64_t kPartVersion = 2;
constexpr std::uint64_t kFileHead = 24, kRecordHead = 16, kBlockName = 12;

static_assert(std::endian::native == std::endian::little);

class Packer {
 public:
  template <class T>
  void add(const T& value) {
    const auto* bytes = reinterpret_cast<const std::uint8_t*>(&value);
    bytes_.insert(bytes_.end(), bytes, bytes + sizeof value);
  }
  void add_bytes(std::span<const std::uint8_t> bytes) {
    add(std::uint64_t{bytes.size()});
    bytes_.insert(bytes_.end(), bytes.begin(), bytes.end());
  }
  std::vector<std::uint8_t> take() { return std::move(bytes_); }

 private:
  std::vector<std::uint8_t> bytes_;
};

class Unpacker {
 public:
  explicit Unpacker(std::span<const std::uint8_t> bytes) : bytes_(bytes) {}
  bool failed() const { return failed_; }
  template <class T>
  T take() {
    T value{};
    if (bytes_.size() < sizeof value) {
      failed_ = true;
      return value;
    }
    std::memcpy(&value, bytes_.data(), sizeof value);
    bytes_ = bytes_.subspan(sizeof value);
    return value;
  }
  std::span<const std::uint8_t> take_bytes() {
    const auto size = take<std::uint64_t>();
    if (size > bytes_.size()) {
      failed_ = true;
      return {};
    }
    const auto taken = bytes_.first(size);
    bytes_ = bytes_.subspan(size);
    return taken;
  }

 private:
  std::span<const std::uint8_t> bytes_;
  bool failed_ = false;
};

void add_id(Packer& packer, TileId id) {
  packer.add(static_cast<std::uint32_t>(id.z));
  packer.add(id.x);
  packer.add(id.y);
}

TileId take_id(Unpacker& unpacker) {
  TileId id;
  id.z = static_cast<int>(unpacker.take<std::uint32_t>());
  id.x = unpacker.take<std::uint32_t>();
  id.y = unpacker.take<std::uint32_t>();
  return id;
}

std::uint64_t crc_of(std::span<const std::uint8_t> bytes) { return crc32_z(0, bytes.data(), bytes.size()); }

std::vector<std::uint8_t> pack(const BlockReport& block, const std::vector<PackedTile>& tiles) {
  Packer packer;
  add_id(packer, block.block);
  packer.add(std::uint64_t{block.report.has_heights});
  packer.add(std::uint64_t{block.report.levels.size()});
  for (const LevelSummary& level : block.report.levels) {
    for (const std::uint64_t count : {level.tiles, level.triangles, level.bytes, level.over}) packer.add(count);
    packer.add(level.node_error);
    packer.add(level.bound);
    packer.add(level.source_error);
  }
  packer.add_bytes(block.reduced);
  packer.add(std::uint64_t{tiles.size()});
  for (const PackedTile& tile : tiles) {
    add_id(packer, tile.id);
    packer.add_bytes(tile.bytes);
  }
  return packer.take();
}

Error cannot_write(const std::string& path, int reason) {
  return {ErrorKind::kOutput, fmt::format("cannot write {}: {}", path, reason_of(reason))};
}

}  // namespace

struct TileParts::Impl {
  struct Place {
    std::size_t file = 0;
    std::uint64_t offset = 0, length = 0, crc = 0;
  };
  std::vector<std::unique_ptr<ByteSource>> files;
  std::map<std::tuple<int, std::uint32_t, std::uint32_t>, Place> blocks;

  const Place* find(TileId id) const {
    const auto found = blocks.find({id.z, id.x, id.y});
    return found == blocks.end() ? nullptr : &found->second;
  }

  /// Of a record that was cut off nothing is known, nor of what may follow it.
  Result<void> add(std::unique_ptr<ByteSource> source, std::uint64_t key) {
    if (source->size() < kFileHead) return {};
    const auto head = source->read(0, kFileHead);
    if (!head) return tl::unexpected(head.error());
    if (std::memcmp(head->data(), kPartMark, 8) != 0)
      return fail(ErrorKind::kInput, fmt::format("{} is no part of a set of tiles: take it away", source->path()));
    Unpacker unpacker{std::span<const std::uint8_t>(*head).subspan(8)};
    const auto version = unpacker.take<std::uint64_t>(), theirs = unpacker.take<std::uint64_t>();
    if (version != kPartVersion || theirs != key)
      return fail(ErrorKind::kInput,
                  fmt::format("{} belongs to another plan: delete it, or give another --parts", source->path()));
    for (std::uint64_t at = kFileHead; source->has(at, kRecordHead + kBlockName);) {
      const auto record = source->read(at, kRecordHead + kBlockName);
      if (!record) return tl::unexpected(record.error());
      Unpacker facts(*record);
      const auto length = facts.take<std::uint64_t>(), crc = facts.take<std::uint64_t>();
      if (!source->has(at + kRecordHead, length)) break;
      const TileId id = take_id(facts);
      blocks.insert({{id.z, id.x, id.y}, Place{files.size(), at + kRecordHead, length, crc}});
      at += kRecordHead + length;
    }
    files.push_back(std::move(source));
    return {};
  }
};

TileParts::TileParts(std::unique_ptr<Impl> impl) : impl_(std::move(impl)) {}

TileParts::~TileParts() = default;

Result<std::unique_ptr<TileParts>> TileParts::open(const std::string& folder, std::uint64_t key) {
  auto impl = std::make_unique<Impl>();
  std::error_code error;
  std::vector<std::string> names;
  if (fs::exists(folder, error)) {
    for (const auto& entry : fs::directory_iterator(folder, error)) {
      if (entry.path().extension() == ".part") names.push_back(entry.path().string());
    }
    if (error) return fail(ErrorKind::kInput, fmt::format("cannot read {}: {}", folder, error.message()));
  }
  std::sort(names.begin(), names.end());
  for (const std::string& name : names) {
    auto source = ByteSource::open(name);
    if (!source) return tl::unexpected(source.error());
    if (auto added = impl->add(std::move(*source), key); !added) return tl::unexpected(added.error());
  }
  return std::unique_ptr<TileParts>(new TileParts(std::move(impl)));
}

bool TileParts::has(TileId block) const { return impl_->find(block) != nullptr; }

std::size_t TileParts::count() const { return impl_->blocks.size(); }

Result<BlockReport> TileParts::read(
    TileId block, const std::function<Result<void>(TileId, std::span<const std::uint8_t>)>& put) const {
  const Impl::Place* const place = impl_->find(block);
  if (place == nullptr) return fail(ErrorKind::kInput, "a block is not there");
  const ByteSource& source = *impl_->files[place->file];
  const auto bytes = source.read(place->offset, place->length);
  if (!bytes) return tl::unexpected(bytes.error());
  const auto is_damaged = [&] {
    return fail(ErrorKind::kInput,
                fmt::format("{} is damaged: delete it, and make its blocks again with scarp tile run", source.path()));
  };
  if (crc_of(*bytes) != place->crc) return is_damaged();
  Unpacker unpacker(*bytes);
  BlockReport made;
  made.block = take_id(unpacker);
  made.report.has_heights = unpacker.take<std::uint64_t>() != 0;
  const auto levels = unpacker.take<std::uint64_t>();
  if (levels > kMaxTileLevel + 1) return is_damaged();
  for (std::uint64_t z = 0; z < levels; ++z) {
    LevelSummary level;
    for (std::uint64_t* count : {&level.tiles, &level.triangles, &level.bytes, &level.over})
      *count = unpacker.take<std::uint64_t>();
    level.node_error = unpacker.take<double>();
    level.bound = unpacker.take<double>();
    level.source_error = unpacker.take<double>();
    made.report.levels.push_back(level);
  }
  made.report.tiles.resize(levels);
  const auto reduced = unpacker.take_bytes();
  made.reduced.assign(reduced.begin(), reduced.end());
  const auto tiles = unpacker.take<std::uint64_t>();
  for (std::uint64_t k = 0; k < tiles && !unpacker.failed(); ++k) {
    const TileId id = take_id(unpacker);
    const auto tile = unpacker.take_bytes();
    if (unpacker.failed() || id.z < 0 || static_cast<std::uint64_t>(id.z) >= levels) return is_damaged();
    made.report.tiles[static_cast<std::size_t>(id.z)].push_back(std::uint64_t{id.y} << 32 | id.x);
    if (auto kept = put(id, tile); !kept) return tl::unexpected(kept.error());
  }
  if (unpacker.failed()) return is_damaged();
  for (auto& level : made.report.tiles) std::sort(level.begin(), level.end());
  return made;
}

PartWriter::~PartWriter() {
  if (fd_ >= 0) close(fd_);
  if (blocks_ == 0) unlink(path_.c_str());
}

Result<std::unique_ptr<PartWriter>> PartWriter::create(const std::string& folder, Shard shard, std::uint64_t key) {
  std::error_code error;
  fs::create_directories(folder, error);
  if (error) return fail(ErrorKind::kOutput, fmt::format("cannot make {}: {}", folder, error.message()));
  // A name of its own for each run, since another process may still write to the one before.
  for (int run = 1;; ++run) {
    const std::string path =
        (fs::path(folder) / fmt::format("{:04}-of-{:04}.{:03}.part", shard.number, shard.of, run)).string();
    const int fd = ::open(path.c_str(), O_WRONLY | O_CREAT | O_EXCL | O_CLOEXEC, 0644);
    if (fd < 0 && errno == EEXIST) continue;
    if (fd < 0) return tl::unexpected(cannot_write(path, errno));
    auto writer = std::unique_ptr<PartWriter>(new PartWriter(path, fd));
    Packer head;
    for (const char letter : std::string_view(kPartMark)) head.add(letter);
    head.add(kPartVersion);
    head.add(key);
    if (auto written = writer->append(head.take()); !written) return tl::unexpected(written.error());
    return writer;
  }
}

Result<void> PartWriter::add(const BlockReport& block, const std::vector<PackedTile>& tiles) {
  const std::vector<std::uint8_t> payload = pack(block, tiles);
  Packer head;
  head.add(std::uint64_t{payload.size()});
  head.add(crc_of(payload));
  std::vector<std::uint8_t> record = head.take();
  record.insert(record.end(), payload.begin(), payload.end());
  ++blocks_;
  if (auto written = append(record); !written) return written;
  if (fdatasync(fd_) != 0 && errno != EINVAL) return tl::unexpected(cannot_write(path_, errno));
  return {};
}

Result<void> PartWriter::append(std::span<const std::uint8_t> bytes) {
  while (!bytes.empty()) {
    const ssize_t count = ::write(fd_, bytes.data(), bytes.size());
    if (count < 0 && errno == EINTR) continue;
    if (count < 0) return tl::unexpected(cannot_write(path_, errno));
    bytes = bytes.subspan(static_cast<std::size_t>(count));
  }
  return {};
}

}  // namespace scarp
