// Rasters without information about their scale.
#pragma once

#include <optional>
#include <string>

#include "scarp/height_field.h"

namespace scarp::cli {

/// The warning for a raster without georeference whose relief dwarfs its width, so that its mesh is a needle: how to
/// give the width of a cell, or scale the heights. Nothing if it does not, or if the range is not known.
std::optional<std::string> find_needle(const OwnedHeightField& field, const RasterInfo& info);

}  // namespace scarp::cli
