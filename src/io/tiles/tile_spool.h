// Stores tiles and files of a set as they arrive, until they are written to a container in its order.
#pragma once

#include <algorithm>
#include <cstdint>
#include <memory>
#include <span>
#include <string>
#include <vector>

#include "scarp/result.h"
#include "scarp/tile.h"

namespace scarp::io {

/// Stores bytes in an unnamed file, which vanishes with the process.
class TileSpool {
 public:
  struct Tile {
    TileId id;
    std::uint32_t length = 0;
    std::uint64_t offset = 0;
  };
  struct File {
    std::string name;
    std::uint64_t offset = 0, length = 0;
  };

  /// Creates the file in the folder of `path`, where the set will need as much space. Fails with kOutput.
  static Result<std::unique_ptr<TileSpool>> create_beside(const std::string& path);
  TileSpool(const TileSpool&) = delete;
  TileSpool& operator=(const TileSpool&) = delete;
  ~TileSpool();

  Result<void> add(TileId id, std::span<const std::uint8_t> bytes);
  Result<void> add(const std::string& name, std::span<const std::uint8_t> bytes);

  /// In the order of arrival, or as last sorted.
  const std::vector<Tile>& tiles() const { return tiles_; }
  template <class Less>
  void sort_tiles(Less less) {
    std::sort(tiles_.begin(), tiles_.end(), less);
  }
  const std::vector<File>& files() const { return files_; }
  /// By name.
  void sort_files();
  /// True if all tiles, or none, begin like gzip files.
  bool all_gzip() const { return gzip_tiles_ == tiles_.size(); }
  bool no_gzip() const { return gzip_tiles_ == 0; }

  Result<std::vector<std::uint8_t>> read(const Tile& tile) const { return read(tile.offset, tile.length); }
  Result<std::vector<std::uint8_t>> read(const File& file) const { return read(file.offset, file.length); }

 private:
  TileSpool(std::string path, int fd) : path_(std::move(path)), fd_(fd) {}
  Result<void> append(std::span<const std::uint8_t> bytes);
  Result<std::vector<std::uint8_t>> read(std::uint64_t offset, std::uint64_t length) const;

  std::string path_;  ///< path of the set
  int fd_;
  std::uint64_t size_ = 0, gzip_tiles_ = 0;
  std::vector<Tile> tiles_;
  std::vector<File> files_;
};

}  // namespace scarp::io
