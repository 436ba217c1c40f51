// Rasters without information about their scale.
#pragma once

#include <optional>
#include <string>

#include "scarp/height_field.h"

namespace scarp::cli {

/// The warning for a raster without georeference whose relief dwarfs its width, so that its mesh is a needle. It
/// explains how to set the cell width or scale the heights. Nothing for other rasters, or if the range is unknown.
std::optional<std::string> find_needle(const OwnedHeightField& field, const RasterInfo& info);

}  // namespace scarp::cli
