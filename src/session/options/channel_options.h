// Options for textures and images.
#pragma once

#include <string>
#include <vector>

#include "scarp/simplify.h"
#include "session/options/given_options.h"

namespace scarp::cli {

/// The requested textures.
struct ChannelPlan {
  bool image = false;                 ///< INPUT itself is the image; the heights are 0
  std::vector<std::string> textures;  ///< files, in the order given
  double texture_weight = 0.5;        ///< 0: heights only … 1: textures only
  Norm norm = Norm::kSum;
  std::vector<double> weights;  ///< weights of the channels; empty: all equal

  bool has_channels() const { return image || !textures.empty(); }
};

Result<ChannelPlan> parse_channels(const GivenOptions& given);

/// "l1", "l2" or "linf".
const char* norm_name(Norm norm);

}  // namespace scarp::cli
