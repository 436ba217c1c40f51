#include "io/tiles/byte_source.h"

#include <fcntl.h>
#include <fmt/format.h>
#include <sys/stat.h>
#include <unistd.h>

#include <algorithm>
#include <cerrno>

#include "io/file_reason.h"

namespace scarp::io {

Result<std::unique_ptr<ByteSource>> ByteSource::open(const std::string& path) {
  const auto refuse = [&](const std::string& why) {
    return fail(ErrorKind::kInput, fmt::format("cannot read {}: {}", path, why));
  };
  // Without O_NONBLOCK, open() would wait for a pipe's writer.
  const int fd = ::open(path.c_str(), O_RDONLY | O_CLOEXEC | O_NONBLOCK);
  if (fd < 0) return refuse(reason_of(errno));
  struct stat status {};
  const int error = ::fstat(fd, &status) != 0 ? errno : 0;
  if (error != 0 || !S_ISREG(status.st_mode)) {
    ::close(fd);
    return refuse(error != 0 ? reason_of(error) : "it is no regular file");
  }
  return std::unique_ptr<ByteSource>(new ByteSource(path, fd, static_cast<std::uint64_t>(status.st_size)));
}

ByteSource::~ByteSource() { ::close(fd_); }

Result<std::vector<std::uint8_t>> ByteSource::read(std::uint64_t offset, std::uint64_t length) const {
  if (!has(offset, length)) return fail(ErrorKind::kInput, fmt::format("{} was cut off", path_));
  std::vector<std::uint8_t> bytes(length);
  std::uint64_t done = 0;
  while (done < length) {
    constexpr std::uint64_t kMostAtOnce = std::uint64_t{1} << 30;
    const ssize_t got =
        ::pread(fd_, bytes.data() + done, std::min(length - done, kMostAtOnce), static_cast<off_t>(offset + done));
    if (got < 0 && errno == EINTR) continue;
    if (got < 0) return fail(ErrorKind::kInput, fmt::format("cannot read {}: {}", path_, reason_of(errno)));
    if (got == 0) return fail(ErrorKind::kInput, fmt::format("{} was cut off while it was read", path_));
    done += static_cast<std::uint64_t>(got);
  }
  return bytes;
}

}  // namespace scarp::io
