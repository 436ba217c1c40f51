// The set that a server answers from, which may be replaced while it serves.
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

/// The set as it was opened once.
struct OpenedSet {
  std::shared_ptr<const TileSetReader> reader;
  std::shared_ptr<const OpenFile> file;  ///< file of a set in one file
  std::string stamp;                     ///< stamp of the file, or of the folder and the file that names its tiles

  /// Made once.
  const std::vector<std::uint8_t>& page(const std::function<std::vector<std::uint8_t>()>& make) const;

 private:
  mutable std::once_flag page_once_;
  mutable std::vector<std::uint8_t> page_;
};

class ServedSet {
 public:
  /// Fails as open_tile_set() does.
  static Result<std::unique_ptr<ServedSet>> open(const std::string& path);
  /// A set that is never replaced.
  explicit ServedSet(std::shared_ptr<const TileSetReader> reader);

  /// Opened anew where a file was put in its place since, if that is a set. Several threads may call it at once.
  std::shared_ptr<const OpenedSet> now() const;

 private:
  ServedSet() = default;

  std::string path_;  ///< empty if it is never replaced
  mutable std::mutex mutex_;
  mutable std::shared_ptr<const OpenedSet> opened_;
  mutable std::string stamp_tried_;
};

/// A file with this status, whatever its name.
struct FileStamp {
  std::uint64_t size = 0;
  std::string text;  ///< empty where there is no file
};
FileStamp stamp_of(const std::string& path);
FileStamp stamp_of(const OpenFile& file);

/// Null where the folder holds no such file; names that are hidden, lead out of it, or go through links are none.
std::shared_ptr<const OpenFile> open_in_folder(const std::string& folder, std::string_view name);
/// Fails with kInput.
Result<std::vector<std::uint8_t>> read_all(const OpenFile& file);

}  // namespace scarp::cli
