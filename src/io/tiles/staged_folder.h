// An output folder under a temporary name next to its final one until it is complete.
#pragma once

#include <filesystem>

#include "scarp/result.h"

namespace scarp::io {

/// Its name is ".scarp-tiles-", a hash of the final name and the machine's name, and a random suffix. The process locks
/// it; the lock always ends with the process.
class StagedFolder {
 public:
  /// First deletes folders that killed processes on this machine created for the same final name. `target`: the final
  /// name. Fails with kOutput if no folder can be created.
  static Result<StagedFolder> create_beside(const std::filesystem::path& target);
  StagedFolder(StagedFolder&& other) noexcept;
  StagedFolder(const StagedFolder&) = delete;
  StagedFolder& operator=(const StagedFolder&) = delete;
  StagedFolder& operator=(StagedFolder&&) = delete;
  ~StagedFolder();

  const std::filesystem::path& path() const { return path_; }
  /// The path to which TileSetWriter::finish() moves the replaced set.
  std::filesystem::path path_of_old() const;
  /// Keeps the folder, which has been renamed.
  void release() { path_.clear(); }

 private:
  StagedFolder(std::filesystem::path path, int lock) : path_(std::move(path)), lock_(lock) {}

  std::filesystem::path path_;
  int lock_;
};

}  // namespace scarp::io
