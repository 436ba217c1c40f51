// Images inside a GLB: an image draped over the terrain, and normals as an image.
#pragma once

#include <optional>
#include <string>

#include "scarp/io.h"
#include "session/options/output_kind.h"
#include "session/options/values.h"

namespace CLI {
class App;
}

namespace scarp::cli {

/// The image that the options ask for.
struct ImagePlan {
  std::optional<std::string> drape;  ///< a file
  int drape_size = 0;                ///< pixels on the longer side; 0: as many as the file has there
  ImageFormat drape_format = ImageFormat::kJpeg;
  std::optional<int> normal_map;  ///< pixels on the longer side

  bool any() const { return drape || normal_map; }
};

struct ImageArguments {
  Given drape, drape_size, drape_format, normal_map;

  void add_to(CLI::App& command);
  /// Fails with kUsage for values out of range, and for OUTPUT without a place for images.
  Result<ImagePlan> parse(const OutputFormat& format) const;
  /// The first that was given; null if none was.
  const char* find_image() const;
  std::string canonical() const;
};

/// jpeg, png or webp. DEFAULT: jpeg. Fails with kUsage.
Result<ImageFormat> parse_image_format(const Given& name);

/// "image/png", …
const char* mime_type_of(ImageFormat format);

}  // namespace scarp::cli
