// Appends the blocks of a share to a part file.
#pragma once

#include <cstdint>
#include <memory>
#include <span>
#include <string>
#include <utility>
#include <vector>

#include "scarp/tile_job.h"

namespace scarp::jobs {

struct PackedTile {
  TileId id;
  std::vector<std::uint8_t> bytes;
};

}  // namespace scarp::jobs

namespace scarp {

class PartWriter {
 public:
  /// The common prefix of all part names of a share.
  static std::string name_of(Shard shard);
  /// Creates a new file in the folder, and the folder if needed. Fails with kOutput.
  static Result<std::unique_ptr<PartWriter>> create(const std::string& folder, Shard shard, const TileJob& job);
  PartWriter(const PartWriter&) = delete;
  PartWriter& operator=(const PartWriter&) = delete;
  /// Deletes the file if it has no records.
  ~PartWriter();

  /// True if another process was writing to a part of the share when this writer was created.
  bool has_company() const { return has_company_; }
  /// The block is on disk when this returns. Fails with kOutput.
  Result<void> add(const BlockReport& block, const std::vector<jobs::PackedTile>& tiles);
  /// Records that an existing block is also valid for the job's sources. `nodes`: the hash of its nodes. Fails with
  /// kOutput.
  Result<void> confirm(TileId block, std::uint64_t nodes);

 private:
  PartWriter(std::string path, int fd) : path_(std::move(path)), fd_(fd) {}
  Result<void> add_record(std::span<const std::uint8_t> payload);
  Result<void> append(std::span<const std::uint8_t> bytes);

  std::string path_;
  int fd_;
  std::uint64_t sources_ = 0, records_ = 0;
  bool has_company_ = false;
};

}  // namespace scarp
