// A tileset that counts tiles while it writes them.
#pragma once

#include <cstdint>
#include <memory>
#include <span>
#include <string>
#include <utility>

#include "scarp/tile_set.h"
#include "session/text/tile_counts.h"

namespace scarp::cli {

class CountedSet final : public TileSetWriter {
 public:
  /// Borrows the counts.
  CountedSet(std::unique_ptr<TileSetWriter> set, TileCounts& counts) : set_(std::move(set)), counts_(counts) {}

  Result<void> put_tile(TileId id, std::span<const std::uint8_t> bytes) override {
    ++counts_.tiles;
    counts_.bytes += bytes.size();
    return set_->put_tile(id, bytes);
  }
  Result<void> put_file(const std::string& name, std::span<const std::uint8_t> bytes) override {
    return set_->put_file(name, bytes);
  }
  Result<void> finish() override { return set_->finish(); }

 private:
  std::unique_ptr<TileSetWriter> set_;
  TileCounts& counts_;
};

}  // namespace scarp::cli
