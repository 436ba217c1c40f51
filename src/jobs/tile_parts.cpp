// Stores blocks on disk, from the processes that build them to the process that joins them.
//
// File format: "SCARPTIL", version, key of the settings; then records, each with the payload's length, CRC-32 and the
// payload. The payload begins with the block's name, the key of the sources, and the hash of the block's nodes. A
// payload that ends there confirms that another record's block with the same nodes is also valid for these sources. All
// numbers are little-endian.
#include <fcntl.h>
#include <fmt/format.h>
#include <sys/file.h>
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
#include "jobs/part_writer.h"

namespace scarp {
namespace {

namespace fs = std::filesystem;

constexpr char kPartMark[] = "SCARPTIL";
constexpr std::uint64_t kPartVersion = 5;
constexpr std::uint64_t kFileHead = 24, kRecordHead = 16, kBlockHead = 28;

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

Packer pack_head(TileId block, std::uint64_t sources, std::uint64_t nodes) {
  Packer packer;
  add_id(packer, block);
  packer.add(sources);
  packer.add(nodes);
  return packer;
}

std::vector<std::uint8_t> pack(const BlockReport& block, std::uint64_t sources,
                               const std::vector<jobs::PackedTile>& tiles) {
  Packer packer = pack_head(block.block, sources, block.hash);
  packer.add(block.core_seconds);
  packer.add(block.memory);
  packer.add(std::uint64_t{block.report.has_heights});
  packer.add(std::uint64_t{block.report.levels.size()});
  for (const LevelSummary& level : block.report.levels) {
    for (const std::uint64_t count :
         {level.tiles, level.triangles, level.bytes, level.over, level.coarser, level.oversized, level.lines_left_out})
      packer.add(count);
    packer.add(level.node_error);
    packer.add(level.bound);
    packer.add(level.source_error);
  }
  packer.add_bytes(block.reduced);
  packer.add(std::uint64_t{tiles.size()});
  for (const jobs::PackedTile& tile : tiles) {
    add_id(packer, tile.id);
    packer.add_bytes(tile.bytes);
  }
  return packer.take();
}

/// True if a process is writing to the file.
bool is_locked(const std::string& path) {
  const int fd = ::open(path.c_str(), O_RDONLY | O_CLOEXEC);
  if (fd < 0) return false;
  const bool is_free = ::flock(fd, LOCK_SH | LOCK_NB) == 0 || errno != EWOULDBLOCK;
  close(fd);
  return !is_free;
}

Error cannot_write(const std::string& path, int reason) {
  return {ErrorKind::kOutput, fmt::format("cannot write {}: {}", path, io::reason_of(reason))};
}

}  // namespace

struct TileParts::Impl {
  struct Place {
    std::size_t file = 0;
    std::uint64_t offset = 0, length = 0, crc = 0;
  };
  struct File {
    std::unique_ptr<io::ByteSource> source;
    std::uint64_t looked_at = 0;  ///< records up to here are known
  };
  using Block = std::tuple<int, std::uint32_t, std::uint32_t>;

  std::string folder;
  std::uint64_t settings = 0, sources = 0;
  std::map<std::string, std::size_t> names;
  std::vector<File> files;
  std::map<Block, std::map<std::uint64_t, Place>> blocks;  ///< by the hash of nodes
  std::map<Block, std::uint64_t> current;                  ///< hashes of the blocks' nodes in the job's sources

  static Block name_of(TileId id) { return {id.z, id.x, id.y}; }

  const Place* find(TileId id) const {
    const auto nodes = current.find(name_of(id));
    return nodes == current.end() ? nullptr : find(id, nodes->second);
  }
  const Place* find(TileId id, std::uint64_t nodes) const {
    const auto block = blocks.find(name_of(id));
    if (block == blocks.end()) return nullptr;
    const auto found = block->second.find(nodes);
    return found == block->second.end() ? nullptr : &found->second;
  }

  Result<void> look_at(const std::string& name) {
    SCARP_TRY(auto&& source, io::ByteSource::open(name));
    const auto [known, is_new] = names.insert({name, files.size()});
    if (is_new) files.emplace_back();
    File& file = files[known->second];
    if (file.source && source->size() <= file.looked_at) return {};
    file.source = std::move(source);
    return add(known->second);
  }

  /// Ignores a truncated record and all that follow it.
  Result<void> add(std::size_t number) {
    File& file = files[number];
    const io::ByteSource& source = *file.source;
    if (source.size() < kFileHead) return {};
    if (file.looked_at == 0) {
      SCARP_TRY(const auto& head, source.read(0, kFileHead));
      if (std::memcmp(head.data(), kPartMark, 8) != 0)
        return fail(ErrorKind::kInput, fmt::format("{} is no part of a set of tiles: take it away", source.path()));
      Unpacker unpacker{std::span<const std::uint8_t>(head).subspan(8)};
      const auto version = unpacker.take<std::uint64_t>(), theirs = unpacker.take<std::uint64_t>();
      if (version != kPartVersion)
        return fail(ErrorKind::kInput, fmt::format("{} was made by another version of scarp: delete it, or give "
                                                   "another --parts",
                                                   source.path()));
      if (theirs != settings)
        return fail(ErrorKind::kInput,
                    fmt::format("{} belongs to another plan: delete it, or give another --parts", source.path()));
      file.looked_at = kFileHead;
    }
    while (source.has(file.looked_at, kRecordHead + kBlockHead)) {
      SCARP_TRY(const auto& record, source.read(file.looked_at, kRecordHead + kBlockHead));
      Unpacker facts(record);
      const auto length = facts.take<std::uint64_t>(), crc = facts.take<std::uint64_t>();
      if (length < kBlockHead || !source.has(file.looked_at + kRecordHead, length)) break;
      const Block block = name_of(take_id(facts));
      const auto of_sources = facts.take<std::uint64_t>(), nodes = facts.take<std::uint64_t>();
      if (length == kBlockHead && crc != crc_of(std::span<const std::uint8_t>(record).subspan(kRecordHead))) break;
      if (length > kBlockHead) blocks[block].insert({nodes, {number, file.looked_at + kRecordHead, length, crc}});
      if (of_sources == sources) current[block] = nodes;
      file.looked_at += kRecordHead + length;
    }
    return {};
  }

  /// Reads all parts whose names have this prefix.
  Result<void> look(const std::string& beginning) {
    std::error_code error;
    if (!fs::exists(folder, error)) return {};
    std::vector<std::string> paths;
    for (const auto& entry : fs::directory_iterator(folder, error)) {
      if (entry.path().extension() == ".part" && entry.path().filename().string().starts_with(beginning))
        paths.push_back(entry.path().string());
    }
    if (error) return fail(ErrorKind::kInput, fmt::format("cannot read {}: {}", folder, error.message()));
    std::sort(paths.begin(), paths.end());
    for (const std::string& path : paths) {
      SCARP_RETURN_IF_ERROR(look_at(path));
    }
    return {};
  }
};

TileParts::TileParts(std::unique_ptr<Impl> impl) : impl_(std::move(impl)) {}

TileParts::~TileParts() = default;

Result<std::unique_ptr<TileParts>> TileParts::open(const std::string& folder, const TileJob& job) {
  auto impl = std::make_unique<Impl>();
  impl->folder = folder;
  impl->settings = settings_key_of(job);
  impl->sources = sources_key_of(job);
  SCARP_RETURN_IF_ERROR(impl->look(""));
  return std::unique_ptr<TileParts>(new TileParts(std::move(impl)));
}

bool TileParts::has(TileId block) const { return impl_->find(block) != nullptr; }

bool TileParts::has_any(TileId block) const { return impl_->blocks.count(Impl::name_of(block)) > 0; }

bool TileParts::has_nodes(TileId block, std::uint64_t nodes) const { return impl_->find(block, nodes) != nullptr; }

Result<void> TileParts::look_again(Shard shard) { return impl_->look(PartWriter::name_of(shard)); }

Result<BlockReport> TileParts::read(
    TileId block, const std::function<Result<void>(TileId, std::span<const std::uint8_t>)>& put) const {
  const Impl::Place* const place = impl_->find(block);
  if (place == nullptr) return fail(ErrorKind::kInput, "a block is not there");
  const io::ByteSource& source = *impl_->files[place->file].source;
  SCARP_TRY(const auto& bytes, source.read(place->offset, place->length));
  const auto is_damaged = [&] {
    return fail(
        ErrorKind::kInput,
        fmt::format("{} is damaged: delete it, and make its blocks again (scarp tile run PLAN)", source.path()));
  };
  if (crc_of(bytes) != place->crc) return is_damaged();
  Unpacker unpacker(bytes);
  BlockReport made;
  made.block = take_id(unpacker);
  unpacker.take<std::uint64_t>();
  made.hash = unpacker.take<std::uint64_t>();
  made.core_seconds = unpacker.take<double>();
  made.memory = unpacker.take<std::uint64_t>();
  made.report.has_heights = unpacker.take<std::uint64_t>() != 0;
  const auto levels = unpacker.take<std::uint64_t>();
  if (levels > kMaxTileLevel + 1) return is_damaged();
  for (std::uint64_t z = 0; z < levels; ++z) {
    LevelSummary level;
    for (std::uint64_t* count : {&level.tiles, &level.triangles, &level.bytes, &level.over, &level.coarser,
                                 &level.oversized, &level.lines_left_out})
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
    SCARP_RETURN_IF_ERROR(put(id, tile));
  }
  if (unpacker.failed()) return is_damaged();
  for (auto& level : made.report.tiles) std::sort(level.begin(), level.end());
  return made;
}

PartWriter::~PartWriter() {
  if (fd_ >= 0) close(fd_);
  if (records_ == 0) unlink(path_.c_str());
}

std::string PartWriter::name_of(Shard shard) { return fmt::format("{:04}-of-{:04}.", shard.number, shard.of); }

Result<std::unique_ptr<PartWriter>> PartWriter::create(const std::string& folder, Shard shard, const TileJob& job) {
  std::error_code error;
  fs::create_directories(folder, error);
  if (error) return fail(ErrorKind::kOutput, fmt::format("cannot make {}: {}", folder, error.message()));
  // A unique name for each run, since another process may still write to an earlier part.
  bool has_company = false;
  for (int run = 1;; ++run) {
    const std::string path = (fs::path(folder) / fmt::format("{}{:03}.part", name_of(shard), run)).string();
    const int fd = ::open(path.c_str(), O_WRONLY | O_CREAT | O_EXCL | O_CLOEXEC, 0644);
    if (fd < 0 && errno == EEXIST) {
      has_company |= is_locked(path);
      continue;
    }
    if (fd < 0) return tl::unexpected(cannot_write(path, errno));
    // The system releases the lock with the process. Without locks, other processes are not noticed.
    ::flock(fd, LOCK_EX | LOCK_NB);
    auto writer = std::unique_ptr<PartWriter>(new PartWriter(path, fd));
    writer->has_company_ = has_company;
    writer->sources_ = sources_key_of(job);
    Packer head;
    for (const char letter : std::string_view(kPartMark)) head.add(letter);
    head.add(kPartVersion);
    head.add(settings_key_of(job));
    SCARP_RETURN_IF_ERROR(writer->append(head.take()));
    return writer;
  }
}

Result<void> PartWriter::add(const BlockReport& block, const std::vector<jobs::PackedTile>& tiles) {
  return add_record(pack(block, sources_, tiles));
}

Result<void> PartWriter::confirm(TileId block, std::uint64_t nodes) {
  return add_record(pack_head(block, sources_, nodes).take());
}

Result<void> PartWriter::add_record(std::span<const std::uint8_t> payload) {
  Packer head;
  head.add(std::uint64_t{payload.size()});
  head.add(crc_of(payload));
  std::vector<std::uint8_t> record = head.take();
  record.insert(record.end(), payload.begin(), payload.end());
  SCARP_RETURN_IF_ERROR(append(record));
  if (fdatasync(fd_) != 0 && errno != EINVAL) return tl::unexpected(cannot_write(path_, errno));
  ++records_;
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
