// A file on its way: under a temporary name in the folder of the one that it will get.
#pragma once

#include <cstdint>
#include <memory>
#include <optional>
#include <span>
#include <string>

#include "io/temporary_file.h"
#include "scarp/result.h"

namespace scarp {

class StagedFile {
 public:
  /// Devices, pipes and standard output have no old content to protect and no name to get: their bytes wait in the
  /// folder for temporary files if it is to be written by name, else nowhere. Fails as write_file() does.
  static Result<StagedFile> begin(const std::string& path, bool overwrite, bool by_name);

  const std::string& path() const { return path_; }
  bool is_direct() const { return target_.empty(); }
  /// For others to write. REQUIRES: by_name.
  const std::string& name() const { return temporary_->name(); }
  Result<void> write(std::span<const std::uint8_t> bytes);
  /// Ends writing: the bytes are on disk.
  Result<void> end();
  std::uint64_t size() const;  ///< after end()
  /// The last step. REQUIRES: !is_direct().
  Result<void> take_name(bool overwrite);
  /// The last step of what was written by name. REQUIRES: is_direct().
  Result<void> copy_to_target() const;

 private:
  std::string path_, target_;  // the latter is empty for what is written directly
  std::optional<unsigned> mode_;
  std::unique_ptr<TemporaryFile> temporary_;
};

/// To a device, a pipe or standard output.
Result<void> write_directly(const std::string& path, std::span<const std::uint8_t> bytes);

}  // namespace scarp
