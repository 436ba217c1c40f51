#include "session/options/channel_options.h"

#include <fmt/format.h>

#include <algorithm>
#include <utility>

#include "session/table/option_table.h"
#include "session/text/text.h"

namespace scarp::cli {
namespace {

constexpr Choice<Norm> kNorms[] = {{"l1", Norm::kSum}, {"l2", Norm::kSquares}, {"linf", Norm::kMax}};

Result<std::vector<double>> parse_weights(const std::string& text) {
  std::vector<double> weights;
  for (std::size_t start = 0; start <= text.size();) {
    const std::size_t end = std::min(text.find(',', start), text.size());
    SCARP_TRY(const double weight, parse_non_negative("--channel-weights", text.substr(start, end - start)));
    weights.push_back(weight);
    start = end + 1;
  }
  if (*std::max_element(weights.begin(), weights.end()) > 0) return weights;
  return fail(ErrorKind::kUsage, fmt::format("--channel-weights {} are all 0: one must be above 0", shell_word(text)));
}

}  // namespace

void ChannelArguments::add_to(CLI::App& command) {
  add_flag(command, OptionId::kImage, image);
  add_option(command, OptionId::kTexture, textures);
  add_option(command, OptionId::kTextureWeight, texture_weight);
  add_option(command, OptionId::kNorm, norm);
  add_option(command, OptionId::kChannelWeights, weights);
}

Result<ChannelPlan> ChannelArguments::parse(const RasterArguments& raster) const {
  ChannelPlan plan;
  plan.image = image;
  plan.textures = textures;
  if (image && !textures.empty()) {
    return fail(ErrorKind::kUsage, "--image cannot be combined with --texture: an image has no heights to texture");
  }
  if (image && raster.decode) {
    return fail(ErrorKind::kUsage, "--image cannot be combined with --decode: decoded bands are heights");
  }
  for (const auto& [name, given] :
       {std::pair{"--z-scale", &raster.z_scale}, {"--z-offset", &raster.z_offset}, {"--z-unit", &raster.z_unit}}) {
    if (image && *given)
      return fail(ErrorKind::kUsage, fmt::format("--image cannot be combined with {}: an image has no heights", name));
  }
  for (const std::string& texture : textures) {
    if (texture.empty()) return fail(ErrorKind::kUsage, "the name of --texture is empty");
  }
  if (texture_weight) {
    if (textures.empty()) return fail(ErrorKind::kUsage, "--texture-weight needs --texture");
    SCARP_TRY(const double weight, parse_non_negative("--texture-weight", *texture_weight));
    if (weight > 1) {
      return fail(ErrorKind::kUsage, fmt::format("--texture-weight {} is above 1, which means textures only",
                                                 shell_word(*texture_weight)));
    }
    plan.texture_weight = weight;
  }
  const std::pair<const char*, const Given*> needing[] = {{"--norm", &norm}, {"--channel-weights", &weights}};
  for (const auto& [name, text] : needing) {
    if (*text && !plan.has_channels()) {
      return fail(ErrorKind::kUsage, fmt::format("{} needs --texture or --image", name));
    }
  }
  plan.norm = image ? Norm::kMax : Norm::kSum;
  if (norm) {
    SCARP_TRY(plan.norm, choose("--norm", *norm, kNorms));
  }
  if (weights) {
    SCARP_TRY(plan.weights, parse_weights(*weights));
  }
  return plan;
}

std::string ChannelArguments::canonical() const {
  std::string command = image ? " --image" : "";
  for (const std::string& texture : textures) command += canonical_option("--texture", base_name(texture));
  return command + canonical_option("--texture-weight", texture_weight) + canonical_option("--norm", norm) +
         canonical_option("--channel-weights", weights);
}

const char* norm_name(Norm norm) { return name_of(norm, kNorms); }

}  // namespace scarp::cli
