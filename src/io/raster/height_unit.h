// The unit of heights, determined once per raster.
#pragma once

#include <optional>
#include <string>

#include "scarp/io.h"

#pragma GCC visibility push(default)

namespace scarp::io {

struct HeightUnit {
  std::string name;   ///< empty: unknown
  double metres = 0;  ///< 0: not a known length
};

/// Metres per unit of length, by one of its names: "m", "Metre", "US survey foot", "cm" …
std::optional<double> find_metres(const std::string& name);
/// True for any kind of foot. Kinds of feet differ by a few parts in a hundred thousand.
bool is_foot(double metres);

/// The options for reading the heights of a raster in `frame`: z_scale converts heights to metres if requested.
/// info.unit is the unit of the file's values, and becomes the unit of the heights. Also sets the other height fields
/// of `info`, and warnings. `vertical`: the unit of the vertical CRS. Fails with kUsage as described at HeightsIn.
Result<ReadOptions> settle_heights(const ReadOptions& options, const Frame& frame, RasterInfo& info,
                                   const HeightUnit& vertical = {});

/// Warns if the unit of x and y differs from that of z: the bound holds, but shapes are distorted.
void warn_of_units(const Frame& frame, RasterInfo& info);
/// Metres per unit of a raster file's values, before z_scale; 0 for an unknown unit.
double metres_in_file(const RasterInfo& info);

}  // namespace scarp::io

#pragma GCC visibility pop
