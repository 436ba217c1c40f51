#include "io/tiles/staged_folder.h"

#include <fcntl.h>
#include <fmt/format.h>
#include <stdlib.h>
#include <sys/file.h>
#include <sys/stat.h>
#include <unistd.h>

#include <array>
#include <cerrno>
#include <cstddef>
#include <functional>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

#include "io/file_reason.h"

namespace scarp::io {
namespace {

namespace fs = std::filesystem;

constexpr std::string_view kRandomEnd = "XXXXXX", kOldEnd = ".old";

/// The common prefix of all folders created on this machine for a set of that name.
std::string beginning_for(const fs::path& target) {
  std::array<char, 256> machine{};
  ::gethostname(machine.data(), machine.size() - 1);
  const std::size_t hash = std::hash<std::string>{}(target.filename().string() + '/' + machine.data());
  return fmt::format(".scarp-tiles-{:016x}-", hash);
}

struct FolderLock {
  int fd = -1;            ///< -1: another process's folder, or no locks in the file system
  bool is_other = false;  ///< another process has locked or deleted the folder
};

FolderLock lock_folder(const fs::path& folder) {
  const int fd = ::open(folder.c_str(), O_RDONLY | O_DIRECTORY | O_NOFOLLOW | O_CLOEXEC);
  if (fd < 0) return {-1, errno == ENOENT};
  struct stat held {
  }, named{};
  const bool is_locked = ::flock(fd, LOCK_EX | LOCK_NB) == 0;
  bool is_other = !is_locked && errno == EWOULDBLOCK;
  // The folder may have been deleted before it was locked.
  if (is_locked)
    is_other = ::fstat(fd, &held) != 0 || ::lstat(folder.c_str(), &named) != 0 || held.st_ino != named.st_ino ||
               held.st_dev != named.st_dev;
  if (is_locked && !is_other) return {fd, false};
  ::close(fd);
  return {-1, is_other};
}

void remove_left(const fs::path& beside, const fs::path& target, const std::string& beginning) {
  std::vector<fs::path> folders, old;
  std::error_code error;
  for (auto at = fs::directory_iterator(beside, error); !error && at != fs::directory_iterator(); at.increment(error)) {
    const std::string name = at->path().filename().string();
    if (!name.starts_with(beginning)) continue;
    const std::size_t length = name.size() - beginning.size();
    if (length == kRandomEnd.size()) folders.push_back(at->path());
    if (length == kRandomEnd.size() + kOldEnd.size() && name.ends_with(kOldEnd)) old.push_back(at->path());
  }
  for (const fs::path& folder : folders) {
    const FolderLock lock = lock_folder(folder);
    if (lock.fd < 0) continue;
    fs::remove_all(folder, error);
    ::close(lock.fd);
  }
  // Until the new set is renamed, the moved old set is the only one.
  if (!old.empty() && fs::exists(target, error)) {
    for (const fs::path& folder : old) fs::remove_all(folder, error);
  }
}

}  // namespace

Result<StagedFolder> StagedFolder::create_beside(const fs::path& target) {
  std::error_code error;
  const fs::path beside = fs::absolute(target, error).parent_path();
  const std::string beginning = beginning_for(target);
  remove_left(beside, target, beginning);
  for (;;) {
    std::string name = (beside / beginning).string() + std::string(kRandomEnd);
    if (::mkdtemp(name.data()) == nullptr)
      return fail(ErrorKind::kOutput,
                  fmt::format("no folder can be made in {}: {}", beside.string(), reason_of(errno)));
    // Cleanup by another process may happen between creating the folder and locking it.
    const FolderLock lock = lock_folder(name);
    if (lock.is_other) continue;
    fs::permissions(name, fs::perms(0755), error);
    return StagedFolder(name, lock.fd);
  }
}

StagedFolder::StagedFolder(StagedFolder&& other) noexcept
    : path_(std::exchange(other.path_, {})), lock_(std::exchange(other.lock_, -1)) {}

StagedFolder::~StagedFolder() {
  std::error_code ignored;
  if (!path_.empty()) fs::remove_all(path_, ignored);
  if (lock_ >= 0) ::close(lock_);
}

fs::path StagedFolder::path_of_old() const {
  fs::path old = path_;
  old += kOldEnd;
  return old;
}

}  // namespace scarp::io
