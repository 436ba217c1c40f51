// The set that a server reads; it may be replaced during serving.
#pragma once

#include <cstdint>
#include <functional>
#include <memory>
#include <mutex>
#include <string>
#include <vector>

#include "scarp/tile_set.h"
#include "serve/http_message.h"

namespace scarp::cli {

/// A set in the state in which it was opened.
struct OpenedSet {
  std::shared_ptr<const TileSetReader> reader;
  std::shared_ptr<const OpenFile> file;  ///< the file of a single-file set
  std::string stamp;                     ///< stamp of the file, or of the folder and its metadata

  /// The page, made once.
  const std::vector<std::uint8_t>& page(const std::function<std::vector<std::uint8_t>()>& make) const;

 private:
  mutable std::once_flag page_once_;
  mutable std::vector<std::uint8_t> page_;
};

class ServedSet {
 public:
  /// Fails if open_tile_set() fails.
  static Result<std::unique_ptr<ServedSet>> open(const std::string& path);
  /// A set that is never replaced.
  explicit ServedSet(std::shared_ptr<const TileSetReader> reader);

  /// Returns the current set; reopens it if another set replaced its file. May be called concurrently.
  std::shared_ptr<const OpenedSet> now() const;

 private:
  ServedSet() = default;

  std::string path_;  ///< empty if the set is never replaced
  mutable std::mutex mutex_;
  mutable std::shared_ptr<const OpenedSet> opened_;
  mutable std::string stamp_tried_;
};

/// Identifies a file and its state, regardless of its name.
struct FileStamp {
  std::uint64_t size = 0;
  std::string text;  ///< empty if there is no file
};
FileStamp stamp_of(const std::string& path);
FileStamp stamp_of(const OpenFile& file);

/// Opens a file of the folder; null if it has no such file. Ignores names that are hidden, lead out of the folder or
/// contain links.
std::shared_ptr<const OpenFile> open_in_folder(const std::string& folder, std::string_view name);
/// Fails with kInput.
Result<std::vector<std::uint8_t>> read_all(const OpenFile& file);

}  // namespace scarp::cli
