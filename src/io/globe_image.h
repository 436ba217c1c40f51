// An image draped over the tiles of a pyramid, a texture for each.
#pragma once

#include <array>
#include <cstdint>
#include <memory>
#include <optional>
#include <string>
#include <vector>

#include "scarp/height_field.h"
#include "scarp/io.h"
#include "scarp/result.h"
#include "scarp/tile.h"

#pragma GCC visibility push(default)

namespace scarp {

/// An image with a place on the globe. Several threads may read at once.
class GlobeImage {
 public:
  virtual ~GlobeImage() = default;
  virtual DegreeBox covered() const = 0;
  /// Approximate number of its pixels per degree: to the east, to the north.
  virtual std::array<double, 2> per_degree() const = 0;
  /// The image in a box, side × side pixels, `ground` where it has no colour; nothing where it has none at all. The
  /// same box has the same pixels. Fails with kInput.
  virtual Result<std::optional<Picture>> read(const DegreeBox& box, int side,
                                              const std::array<std::uint8_t, 3>& ground) const = 0;
};

/// An image of 8 bits, as read_drape() accepts it, in its own CRS. By GDAL: bilinear; what is wider than a pixel is
/// averaged, from the file's overviews where it has them. On the earth degrees are those of WGS 84, elsewhere the
/// image's own. Fails with kInput: no such file, not of 8 bits, without a place or a CRS, of another planet than
/// `ellipsoid`.
Result<std::shared_ptr<const GlobeImage>> open_globe_image(const std::string& path, const Geodetic& ellipsoid);

/// The texture of a tile.
struct TileTexture {
  std::vector<std::uint8_t> bytes;  ///< bytes of an image file
  ImageFormat format = ImageFormat::kJpeg;
  int side = 0;  ///< pixels; the outermost on each side lie beyond the tile, so that neighbours' filters agree
};

/// The colour of the ground where a tile has no texture, and of pixels that an image has no colour for.
inline constexpr std::array<double, 3> kGroundColor{0.47, 0.42, 0.33};  // linear

}  // namespace scarp

#pragma GCC visibility pop
