// --lods and --lock-border: meshes that meet their neighbours and can replace each other.
#pragma once

#include <optional>
#include <string>

#include "scarp/simplify.h"
#include "session/options/given_options.h"
#include "session/options/output_kind.h"

namespace scarp::cli {

/// Nothing without --lods. Fails for an invalid value or an OUTPUT format without levels.
Result<std::optional<Levels>> parse_levels(const GivenOptions& given, const OutputFormat& format);

/// The path of a level: hills.glb → hills_lod0.glb, the finest.
std::string level_path(const std::string& output, int level);

}  // namespace scarp::cli
