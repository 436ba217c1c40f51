#include "io/tiles/tile_spool.h"

#include <fcntl.h>
#include <fmt/format.h>
#include <stdlib.h>
#include <unistd.h>

#include <cerrno>
#include <filesystem>

#include "io/file_reason.h"
#include "io/gzip.h"

namespace scarp::io {

Result<std::unique_ptr<TileSpool>> TileSpool::create_beside(const std::string& path) {
  const std::string folder = std::filesystem::path(path).parent_path().string();
  std::string name = (folder.empty() ? "" : folder + "/") + ".scarp-spool-XXXXXX";
  const int fd = ::mkostemp(name.data(), O_CLOEXEC);
  if (fd < 0) return fail(ErrorKind::kOutput, fmt::format("cannot write {}: {}", path, reason_of(errno)));
  ::unlink(name.c_str());
  return std::unique_ptr<TileSpool>(new TileSpool(path, fd));
}

TileSpool::~TileSpool() { ::close(fd_); }

Result<void> TileSpool::append(std::span<const std::uint8_t> bytes) {
  while (!bytes.empty()) {
    const ssize_t written = ::write(fd_, bytes.data(), bytes.size());
    if (written < 0 && errno == EINTR) continue;
    if (written < 0)
      return fail(ErrorKind::kOutput, fmt::format("cannot keep the tiles of {}: {}", path_, reason_of(errno)));
    bytes = bytes.subspan(static_cast<std::size_t>(written));
    size_ += static_cast<std::uint64_t>(written);
  }
  return {};
}

Result<void> TileSpool::add(TileId id, std::span<const std::uint8_t> bytes) {
  if (bytes.empty() || bytes.size() > UINT32_MAX)
    return fail(ErrorKind::kOutput, fmt::format("a tile of {} has {} bytes, not 1 to 4 GB", path_, bytes.size()));
  tiles_.push_back({id, static_cast<std::uint32_t>(bytes.size()), size_});
  gzip_tiles_ += is_gzip(bytes) ? 1 : 0;
  return append(bytes);
}

Result<void> TileSpool::add(const std::string& name, std::span<const std::uint8_t> bytes) {
  files_.push_back({name, size_, bytes.size()});
  return append(bytes);
}

void TileSpool::sort_files() {
  std::sort(files_.begin(), files_.end(), [](const File& a, const File& b) { return a.name < b.name; });
}

Result<std::vector<std::uint8_t>> TileSpool::read(std::uint64_t offset, std::uint64_t length) const {
  std::vector<std::uint8_t> bytes(length);
  std::uint64_t done = 0;
  while (done < length) {
    const ssize_t got = ::pread(fd_, bytes.data() + done, length - done, static_cast<off_t>(offset + done));
    if (got < 0 && errno == EINTR) continue;
    if (got <= 0)
      return fail(ErrorKind::kOutput,
                  fmt::format("cannot read the tiles kept for {}: {}", path_, reason_of(got < 0 ? errno : EIO)));
    done += static_cast<std::uint64_t>(got);
  }
  return bytes;
}

}  // namespace scarp::io
