#include "io/staged_file.h"

#include <fcntl.h>
#include <fmt/format.h>
#include <sys/stat.h>
#include <unistd.h>

#include <array>
#include <cerrno>
#include <cstdio>
#include <ctime>
#include <filesystem>
#include <system_error>
#include <utility>

#include "io/file_reason.h"

namespace scarp::io {
namespace {

tl::unexpected<Error> fail_writing(const std::string& path, const std::string& why) {
  return fail(ErrorKind::kOutput, fmt::format("cannot write {}: {}", path, why));
}

bool is_standard_output(const std::string& path) { return path == "-" || path == "/dev/stdout"; }

/// 0 or an errno.
int write_all(int fd, std::span<const std::uint8_t> bytes) {
  std::size_t done = 0;
  while (done < bytes.size()) {
    constexpr std::size_t kChunk = std::size_t{1} << 30;
    const std::size_t size = bytes.size() - done < kChunk ? bytes.size() - done : kChunk;
    const ssize_t written = ::write(fd, bytes.data() + done, size);
    if (written < 0 && errno == EINTR) continue;
    if (written < 0) return errno;
    if (written == 0) return EIO;
    done += static_cast<std::size_t>(written);
  }
  return 0;
}

int sync_file(int fd) {
  while (::fsync(fd) != 0) {
    if (errno == EINTR) continue;
    return errno == EINVAL ? 0 : errno;  // from file systems without fsync
  }
  return 0;
}

/// Opens standard output, or the path; returns a negative errno on failure. Waits up to two seconds for a pipe's
/// reader.
int open_directly(const std::string& path) {
  if (is_standard_output(path)) return ::dup(STDOUT_FILENO);
  constexpr int kMostTries = 100;
  constexpr timespec kPause{0, 20'000'000};
  int fd = -1;
  for (int tries = 0; tries < kMostTries; ++tries) {
    fd = ::open(path.c_str(), O_WRONLY | O_CLOEXEC | O_NONBLOCK);
    if (fd >= 0 || errno != ENXIO) break;
    ::nanosleep(&kPause, nullptr);
    errno = ENXIO;
  }
  if (fd >= 0) ::fcntl(fd, F_SETFL, ::fcntl(fd, F_GETFL) & ~O_NONBLOCK);
  return fd;
}

int rename_to(const std::string& temporary, const std::string& target, bool overwrite) {
#ifdef RENAME_NOREPLACE
  if (!overwrite) {
    if (::renameat2(AT_FDCWD, temporary.c_str(), AT_FDCWD, target.c_str(), RENAME_NOREPLACE) == 0) return 0;
    if (errno != EINVAL && errno != ENOSYS) return errno;  // else: a file system without this flag
  }
#else
  (void)overwrite;
#endif
  return ::rename(temporary.c_str(), target.c_str()) == 0 ? 0 : errno;
}

std::string folder_of(const std::string& path) {
  const std::size_t slash = path.rfind('/');
  return slash == std::string::npos ? "" : path.substr(0, slash + 1);
}

/// The target of a chain of symbolic links, existing or not; the path itself if it is no link.
std::string follow_links(const std::string& path) {
  constexpr int kMostLinks = 40;  // Linux' limit
  std::filesystem::path target = path;
  for (int links = 0; links < kMostLinks; ++links) {
    std::error_code error;
    const std::filesystem::path next = std::filesystem::read_symlink(target, error);
    if (error) break;
    target = next.is_absolute() ? next : target.parent_path() / next;
  }
  return target.string();
}

tl::unexpected<Error> name_is_taken(const std::string& path) {
  return fail(ErrorKind::kOutput, fmt::format("{} exists; use --overwrite to replace it", path));
}

}  // namespace

Result<StagedFile> StagedFile::begin(const std::string& path, bool overwrite, bool by_name) {
  if (path.empty()) return fail(ErrorKind::kOutput, "cannot write a file without a name");
  StagedFile staged;
  staged.path_ = path;
  struct stat old {};
  bool is_direct = is_standard_output(path);
  if (!is_direct) {
    const bool exists = ::stat(path.c_str(), &old) == 0;
    if (!exists && errno == ELOOP) return fail_writing(path, "its symbolic links lead in a circle");
    if (exists && S_ISDIR(old.st_mode)) return fail_writing(path, "it is a folder; name a file in it");
    is_direct = exists && !S_ISREG(old.st_mode);
    if (exists && !is_direct) {
      if (!overwrite) return name_is_taken(path);
      if (::access(path.c_str(), W_OK) != 0) return fail_writing(path, "the existing file may not be written");
      staged.mode_ = old.st_mode & 07777;
    }
  }
  if (is_direct && !by_name) return staged;

  if (!is_direct) staged.target_ = follow_links(path);
  const std::string folder =
      is_direct ? std::filesystem::temp_directory_path().string() + "/" : folder_of(staged.target_);
  staged.temporary_ = std::make_unique<TemporaryFile>(folder);
  if (staged.temporary_->fd() < 0) {
    const int why = staged.temporary_->error();
    std::error_code ignored;
    const bool has_folder = folder.empty() || std::filesystem::is_directory(folder, ignored);
    if (!has_folder && (why == ENOENT || why == ENOTDIR))
      return fail_writing(path, "its folder does not exist; create it first");
    if (why == ENOENT) return fail_writing(path, "its folder takes no new files; choose another one");
    if (why == EACCES || why == EPERM) return fail_writing(path, "its folder may not be written");
    return fail_writing(path, reason_of(why));
  }
  return staged;
}

Result<void> StagedFile::write(std::span<const std::uint8_t> bytes) {
  if (const int error = write_all(temporary_->fd(), bytes); error != 0) return fail_writing(path_, reason_of(error));
  return {};
}

Result<void> StagedFile::end() {
  int error = mode_ && ::fchmod(temporary_->fd(), *mode_) != 0 && errno != EPERM ? errno : 0;
  if (error == 0) error = sync_file(temporary_->fd());
  if (const int closing = temporary_->close(); error == 0) error = closing;
  if (error != 0) return fail_writing(path_, reason_of(error));
  return {};
}

std::uint64_t StagedFile::size() const {
  std::error_code ignored;
  return std::filesystem::file_size(name(), ignored);
}

Result<void> StagedFile::take_name(bool overwrite) {
  const int error = rename_to(temporary_->name(), target_, overwrite);
  if (error == EEXIST) return name_is_taken(path_);
  if (error != 0) return fail_writing(path_, reason_of(error));
  temporary_->let_go();
  return {};
}

Result<void> StagedFile::copy_to_target() const {
  const int from = ::open(name().c_str(), O_RDONLY | O_CLOEXEC);
  if (from < 0) return fail_writing(path_, reason_of(errno));
  const int to = open_directly(path_);
  int error = to < 0 ? errno : 0;
  std::array<std::uint8_t, 1 << 16> chunk;
  while (error == 0) {
    const ssize_t got = ::read(from, chunk.data(), chunk.size());
    if (got < 0 && errno == EINTR) continue;
    if (got < 0) error = errno;
    if (got <= 0) break;
    error = write_all(to, std::span(chunk).first(static_cast<std::size_t>(got)));
  }
  ::close(from);
  if (to >= 0 && ::close(to) != 0 && error == 0) error = errno;
  if (error != 0) return fail_writing(path_, reason_of(error));
  return {};
}

Result<void> write_directly(const std::string& path, std::span<const std::uint8_t> bytes) {
  const int fd = open_directly(path);
  if (fd < 0) return fail_writing(path, reason_of(errno));
  int error = write_all(fd, bytes);
  if (::close(fd) != 0 && error == 0) error = errno;
  if (error != 0) return fail_writing(path, reason_of(error));
  return {};
}

}  // namespace scarp::io
