#include "session/options/channel_options.h"

#include <fmt/format.h>

#include <algorithm>
#include <utility>

#include "session/table/option_table.h"
#include "session/text/text.h"

namespace scarp::cli {
namespace {

using enum OptionId;

constexpr Choice<Norm> kNorms[] = {{"l1", Norm::kSum}, {"l2", Norm::kSquares}, {"linf", Norm::kMax}};

Result<std::vector<double>> parse_weights(const std::string& text) {
  std::vector<double> weights;
  for (std::size_t start = 0; start <= text.size();) {
    const std::size_t end = std::min(text.find(',', start), text.size());
    SCARP_TRY(const double weight, parse_non_negative(name_of(kChannelWeights), text.substr(start, end - start)));
    weights.push_back(weight);
    start = end + 1;
  }
  if (*std::max_element(weights.begin(), weights.end()) > 0) return weights;
  return fail(ErrorKind::kUsage,
              fmt::format("{} {} are all 0: one must be above 0", kChannelWeights, shell_word(text)));
}

}  // namespace

Result<ChannelPlan> parse_channels(const GivenOptions& given) {
  ChannelPlan plan;
  plan.image = given.has(kImage);
  plan.textures = given.all(kTexture);
  for (const std::string& texture : plan.textures) {
    if (texture.empty()) return fail(ErrorKind::kUsage, fmt::format("the name of {} is empty", kTexture));
  }
  SCARP_TRY(const auto weight, given.number(kTextureWeight));
  plan.texture_weight = weight.value_or(plan.texture_weight);
  SCARP_TRY(const auto norm, given.choice(kNorm, kNorms));
  plan.norm = norm.value_or(plan.image ? Norm::kMax : Norm::kSum);
  if (given[kChannelWeights]) {
    SCARP_TRY(plan.weights, parse_weights(*given[kChannelWeights]));
  }
  return plan;
}

const char* norm_name(Norm norm) { return name_of(norm, kNorms); }

}  // namespace scarp::cli
