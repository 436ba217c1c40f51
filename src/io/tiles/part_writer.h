// Appends blocks to a part.
#pragma once

#include <cstdint>
#include <memory>
#include <span>
#include <string>
#include <utility>
#include <vector>

#include "scarp/tile_job.h"

namespace scarp {

struct PackedTile {
  TileId id;
  std::vector<std::uint8_t> bytes;
};

class PartWriter {
 public:
  /// A new file in the folder, which is made if needed. Fails with kOutput.
  static Result<std::unique_ptr<PartWriter>> create(const std::string& folder, Shard shard, std::uint64_t key);
  PartWriter(const PartWriter&) = delete;
  PartWriter& operator=(const PartWriter&) = delete;
  /// A file without a block goes away.
  ~PartWriter();

  /// The block is on the disk when this returns. Fails with kOutput.
  Result<void> add(const BlockReport& block, const std::vector<PackedTile>& tiles);

 private:
  PartWriter(std::string path, int fd) : path_(std::move(path)), fd_(fd) {}
  Result<void> append(std::span<const std::uint8_t> bytes);

  std::string path_;
  int fd_;
  std::uint64_t blocks_ = 0;
};

}  // namespace scarp
