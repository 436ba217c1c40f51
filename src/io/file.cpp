// Reads and writes whole files. A reader sees the old file or the new one, and never a part of it.
//
// The bytes are written to a temporary name in the same folder (so that the rename stays inside one file system) and
// forced to disk before the rename. Every step that can fail is checked, including close(): network file systems report
// a full disk there.

#include <fcntl.h>
#include <fmt/format.h>
#include <sys/stat.h>
#include <unistd.h>

#include <algorithm>
#include <cerrno>
#include <system_error>
#include <utility>

#include "base/caught.h"
#include "io/file_reason.h"
#include "io/missing_file.h"
#include "io/raster/raster_file.h"
#include "io/spool.h"
#include "io/staged_file.h"
#include "scarp/io.h"

namespace scarp {
namespace {

Result<io::StagedFile> stage(const FileBytes& file, bool overwrite) {
  auto staged = io::StagedFile::begin(file.path, overwrite, false);
  if (!staged || staged->is_direct()) return staged;
  SCARP_RETURN_IF_ERROR(staged->write(file.bytes));
  SCARP_RETURN_IF_ERROR(staged->end());
  return staged;
}

Result<void> take_names(std::span<io::StagedFile* const> staged, bool overwrite) {
  if (std::all_of(staged.begin(), staged.end(), [](const io::StagedFile* file) { return file->is_direct(); }))
    return {};
  const io::NamingOutputs now;
  for (io::StagedFile* file : staged) {
    if (file->is_direct()) continue;
    SCARP_RETURN_IF_ERROR(file->take_name(overwrite));
  }
  return {};
}

}  // namespace

std::string io::reason_of(int error) {
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
    case ENXIO:
      return "nobody reads from this pipe; start its reader first";
    case ENAMETOOLONG:
      return "the name is too long";
    default:
      return std::generic_category().message(error);
  }
}

Result<void> write_files(std::span<const FileBytes> files, bool overwrite) {
  std::vector<io::StagedFile> own;
  own.reserve(files.size());
  std::vector<io::StagedFile*> staged;
  for (const FileBytes& file : files) {
    if (file.raster != nullptr) {
      staged.push_back(&file.raster->impl().staged);
      continue;
    }
    try {
      SCARP_TRY(auto&& next, stage(file, overwrite));
      own.push_back(std::move(next));
      staged.push_back(&own.back());
    } catch (...) {
      return caught(ErrorKind::kOutput, "write " + file.path);
    }
  }
  SCARP_RETURN_IF_ERROR(take_names(staged, overwrite));
  for (std::size_t k = 0; k < files.size(); ++k) {
    if (!staged[k]->is_direct()) continue;
    SCARP_RETURN_IF_ERROR(files[k].raster != nullptr ? staged[k]->copy_to_target()
                                                     : io::write_directly(files[k].path, files[k].bytes));
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
  SCARP_TRY(const auto& name, io::readable_name(path));
  const int fd = ::open(name.c_str(), O_RDONLY | O_CLOEXEC);
  if (fd < 0) return cannot(errno == ENOENT ? "there is " + io::describe_missing(path) : io::reason_of(errno));
  struct Closer {
    int fd;
    ~Closer() { ::close(fd); }
  } const closer{fd};
  struct stat info {};
  if (::fstat(fd, &info) != 0) return cannot(io::reason_of(errno));
  if (S_ISDIR(info.st_mode)) return cannot("it is a folder");

  std::vector<std::uint8_t> bytes;
  try {
    // The size is only a hint: pipes have none, files may grow. With one extra byte, the last read() returns less than
    // requested.
    std::size_t room = S_ISREG(info.st_mode) ? static_cast<std::size_t>(info.st_size) + 1 : 65536;
    std::size_t size = 0;
    for (;;) {
      bytes.resize(room);
      const ssize_t got = ::read(fd, bytes.data() + size, room - size);
      if (got < 0 && errno == EINTR) continue;
      if (got < 0) return cannot(io::reason_of(errno));
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
