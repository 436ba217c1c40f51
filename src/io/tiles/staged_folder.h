// A folder on its way: under a temporary name next to the one that it will get.
#pragma once

#include <filesystem>

#include "scarp/result.h"

namespace scarp {

/// ".scarp-tiles-", a hash of the final name and of this machine's, and a random end. The process holds a lock on it,
/// which ends with the process however that ends.
class StagedFolder {
 public:
  /// Deletes those of the same final name first that processes of this machine left when they were killed. `target`:
  /// the final name. Fails with kOutput where no folder can be made.
  static Result<StagedFolder> create_beside(const std::filesystem::path& target);
  StagedFolder(StagedFolder&& other) noexcept;
  StagedFolder(const StagedFolder&) = delete;
  StagedFolder& operator=(const StagedFolder&) = delete;
  StagedFolder& operator=(StagedFolder&&) = delete;
  ~StagedFolder();

  const std::filesystem::path& path() const { return path_; }
  /// The path where finish() of a set keeps the one that it replaces.
  std::filesystem::path path_of_old() const;
  /// It has its final name: it stays.
  void release() { path_.clear(); }

 private:
  StagedFolder(std::filesystem::path path, int lock) : path_(std::move(path)), lock_(lock) {}

  std::filesystem::path path_;
  int lock_;
};

}  // namespace scarp
