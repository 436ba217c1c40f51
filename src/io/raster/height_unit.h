// The unit of heights, decided once a raster.
#pragma once

#include <optional>
#include <string>

#include "scarp/io.h"

namespace scarp {

struct HeightUnit {
  std::string name;   ///< empty: unknown
  double metres = 0;  ///< 0: no length that is known
};

/// Metres of a unit of length by one of its names: "m", "Metre", "US survey foot", "cm" …
std::optional<double> find_metres(const std::string& name);
/// Any foot: they differ by parts in a hundred thousand.
bool is_foot(double metres);

/// The options with which the heights of a raster are read in `frame`: z_scale makes metres of them where they become
/// metres. info.unit is the file's unit of its values, and becomes the unit of the heights; all else in `info` that is
/// about them is filled in, and warnings. `vertical`: the unit of its vertical CRS. kUsage as described at HeightsIn.
Result<ReadOptions> settle_heights(const ReadOptions& options, const Frame& frame, RasterInfo& info,
                                   const HeightUnit& vertical = {});

/// Warns of x and y in one unit and z in another: the promise holds, the shape does not.
void warn_of_units(const Frame& frame, RasterInfo& info);
/// Metres of the unit of the values in the file of a raster, before z_scale; 0 for words that are no known length.
double metres_in_file(const RasterInfo& info);

}  // namespace scarp
