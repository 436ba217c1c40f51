// A set of tiles as a folder that any web server can serve: z/x/y.terrain, and layer.json.
#pragma once

#include <cstdint>
#include <memory>
#include <span>
#include <string>
#include <vector>

#include "scarp/io.h"
#include "scarp/result.h"
#include "scarp/tile.h"

#pragma GCC visibility push(default)

namespace scarp {

/// What layer.json says besides the tiles.
struct LayerFacts {
  std::string name = "terrain";
  std::string description;
  std::string attribution;
};

/// Tiles as quantized-mesh, compressed by gzip: servers must send "Content-Encoding: gzip" with them.
class TileFolder final : public TileSink {
 public:
  /// Tiles go to a folder with a temporary name beside `path`, which finish() gives its own; without that nothing is
  /// left. Fails with kOutput where `path` exists, unless it is empty, or `overwrite` is true and it is a set of
  /// Scarp's tiles with nothing else in it, and where no folder can be made.
  static Result<std::unique_ptr<TileFolder>> create(const std::string& path, const PyramidPlan& plan, bool overwrite);
  TileFolder(const TileFolder&) = delete;
  TileFolder& operator=(const TileFolder&) = delete;
  ~TileFolder() override;

  Result<std::vector<std::uint8_t>> encode(const TerrainTile& tile) const override;
  Result<void> put(TileId id, std::span<const std::uint8_t> bytes) override;
  /// Writes layer.json and takes the name. Fails with kOutput.
  Result<void> finish(const PyramidReport& report, const LayerFacts& facts);

 private:
  struct Impl;
  explicit TileFolder(std::unique_ptr<Impl> impl);
  std::unique_ptr<Impl> impl_;
};

/// The bytes in a gzip file, without a time or a name: equal bytes make equal files, with one version of zlib.
Result<std::vector<std::uint8_t>> compress_gzip(std::span<const std::uint8_t> bytes);
/// The reverse. Fails with kInput for what is no gzip file, is damaged, or holds more than `most` bytes.
Result<std::vector<std::uint8_t>> decompress_gzip(std::span<const std::uint8_t> bytes, std::size_t most);

/// What heights are above.
enum class Vertical {
  kAuto,       ///< what the raster's CRS says
  kEllipsoid,  ///< the ellipsoid, as GPS gives them
  kEgm96,      ///< the geoid EGM96: the sea
};

/// Where a raster lies on the globe.
struct RasterOnGlobe {
  RasterPlace place;
  std::shared_ptr<const PointTransform> to_degrees;  ///< null where place.from_degrees is
  Geodetic ellipsoid;
  std::shared_ptr<const HeightZero> zero;  ///< of the heights; null where they are above the ellipsoid
  std::string vertical;                    ///< what the heights are above, in words
};

/// `path`: the raster's, for sentences. Fails with kInput without a georeference or a CRS, for heights that are not in
/// metres, where PROJ knows no way to longitude and latitude, and beyond 180° of a cylindrical projection; with kUsage
/// where nobody says what the heights are above, and where the geoid is not on this machine.
Result<RasterOnGlobe> place_on_globe(const RasterInfo& info, int cols, int rows, Vertical vertical,
                                     const std::string& path);

}  // namespace scarp

#pragma GCC visibility pop
