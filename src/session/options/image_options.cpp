#include "session/options/image_options.h"

#include <fmt/format.h>

#include "session/table/option_table.h"
#include "session/text/text.h"

namespace scarp::cli {
namespace {

using enum OptionId;

constexpr Choice<ImageFormat> kImages[] = {
    {"jpeg", ImageFormat::kJpeg}, {"png", ImageFormat::kPng}, {"webp", ImageFormat::kWebp}};

}  // namespace

Result<ImagePlan> parse_images(const GivenOptions& given, const OutputFormat& format) {
  ImagePlan plan;
  if (const auto image = given.first_of({kDrape, kNormalMap}); image && !format.is_glb())
    return fail(ErrorKind::kUsage, fmt::format("{} puts an image into a GLB, and OUTPUT is {}, which has no place for "
                                               "one: choose .glb",
                                               *image, format.title()));
  if (given[kDrape] == "") return fail(ErrorKind::kUsage, "the name of the image to drape is empty");
  plan.drape = given[kDrape];
  SCARP_TRY(const auto size, given.count(kDrapeSize));
  plan.drape_size = static_cast<int>(size.value_or(0));
  SCARP_TRY(plan.drape_format, parse_image_format(given));
  SCARP_TRY(const auto normals, given.count(kNormalMap));
  if (normals) plan.normal_map = static_cast<int>(*normals);
  return plan;
}

Result<ImageFormat> parse_image_format(const GivenOptions& given) {
  SCARP_TRY(const auto format, given.choice(kDrapeFormat, kImages));
  return format.value_or(ImageFormat::kJpeg);
}

const char* mime_type_of(ImageFormat format) {
  if (format == ImageFormat::kJpeg) return "image/jpeg";
  return format == ImageFormat::kWebp ? "image/webp" : "image/png";
}

}  // namespace scarp::cli
