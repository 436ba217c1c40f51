// Hollows: samples lower than the land on both sides of them.
#pragma once

#include <cstdint>
#include <vector>

#include "grid/raster.h"

namespace scarp::features {

/// Classes of a sample's depth below the land on both sides.
enum class Hollow : std::uint8_t {
  kNone,
  kFaint,  ///< by half the given height
  kClear,  ///< by the whole height
};

inline constexpr std::int32_t kHollowReach = 16;  ///< samples in one side of a profile

/// The hollow at each sample: the second best of the four profiles through it (row, column, both diagonals). A profile
/// has the rating of its worse side. The rating of a side is its highest rise above the sample within kHollowReach
/// samples and before it falls below the sample. If the nearest sample of a side is nodata or beyond the raster, the
/// other side counts for both, provided another profile has two sides. In a level stretch of a profile, only the one or
/// two middle samples count as low.
std::vector<Hollow> find_hollows(const grid::Raster& raster, double height, int threads);
/// The same, only for the rows [begin, end).
std::vector<Hollow> find_hollows(const grid::Raster& raster, double height, int threads, std::int32_t begin,
                                 std::int32_t end);

}  // namespace scarp::features
