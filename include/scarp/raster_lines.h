// Lines whose heights are to be those of a raster.
#pragma once

#include <span>
#include <string>

#include "scarp/height_field.h"
#include "scarp/lines.h"

#pragma GCC visibility push(default)

namespace scarp {

/// read_lines(), with heights like the values in the file of `raster`, before its z_scale and z_offset: where the name
/// of their attribute ("elev_ft"), else the vertical CRS of the layer names their unit, and it is another one, they are
/// converted, and a warning reports it. Same failures and cost.
Result<LineSet> read_lines(std::span<const std::string> paths, const ReadLinesOptions& options,
                           const RasterInfo& raster);

}  // namespace scarp

#pragma GCC visibility pop
