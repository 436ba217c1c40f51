// From the tiles of a pyramid to the files of a set: encoders, textures and sinks.
#pragma once

#include <cstdint>
#include <memory>
#include <optional>
#include <span>
#include <string>
#include <vector>

#include "scarp/globe_image.h"
#include "scarp/io.h"
#include "scarp/pyramid.h"
#include "scarp/result.h"
#include "scarp/tile_set.h"
#include "scarp/tiles3d.h"

#pragma GCC visibility push(default)

namespace scarp {

/// 256 · 2^k pixels each way: as many as the image has there, at most 512, which is what clients show of a tile before
/// they load its children, or 2048 where there are none. Nothing where the image has no colour. Fails as
/// GlobeImage::read() and encode_image().
Result<std::optional<TileTexture>> make_tile_texture(const GlobeImage& image, ImageFormat format,
                                                     const PyramidPlan& plan, TileId id);

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

/// Tiles into a set of 3D Tiles.
class TerrainTilesetSink final : public TileSetSink {
 public:
  /// Borrows both. DEFAULT encoder: that of the format.
  TerrainTilesetSink(TileSetWriter& writer, const PyramidPlan& plan, TileEncoder encoder = {});

  Result<void> put(TileId id, std::span<const std::uint8_t> bytes) override;
  /// The files of encode_tileset(). Adds lattice_error() to the bounds.
  Result<void> put_files(PyramidReport& report, LayerFacts facts) override;

 private:
  FactsByTile facts_;
};

}  // namespace scarp

#pragma GCC visibility pop
