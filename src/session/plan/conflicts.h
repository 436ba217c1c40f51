// Conflicts of options, by the library's table.
#pragma once

#include <optional>
#include <string>

#include "pieces/conflicts.h"
#include "session/options/tile_options.h"
#include "session/plan/simplify_plan.h"

namespace scarp::cli {

/// Refuses conflicts that are known before files are read.
Result<void> check_conflicts(const GivenOptions& given, const SimplifyPlan& plan);

/// Refuses everything that simplify() would refuse, after the files are read.
Result<void> check_conflicts(const GivenOptions& given, const HeightField& field, const SimplifyOptions& options);

/// Refuses conflicting settings of tiles. If grid and format depend on the raster, they are absent, and only the rest
/// is checked.
Result<void> check_conflicts(const GivenOptions& given, std::optional<GridKind> grid, std::optional<TileFormat> format);

/// The option of the first setting that conflicts with streamed samples; nothing if none does.
std::optional<std::string> find_unstreamed(const GivenOptions& given, const SimplifyPlan& plan);

}  // namespace scarp::cli
