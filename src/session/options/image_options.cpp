#include "session/options/image_options.h"

#include <fmt/format.h>

#include "session/table/option_table.h"
#include "session/text/text.h"

namespace scarp::cli {
namespace {

/// More pixels than any GPU shows.
constexpr std::uint64_t kMostPixels = 16384;

Result<int> parse_side(const char* option, const std::string& text) {
  SCARP_TRY(const std::uint64_t side, parse_count(option, text, 1));
  if (side > kMostPixels) {
    return fail(ErrorKind::kUsage,
                fmt::format("{} {} is above {}, the most pixels that graphics cards show", option, text, kMostPixels));
  }
  return static_cast<int>(side);
}

}  // namespace

void ImageArguments::add_to(CLI::App& command) {
  add_option(command, OptionId::kDrape, drape);
  add_option(command, OptionId::kDrapeSize, drape_size);
  add_option(command, OptionId::kDrapeFormat, drape_format);
  add_option(command, OptionId::kNormalMap, normal_map);
}

const char* ImageArguments::find_image() const {
  if (drape) return "--drape";
  return normal_map ? "--normal-map" : nullptr;
}

Result<ImagePlan> ImageArguments::parse(const OutputFormat& format) const {
  ImagePlan plan;
  for (const auto& [name, value] :
       {std::pair{"--drape-size", &drape_size}, std::pair{"--drape-format", &drape_format}}) {
    if (*value && !drape) return fail(ErrorKind::kUsage, fmt::format("{} needs an image: --drape FILE", name));
  }
  if (const char* image = find_image(); image != nullptr && !format.is_glb()) {
    return fail(ErrorKind::kUsage, fmt::format("{} puts an image into a GLB, and OUTPUT is {}, which has no place for "
                                               "one: choose .glb",
                                               image, format.title()));
  }
  if (drape && drape->empty()) return fail(ErrorKind::kUsage, "the name of the image to drape is empty");
  plan.drape = drape;
  if (drape_size) {
    SCARP_TRY(plan.drape_size, parse_side("--drape-size", *drape_size));
  }
  SCARP_TRY(plan.drape_format, parse_image_format(drape_format));
  if (normal_map) {
    SCARP_TRY(plan.normal_map, parse_side("--normal-map", *normal_map));
  }
  return plan;
}

std::string ImageArguments::canonical() const {
  return canonical_option("--drape", drape ? Given(base_name(*drape)) : drape) +
         canonical_option("--drape-size", drape_size) + canonical_option("--drape-format", drape_format) +
         canonical_option("--normal-map", normal_map);
}

Result<ImageFormat> parse_image_format(const Given& name) {
  const std::string named = name.value_or("jpeg");
  if (named == "jpeg") return ImageFormat::kJpeg;
  if (named == "png") return ImageFormat::kPng;
  if (named == "webp") return ImageFormat::kWebp;
  return fail(ErrorKind::kUsage,
              fmt::format("--drape-format {} is unknown: choose jpeg, png or webp", shell_word(named)));
}

const char* mime_type_of(ImageFormat format) {
  if (format == ImageFormat::kJpeg) return "image/jpeg";
  return format == ImageFormat::kWebp ? "image/webp" : "image/png";
}

}  // namespace scarp::cli
