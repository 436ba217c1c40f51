// Valleys of a raster as paths from sample to sample.
#pragma once

#include <cstddef>
#include <functional>
#include <vector>

#include "features/hollow_samples.h"
#include "features/hollows.h"
#include "grid/raster.h"

namespace scarp::features {

inline constexpr std::size_t kShortestValley = 8;  ///< low samples

struct ValleyPath {
  std::vector<Point> samples;       ///< each is adjacent to the next, possibly diagonally; at least two
  std::vector<std::size_t> joints;  ///< ascending indices of the samples at which other paths end
};

/// Links low samples to paths. Low samples and all samples within two samples of them form connected parts. The search
/// of each part starts at its lowest sample and always adds the lowest neighbour (Prim), so paths run as low as
/// possible. Where branches meet, the one with the most low samples continues and the others end. Branches have at
/// least kShortestValley low samples, half of them clearly low.
///
/// `is_left_out`: true for samples that no path may use. Ties in height are broken by raster order.
std::vector<ValleyPath> follow_valleys(const grid::Raster& raster, const std::vector<Hollow>& hollows,
                                       const std::function<bool(Point)>& is_left_out);

/// The same for known low samples and their neighbours. Memory: 26 bytes per sample.
std::vector<ValleyPath> follow_valleys(const HollowSamples& samples);

}  // namespace scarp::features
