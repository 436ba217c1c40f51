// Images inside a GLB: an image draped over the terrain, and normals as an image.
#pragma once

#include <optional>
#include <string>

#include "scarp/io.h"
#include "session/options/given_options.h"
#include "session/options/output_kind.h"

namespace scarp::cli {

/// The requested image.
struct ImagePlan {
  std::optional<std::string> drape;  ///< a file
  int drape_size = 0;                ///< pixels on the longer side; 0: those of the file in that area
  ImageFormat drape_format = ImageFormat::kJpeg;
  std::optional<int> normal_map;  ///< pixels on the longer side

  bool any() const { return drape || normal_map; }
};

/// Fails with kUsage for values out of range and for an OUTPUT format without images.
Result<ImagePlan> parse_images(const GivenOptions& given, const OutputFormat& format);
/// jpeg, png or webp. DEFAULT: jpeg. Fails with kUsage.
Result<ImageFormat> parse_image_format(const GivenOptions& given);

/// "image/png", …
const char* mime_type_of(ImageFormat format);

}  // namespace scarp::cli
