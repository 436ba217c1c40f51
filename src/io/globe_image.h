// An image draped over the tiles of a pyramid, one texture per tile.
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

namespace scarp::io {

/// A georeferenced image. Several threads may read at once.
class GlobeImage {
 public:
  virtual ~GlobeImage() = default;
  virtual DegreeBox covered() const = 0;
  /// Approximate pixels per degree, to the east and to the north.
  virtual std::array<double, 2> per_degree() const = 0;
  /// The part of the image in a box, as side × side pixels. Pixels without colour become `ground`. Nothing if no pixel
  /// has colour. Equal boxes give equal pixels. Fails with kInput.
  virtual Result<std::optional<Picture>> read(const DegreeBox& box, int side,
                                              const std::array<std::uint8_t, 3>& ground) const = 0;
};

/// An 8-bit image, as read_drape() accepts it, in its own CRS. GDAL interpolates it bilinearly, and averages areas
/// larger than a pixel, from the file's overviews if it has them. On the earth, degrees are those of WGS 84; on other
/// planets, the image's own. Fails with kInput if the file is missing, does not have 8 bits, has no position or CRS, or
/// is on another planet than `ellipsoid`.
Result<std::shared_ptr<const GlobeImage>> open_globe_image(const std::string& path, const Geodetic& ellipsoid);

struct TileTexture {
  std::vector<std::uint8_t> bytes;  ///< bytes of an image file
  ImageFormat format = ImageFormat::kJpeg;
  int side = 0;  ///< pixels; the outermost row on each side is outside the tile, so that texture filters of neighbours
                 ///< agree
};

/// The colour of the ground for tiles without texture, and for pixels without colour.
inline constexpr std::array<double, 3> kGroundColor{0.47, 0.42, 0.33};  // linear

}  // namespace scarp::io

#pragma GCC visibility pop
