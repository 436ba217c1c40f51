// --lods and --lock-border: meshes that meet their neighbours and replace each other.
#pragma once

#include <optional>
#include <string>

#include "scarp/simplify.h"
#include "session/options/given_options.h"
#include "session/options/output_kind.h"

namespace scarp::cli {

/// Nothing without --lods. Fails where the value is none, and for an OUTPUT that holds no levels.
Result<std::optional<Levels>> parse_levels(const GivenOptions& given, const OutputFormat& format);

/// hills.glb → hills_lod0.glb, the finest.
std::string level_path(const std::string& output, int level);

}  // namespace scarp::cli
