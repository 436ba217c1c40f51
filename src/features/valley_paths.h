// Valleys of a raster as paths from sample to sample.
#pragma once

#include <cstddef>
#include <functional>
#include <vector>

#include "features/hollow_samples.h"
#include "features/hollows.h"
#include "grid/raster.h"

namespace scarp {

inline constexpr std::size_t kShortestValley = 8;  ///< in samples that lie low

struct ValleyPath {
  std::vector<Point> samples;       ///< each a neighbour, or a diagonal one, of the next; at least two
  std::vector<std::size_t> joints;  ///< indices of samples, ascending, at which others end at this one
};

/// Links samples that lie low. They and all samples within two of them hang together in parts; in each part samples are
/// reached from its lowest one, always the lowest next that borders on those reached (Prim): so ways keep as low as
/// they can. The branches with most low samples go through where they meet, the others end there. Branches have at
/// least kShortestValley low samples, half of them clearly so.
///
/// `is_left_out`: of samples, those that no path may use. Equal heights count in raster order.
std::vector<ValleyPath> follow_valleys(const Raster& raster, const std::vector<Hollow>& hollows,
                                       const std::function<bool(Point)>& is_left_out);

/// The same from known low samples and their neighbourhood. Memory: 26 bytes for each of these samples.
std::vector<ValleyPath> follow_valleys(const HollowSamples& samples);

}  // namespace scarp
