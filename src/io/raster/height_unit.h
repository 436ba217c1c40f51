// The unit of heights, decided once a raster.
#pragma once

#include <optional>
#include <string>

#include "scarp/io.h"

namespace scarp {

struct HeightUnit {
  std::string name;   ///< empty: nobody names it
  double metres = 0;  ///< 0: no length that is known
};

/// Metres of a unit of length by one of its names: "m", "Metre", "US survey foot", "cm" …
std::optional<double> find_metres(const std::string& name);
/// Any foot: they differ by parts in a hundred thousand.
bool is_foot(double metres);

/// The options with which the heights of a raster are read in `frame`: z_scale makes metres of them where they become
/// metres. info.unit is what the file says of its values, and becomes the unit of the heights; all else in `info` that
/// is about them is filled in, and warnings. `vertical`: the unit of its vertical CRS. kUsage as HeightsIn says.
Result<ReadOptions> settle_heights(const ReadOptions& options, const Frame& frame, RasterInfo& info,
                                   const HeightUnit& vertical = {});

}  // namespace scarp
