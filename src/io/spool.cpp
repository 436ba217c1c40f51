#include "io/spool.h"

#include <fcntl.h>
#include <fmt/format.h>
#include <sys/stat.h>
#include <unistd.h>

#include <array>
#include <cerrno>
#include <cstdlib>
#include <filesystem>
#include <map>
#include <mutex>

#include "io/file_reason.h"

namespace scarp::io {
namespace {

constexpr const char* kStandardInput = "-";

bool is_pipe(const std::string& path) {
  struct stat status {};
  return ::stat(path.c_str(), &status) == 0 && S_ISFIFO(status.st_mode);
}

/// The folder for temporary files, which may not exist.
std::string temporary_folder() {
  for (const char* const variable : {"TMPDIR", "TMP", "TEMP", "TEMPDIR"}) {
    if (const char* const folder = std::getenv(variable)) return folder;
  }
  return "/tmp";
}

/// A new unnamed file; -1 and errno on failure.
int open_nameless() {
  std::string name = (std::filesystem::path(temporary_folder()) / "scarp-XXXXXX").string();
  const int fd = ::mkostemp(name.data(), O_CLOEXEC);
  if (fd >= 0) ::unlink(name.c_str());
  return fd;
}

/// 0 or an errno.
int write_chunk(int fd, const char* bytes, std::size_t size) {
  while (size > 0) {
    const ssize_t written = ::write(fd, bytes, size);
    if (written < 0 && errno == EINTR) continue;
    if (written < 0) return errno;
    bytes += written;
    size -= static_cast<std::size_t>(written);
  }
  return 0;
}

tl::unexpected<Error> refuse_room(const std::string& what, int error) {
  return fail(ErrorKind::kOutput, fmt::format("cannot keep {} in a file in {}, the folder for temporary files: {}",
                                              what, temporary_folder(), reason_of(error)));
}

Result<std::string> copy(const std::string& path) {
  const std::string what = path == kStandardInput ? "standard input" : path;
  const int from = path == kStandardInput ? ::dup(STDIN_FILENO) : ::open(path.c_str(), O_RDONLY | O_CLOEXEC);
  if (from < 0) return fail(ErrorKind::kInput, fmt::format("cannot read {}: {}", what, reason_of(errno)));
  const int to = open_nameless();
  int error = to < 0 ? errno : 0;
  bool is_ours = true;  // the error concerns the copy, not the input
  std::array<char, 1 << 16> chunk;
  for (bool more = error == 0; more;) {
    const ssize_t got = ::read(from, chunk.data(), chunk.size());
    if (got < 0 && errno == EINTR) continue;
    is_ours = got >= 0;
    error = got < 0 ? errno : write_chunk(to, chunk.data(), static_cast<std::size_t>(got));
    more = got > 0 && error == 0;
  }
  ::close(from);
  if (error == 0) return fmt::format("/proc/self/fd/{}", to);
  if (to >= 0) ::close(to);
  if (!is_ours) return fail(ErrorKind::kInput, fmt::format("cannot read {}: {}", what, reason_of(error)));
  return refuse_room(what, error);
}

}  // namespace

Result<std::string> spool_bytes(std::span<const std::uint8_t> bytes) {
  static std::mutex mutex;
  static int file = -1;
  static std::uint64_t end = 0;
  const std::lock_guard lock(mutex);
  if (file < 0) file = open_nameless();
  if (file < 0) return refuse_room("a raster", errno);
  if (::lseek(file, static_cast<off_t>(end), SEEK_SET) < 0) return refuse_room("a raster", errno);
  if (const int error = write_chunk(file, reinterpret_cast<const char*>(bytes.data()), bytes.size()); error != 0)
    return refuse_room("a raster", error);
  const std::uint64_t begin = end;
  end += bytes.size();
  return fmt::format("/vsisubfile/{}_{},/proc/self/fd/{}", begin, bytes.size(), file);
}

Result<int> open_scratch(const std::string& what) {
  const int file = open_nameless();
  if (file < 0) return refuse_room(what, errno);
  return file;
}

Result<void> write_scratch(int file, std::uint64_t offset, std::span<const std::byte> bytes, const std::string& what) {
  while (!bytes.empty()) {
    const ssize_t written = ::pwrite(file, bytes.data(), bytes.size(), static_cast<off_t>(offset));
    if (written < 0 && errno == EINTR) continue;
    if (written < 0) return refuse_room(what, errno);
    offset += static_cast<std::uint64_t>(written);
    bytes = bytes.subspan(static_cast<std::size_t>(written));
  }
  return {};
}

Result<void> read_scratch(int file, std::uint64_t offset, std::span<std::byte> bytes, const std::string& what) {
  while (!bytes.empty()) {
    const ssize_t got = ::pread(file, bytes.data(), bytes.size(), static_cast<off_t>(offset));
    if (got < 0 && errno == EINTR) continue;
    if (got <= 0) return refuse_room(what, got == 0 ? EIO : errno);
    offset += static_cast<std::uint64_t>(got);
    bytes = bytes.subspan(static_cast<std::size_t>(got));
  }
  return {};
}

Result<std::string> readable_name(const std::string& path) {
  if (path != kStandardInput && !is_pipe(path)) return path;
  static std::mutex mutex;
  static std::map<std::string, std::string> copies;
  const std::lock_guard lock(mutex);
  const auto found = copies.find(path);
  if (found != copies.end()) return found->second;
  auto name = copy(path);
  if (name) copies.emplace(path, *name);
  return name;
}

}  // namespace scarp::io
