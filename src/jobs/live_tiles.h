// Tiles that are made when somebody asks for them.
#pragma once

#include <cstdint>
#include <functional>
#include <memory>
#include <optional>
#include <string>
#include <vector>

#include "scarp/result.h"
#include "scarp/run.h"
#include "scarp/tile.h"
#include "scarp/tile_job.h"
#include "scarp/tile_set.h"

#pragma GCC visibility push(default)

namespace scarp {

/// A tile as it is kept.
struct LiveTile {
  std::vector<std::uint8_t> bytes;
  /// TerrainTile::bound(); nothing above the blocks before prepare() has come to it: not all nodes were examined.
  std::optional<double> bound;
};

/// The set that a job would make, of quantized-mesh, whose tiles are made as they are read. Their bytes are those of
/// the finished set. Several threads may read at once.
class LiveTileSet final : public TileSetReader {
 public:
  /// Finds out which tiles there are. Up to `look_nodes` nodes, all are examined, and the tiles are those of the
  /// finished set; beyond that, tiles count wherever the raster may cover them, and those without heights are flat.
  /// `cache`: bytes of tiles that are kept for the next who asks. Borrows the nodes. Progress: pass "look". Fails as
  /// find_tiles() does, and with kUsage for another format.
  static Result<std::unique_ptr<LiveTileSet>> open(const TileJob& job, const NodeSource& nodes, std::uint64_t cache,
                                                   const Run& run = {},
                                                   std::uint64_t look_nodes = std::uint64_t{1} << 28);
  LiveTileSet(const LiveTileSet&) = delete;
  LiveTileSet& operator=(const LiveTileSet&) = delete;
  ~LiveTileSet() override;

  TileFormat format() const override { return TileFormat::kQuantizedMesh; }
  const std::vector<std::vector<std::uint64_t>>& tiles() const override;
  /// "layer.json" alone. Its version is that of the job and its rasters.
  std::vector<std::string> files() const override;
  Result<std::vector<std::uint8_t>> read_tile(TileId id) const override;
  Result<std::vector<std::uint8_t>> read_file(const std::string& name) const override;

  /// The same as read_tile(), with its bound. Fails with kInput where the set has no such tile, and as make_tile().
  /// Memory: up to 300 MB a call while a tile of the block level is made, less below.
  Result<std::shared_ptr<const LiveTile>> make(TileId id) const;

  /// Makes the slowest tiles, all but the finest three levels, as make_pyramid() does, and keeps them with their
  /// bounds: make() then finds them. Others may call make() meanwhile. They use up to half of the cache: once that is
  /// full, the call ends. Returns whether all are kept. REQUIRES: called once. `is_over`: asked often, on any thread;
  /// once true, the call ends with kCancelled. Memory in addition to the cache: 400 MB. Fails as make_pyramid() does.
  Result<bool> prepare(int threads, const std::function<bool()>& is_over);

 private:
  struct Impl;
  explicit LiveTileSet(std::unique_ptr<Impl> impl);
  std::unique_ptr<Impl> impl_;
};

}  // namespace scarp

#pragma GCC visibility pop
