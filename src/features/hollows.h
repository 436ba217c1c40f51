// Hollows: samples lower than the land on both sides.
#pragma once

#include <cstdint>
#include <vector>

#include "grid/raster.h"

namespace scarp {

/// How clearly a sample lies lower than the land on both sides of it.
enum class Hollow : std::uint8_t {
  kNone,
  kFaint,  ///< by half the height asked for
  kClear,  ///< by all of it
};

inline constexpr std::int32_t kHollowReach = 16;  ///< length of a side of a profile, in samples

/// The hollow at each sample: the second best of the four profiles through it, the row, the column and both diagonals.
/// A profile is as good as the lower one of its two sides, and a side as the highest rise within kHollowReach samples
/// before it falls below the sample. Where the nearest sample of a side is nodata or beyond the raster the other side
/// counts for both, if another profile has two. In a level stretch of a profile only the middle lies low, a sample or
/// two.
std::vector<Hollow> find_hollows(const Raster& raster, double height, int threads);
/// The same of the rows [begin, end) alone.
std::vector<Hollow> find_hollows(const Raster& raster, double height, int threads, std::int32_t begin,
                                 std::int32_t end);

}  // namespace scarp
