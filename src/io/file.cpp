// Whole files, written so that a reader sees the old file or the new one and never a part of it.
//
// The bytes go to a temporary name in the same folder (so that the rename stays inside one file system), are forced to
// disk, and only then take the name asked for. Every step that can fail is checked, close() included: network file
// systems report a full disk there.

#include <fcntl.h>
#include <fmt/format.h>
#include <sys/stat.h>
#include <unistd.h>

#include <atomic>
#include <cerrno>
#include <cstdio>
#include <filesystem>
#include <memory>
#include <optional>
#include <random>
#include <system_error>
#include <utility>

#include "base/caught.h"
#include "scarp/io.h"

namespace scarp {
namespace {

constexpr std::size_t kPendingSize = 4096 + 64;  // the longest path that open() takes, and our suffix
char pending_names[kPendingOutputs][kPendingSize];
std::atomic<bool> pending_taken[kPendingOutputs];

/// Holds the name for pending_output() while it lives. The first character is set last and cleared first, so that a
/// handler that interrupts us sees a whole name or none.
class PendingName {
 public:
  explicit PendingName(const std::string& name) {
    if (name.empty() || name.size() >= kPendingSize) return;
    int place = 0;
    while (place < kPendingOutputs && pending_taken[place].exchange(true)) ++place;
    if (place == kPendingOutputs) return;
    place_ = place;
    char* held = pending_names[place];
    for (std::size_t i = 1; i <= name.size(); ++i) held[i] = name.c_str()[i];
    std::atomic_signal_fence(std::memory_order_seq_cst);
    held[0] = name[0];
  }
  PendingName(const PendingName&) = delete;
  PendingName& operator=(const PendingName&) = delete;
  ~PendingName() {
    if (place_ < 0) return;
    pending_names[place_][0] = '\0';
    std::atomic_signal_fence(std::memory_order_seq_cst);
    pending_taken[place_] = false;
  }

 private:
  int place_ = -1;
};

std::string reason(int error) {
  switch (error) {
    case ENOSPC:
      return "the disk is full";
    case EDQUOT:
      return "the disk quota is used up";
    case EFBIG:
      return "it would exceed the file-size limit";
    case EACCES:
    case EPERM:
      return "permission is denied";
    case EROFS:
      return "the file system is read-only";
    case EISDIR:
      return "it is a folder";
    case ENAMETOOLONG:
      return "the name is too long";
    default:
      return std::generic_category().message(error);
  }
}

tl::unexpected<Error> fail_writing(const std::string& path, const std::string& why) {
  return fail(ErrorKind::kOutput, fmt::format("cannot write {}: {}", path, why));
}

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
    return errno == EINVAL ? 0 : errno;  // file systems without fsync answer EINVAL
  }
  return 0;
}

/// Devices, pipes and standard output have no old content to protect and no name to take.
Result<void> write_directly(const std::string& path, int fd, std::span<const std::uint8_t> bytes) {
  if (fd < 0) return fail_writing(path, reason(errno));
  int error = write_all(fd, bytes);
  if (::close(fd) != 0 && error == 0) error = errno;
  if (error != 0) return fail_writing(path, reason(error));
  return {};
}

int take_name(const std::string& temporary, const std::string& target, bool overwrite) {
#ifdef RENAME_NOREPLACE
  if (!overwrite) {
    if (::renameat2(AT_FDCWD, temporary.c_str(), AT_FDCWD, target.c_str(), RENAME_NOREPLACE) == 0) return 0;
    if (errno != EINVAL && errno != ENOSYS) return errno;  // else: a file system that cannot refuse
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

/// Where a chain of symbolic links ends, whether something is there or not; the path itself if it is no link.
std::string follow_links(const std::string& path) {
  constexpr int kMostLinks = 40;  // as many as Linux follows
  std::filesystem::path target = path;
  for (int links = 0; links < kMostLinks; ++links) {
    std::error_code error;
    const std::filesystem::path next = std::filesystem::read_symlink(target, error);
    if (error) break;
    target = next.is_absolute() ? next : target.parent_path() / next;
  }
  return target.string();
}

/// A new, empty file in a folder, with a name that nobody else has.
class TemporaryFile {
 public:
  /// Random names, because processes in two containers that share a folder may have the same number. A name that is
  /// taken is somebody else's and is left alone.
  explicit TemporaryFile(const std::string& folder) {
    constexpr int kMostTries = 100;
    std::random_device random;
    for (int k = 0; k < kMostTries; ++k) {
      name_ = fmt::format("{}.scarp-{:08x}{:08x}.tmp", folder, random(), random());
      pending_.emplace(name_);
      fd_ = ::open(name_.c_str(), O_WRONLY | O_CREAT | O_EXCL | O_CLOEXEC, 0666);
      is_ours_ = fd_ >= 0;
      if (is_ours_) return;
      error_ = errno;
      pending_.reset();
      if (error_ != EEXIST) return;
    }
  }
  TemporaryFile(const TemporaryFile&) = delete;
  TemporaryFile& operator=(const TemporaryFile&) = delete;
  ~TemporaryFile() {
    close();
    if (is_ours_) ::unlink(name_.c_str());
  }

  const std::string& name() const { return name_; }
  int fd() const { return fd_; }
  /// Why there is none; an errno.
  int error() const { return error_; }
  /// 0 or an errno.
  int close() {
    if (fd_ < 0) return 0;
    return ::close(std::exchange(fd_, -1)) == 0 ? 0 : errno;
  }
  /// It has another name now.
  void let_go() { is_ours_ = false; }

 private:
  std::string name_;
  std::optional<PendingName> pending_;
  int fd_ = -1, error_ = 0;
  bool is_ours_ = false;
};

tl::unexpected<Error> name_is_taken(const std::string& path) {
  return fail(ErrorKind::kOutput, fmt::format("{} exists; use --overwrite to replace it", path));
}

/// A file whose bytes are on disk and wait for their name.
struct Staged {
  std::string path, target;
  std::unique_ptr<TemporaryFile> temporary;  ///< none for what is written directly
};

Result<Staged> stage(const FileBytes& file, bool overwrite) {
  const std::string& path = file.path;
  if (path.empty()) return fail(ErrorKind::kOutput, "cannot write a file without a name");
  if (path == "/dev/stdout") return Staged{path, path, nullptr};

  struct stat old {};
  const bool exists = ::stat(path.c_str(), &old) == 0;
  if (!exists && errno == ELOOP) return fail_writing(path, "its symbolic links lead in a circle");
  if (exists) {
    if (S_ISDIR(old.st_mode)) return fail_writing(path, "it is a folder; name a file in it");
    if (!S_ISREG(old.st_mode)) return Staged{path, path, nullptr};
    if (!overwrite) return name_is_taken(path);
    if (::access(path.c_str(), W_OK) != 0) return fail_writing(path, "the existing file may not be written");
  }

  const std::string target = follow_links(path);
  auto temporary = std::make_unique<TemporaryFile>(folder_of(target));
  if (temporary->fd() < 0) {
    const int why = temporary->error();
    std::error_code ignored;
    const std::filesystem::path folder = folder_of(target);
    const bool has_folder = folder.empty() || std::filesystem::is_directory(folder, ignored);
    if (!has_folder && (why == ENOENT || why == ENOTDIR))
      return fail_writing(path, "its folder does not exist; create it first");
    if (why == ENOENT) return fail_writing(path, "its folder takes no new files; choose another one");
    if (why == EACCES || why == EPERM) return fail_writing(path, "its folder may not be written");
    return fail_writing(path, reason(why));
  }
  int error = write_all(temporary->fd(), file.bytes);
  if (error == 0 && exists && ::fchmod(temporary->fd(), old.st_mode & 07777) != 0 && errno != EPERM) error = errno;
  if (error == 0) error = sync_file(temporary->fd());
  if (const int closing = temporary->close(); error == 0) error = closing;
  if (error != 0) return fail_writing(path, reason(error));
  return Staged{path, target, std::move(temporary)};
}

}  // namespace

const char* pending_output(int place) { return place >= 0 && place < kPendingOutputs ? pending_names[place] : ""; }

Result<void> write_files(std::span<const FileBytes> files, bool overwrite) {
  std::vector<Staged> staged;
  staged.reserve(files.size());
  for (const FileBytes& file : files) {
    try {
      auto next = stage(file, overwrite);
      if (!next) return tl::unexpected(std::move(next.error()));
      staged.push_back(std::move(*next));
    } catch (...) {
      return caught(ErrorKind::kOutput, "write " + file.path);
    }
  }
  for (Staged& file : staged) {
    if (!file.temporary) continue;
    const int error = take_name(file.temporary->name(), file.target, overwrite);
    if (error == EEXIST) return name_is_taken(file.path);
    if (error != 0) return fail_writing(file.path, reason(error));
    file.temporary->let_go();
  }
  for (std::size_t k = 0; k < files.size(); ++k) {
    if (staged[k].temporary) continue;
    const bool is_stdout = files[k].path == "/dev/stdout";
    const int fd = is_stdout ? ::dup(STDOUT_FILENO) : ::open(files[k].path.c_str(), O_WRONLY | O_CLOEXEC);
    if (auto written = write_directly(files[k].path, fd, files[k].bytes); !written) return written;
  }
  return {};
}

Result<void> write_file(const std::string& path, std::span<const std::uint8_t> bytes, bool overwrite) {
  const FileBytes file{path, bytes};
  return write_files({&file, 1}, overwrite);
}

Result<std::vector<std::uint8_t>> read_file(const std::string& path) {
  const auto cannot = [&](const std::string& why) {
    return fail(ErrorKind::kInput, fmt::format("cannot read {}: {}", path, why));
  };
  const int fd = ::open(path.c_str(), O_RDONLY | O_CLOEXEC);
  if (fd < 0) return cannot(errno == ENOENT ? "there is no such file" : reason(errno));
  struct Closer {
    int fd;
    ~Closer() { ::close(fd); }
  } const closer{fd};
  struct stat info {};
  if (::fstat(fd, &info) != 0) return cannot(reason(errno));
  if (S_ISDIR(info.st_mode)) return cannot("it is a folder");

  std::vector<std::uint8_t> bytes;
  try {
    // A size is a hint: pipes have none, files may grow. One byte more lets the last read() say that it is the last.
    std::size_t room = S_ISREG(info.st_mode) ? static_cast<std::size_t>(info.st_size) + 1 : 65536;
    std::size_t size = 0;
    for (;;) {
      bytes.resize(room);
      const ssize_t got = ::read(fd, bytes.data() + size, room - size);
      if (got < 0 && errno == EINTR) continue;
      if (got < 0) return cannot(reason(errno));
      if (got == 0) break;
      size += static_cast<std::size_t>(got);
      if (size == room) room *= 2;
    }
    bytes.resize(size);
  } catch (...) {
    return caught(ErrorKind::kInput, "read " + path);
  }
  return bytes;
}

}  // namespace scarp
