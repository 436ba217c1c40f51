#include "serve/served_set.h"

#include <fcntl.h>
#include <fmt/format.h>
#include <sys/stat.h>
#include <unistd.h>

#include <cerrno>
#include <filesystem>
#include <utility>

namespace scarp::cli {
namespace {

FileStamp describe_status(const struct stat& status) {
  return {static_cast<std::uint64_t>(status.st_size), fmt::format("{:x}-{:x}-{:x}-{:x}", status.st_size, status.st_ino,
                                                                  status.st_mtim.tv_sec, status.st_mtim.tv_nsec)};
}

/// A text that changes when another set replaces this one, or when its layer.json or tileset.json is rewritten.
std::string stamp_of_set(const std::string& path) {
  std::string stamp = stamp_of(path).text;
  for (const char* const name : {"/layer.json", "/tileset.json"}) stamp += "," + stamp_of(path + name).text;
  return stamp;
}

Result<std::shared_ptr<const OpenedSet>> open_once(const std::string& path, const std::string& stamp) {
  auto opened = std::make_shared<OpenedSet>();
  std::error_code error;
  opened->stamp = stamp;
  if (!std::filesystem::is_directory(path, error)) {
    const int fd = ::open(path.c_str(), O_RDONLY | O_CLOEXEC | O_NONBLOCK);
    if (fd >= 0) opened->file = std::make_shared<OpenFile>(fd);
  }
  SCARP_TRY(opened->reader, open_tile_set(path));
  return opened;
}

/// Opens a set. Retries until the reader and the file belong to the same set.
Result<std::shared_ptr<const OpenedSet>> open_whole(const std::string& path) {
  constexpr int kMostTries = 5;
  for (int k = 1;; ++k) {
    const std::string stamp = stamp_of_set(path);
    auto opened = open_once(path, stamp);
    if (k == kMostTries || stamp_of_set(path) == stamp) return opened;
  }
}

/// Opens a folder. Retries, since a set is briefly missing while another replaces it.
int open_folder(const std::string& path) {
  constexpr int kMostTries = 50;
  constexpr useconds_t kNap = 1000;
  for (int k = 0;; ++k) {
    const int fd = ::open(path.c_str(), O_RDONLY | O_DIRECTORY | O_CLOEXEC);
    if (fd >= 0 || errno != ENOENT || k == kMostTries) return fd;
    ::usleep(kNap);
  }
}

}  // namespace

const std::vector<std::uint8_t>& OpenedSet::page(const std::function<std::vector<std::uint8_t>()>& make) const {
  std::call_once(page_once_, [&] { page_ = make(); });
  return page_;
}

Result<std::unique_ptr<ServedSet>> ServedSet::open(const std::string& path) {
  SCARP_TRY(auto&& opened, open_whole(path));
  std::unique_ptr<ServedSet> set(new ServedSet);
  set->path_ = path;
  set->opened_ = std::move(opened);
  return set;
}

ServedSet::ServedSet(std::shared_ptr<const TileSetReader> reader) {
  auto opened = std::make_shared<OpenedSet>();
  opened->reader = std::move(reader);
  opened_ = std::move(opened);
}

std::shared_ptr<const OpenedSet> ServedSet::now() const {
  const std::lock_guard lock(mutex_);
  if (path_.empty()) return opened_;
  std::string stamp = stamp_of_set(path_);
  if (stamp == opened_->stamp || stamp == stamp_tried_ || stamp_of(path_).text.empty()) return opened_;
  stamp_tried_ = std::move(stamp);
  // Only a complete set replaces the old one.
  if (auto opened = open_whole(path_)) opened_ = std::move(*opened);
  return opened_;
}

FileStamp stamp_of(const std::string& path) {
  struct stat status {};
  return ::stat(path.c_str(), &status) == 0 ? describe_status(status) : FileStamp();
}

FileStamp stamp_of(const OpenFile& file) {
  struct stat status {};
  return ::fstat(file.fd(), &status) == 0 ? describe_status(status) : FileStamp();
}

std::shared_ptr<const OpenFile> open_in_folder(const std::string& folder, std::string_view name) {
  int fd = open_folder(folder);
  while (fd >= 0) {
    const bool is_last = name.find('/') == std::string_view::npos;
    const std::string part(take_until(name, '/'));
    const bool is_plain = !part.empty() && part.front() != '.';
    const int flags = O_RDONLY | O_CLOEXEC | O_NOFOLLOW | O_NONBLOCK | (is_last ? 0 : O_DIRECTORY);
    const int next = is_plain ? ::openat(fd, part.c_str(), flags) : -1;
    ::close(fd);
    fd = next;
    if (fd < 0 || !is_last) continue;
    auto file = std::make_shared<OpenFile>(fd);
    struct stat status {};
    return ::fstat(fd, &status) == 0 && S_ISREG(status.st_mode) ? file : nullptr;
  }
  return nullptr;
}

Result<std::vector<std::uint8_t>> read_all(const OpenFile& file) {
  std::vector<std::uint8_t> bytes(stamp_of(file).size);
  std::size_t read = 0;
  while (read < bytes.size()) {
    const ssize_t got = ::pread(file.fd(), bytes.data() + read, bytes.size() - read, static_cast<off_t>(read));
    if (got <= 0) return fail(ErrorKind::kInput, "the file became shorter, or cannot be read");
    read += static_cast<std::size_t>(got);
  }
  return bytes;
}

}  // namespace scarp::cli
