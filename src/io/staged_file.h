// An output file under a temporary name in its final folder until it is complete.
#pragma once

#include <cstdint>
#include <memory>
#include <optional>
#include <span>
#include <string>

#include "io/temporary_file.h"
#include "scarp/result.h"

namespace scarp::io {

class StagedFile {
 public:
  /// Devices, pipes and standard output have no old content to protect, so no file is renamed. With `by_name`, their
  /// bytes go to the folder for temporary files, else directly to the target. Fails as write_file() does.
  static Result<StagedFile> begin(const std::string& path, bool overwrite, bool by_name);

  const std::string& path() const { return path_; }
  bool is_direct() const { return target_.empty(); }
  /// For external writers. REQUIRES: by_name.
  const std::string& name() const { return temporary_->name(); }
  Result<void> write(std::span<const std::uint8_t> bytes);
  /// Ends writing. All bytes are then on disk.
  Result<void> end();
  std::uint64_t size() const;  ///< after end()
  /// The final rename. REQUIRES: !is_direct().
  Result<void> take_name(bool overwrite);
  /// The final copy of a file written by name. REQUIRES: is_direct().
  Result<void> copy_to_target() const;

 private:
  std::string path_, target_;  // target_ is empty for direct output
  std::optional<unsigned> mode_;
  std::unique_ptr<TemporaryFile> temporary_;
};

/// Writes to a device, a pipe or standard output.
Result<void> write_directly(const std::string& path, std::span<const std::uint8_t> bytes);

}  // namespace scarp::io
