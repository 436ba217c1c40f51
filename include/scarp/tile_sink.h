// From the tiles of a pyramid to the files of a set: encoders, textures and sinks.
#pragma once

#include <cstdint>
#include <memory>
#include <span>
#include <string>
#include <vector>

#include "scarp/pyramid.h"
#include "scarp/result.h"
#include "scarp/tile_grid.h"
#include "scarp/tile_set.h"

#pragma GCC visibility push(default)

namespace scarp {

/// The encoder of a format. quantized-mesh is in gzip: servers must send "Content-Encoding: gzip" with such tiles.
/// Borrows the plan.
TileEncoder make_tile_encoder(TileFormat format, const PyramidPlan& plan);

/// Tiles of a format into a set.
class TileSetSink : public TileSink {
 public:
  /// Borrows both. DEFAULT encoder: that of the format.
  TileSetSink(TileSetWriter& writer, TileFormat format, const PyramidPlan& plan, TileEncoder encoder = {});

  Result<std::vector<std::uint8_t>> encode(const TerrainTile& tile) const override;
  Result<void> put(TileId id, std::span<const std::uint8_t> bytes) override;
  /// A hash of all tiles put so far, whatever their order: 16 hexadecimal digits.
  std::string version() const;
  /// Writes the metadata file for clients: layer.json. Once, after all tiles. Fails with kOutput. Adds to the report's
  /// bounds what the format adds to the tiles'.
  virtual Result<void> put_files(PyramidReport& report, LayerFacts facts);

 protected:
  TileSetWriter& writer() { return *writer_; }
  const PyramidPlan& plan() const { return *plan_; }

 private:
  TileSetWriter* writer_;
  const PyramidPlan* plan_;
  TileEncoder encoder_;
  std::uint64_t hash_ = 0;
};

/// The sink of a format. Borrows both. DEFAULT encoder: that of the format.
std::unique_ptr<TileSetSink> make_tile_sink(TileFormat format, TileSetWriter& writer, const PyramidPlan& plan,
                                            TileEncoder encoder = {});

}  // namespace scarp

#pragma GCC visibility pop
