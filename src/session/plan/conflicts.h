// Options that do not go together, by the library's table.
#pragma once

#include <optional>
#include <string>

#include "pieces/conflicts.h"
#include "session/options/tile_options.h"
#include "session/plan/simplify_plan.h"

namespace scarp::cli {

/// Refuses options that conflict, as far as that is known before a file is read.
Result<void> check_conflicts(const GivenOptions& given, const SimplifyPlan& plan);

/// The same of all that simplify() would refuse, once the files are read.
Result<void> check_conflicts(const GivenOptions& given, const HeightField& field, const SimplifyOptions& options);

/// The same of tiles. Without a grid or a format, which then depend on the raster, it checks what is known without
/// them.
Result<void> check_conflicts(const GivenOptions& given, std::optional<GridKind> grid, std::optional<TileFormat> format);

/// The first of the library's settings that does not go with streamed samples, as the options that gave it; nothing if
/// there is none.
std::optional<std::string> find_unstreamed(const GivenOptions& given, const SimplifyPlan& plan);

}  // namespace scarp::cli
