// The two surfaces of `scarp measure --volume`: two meshes, or a mesh and a level.
#pragma once

#include <array>
#include <optional>
#include <string>

#include "scarp/result.h"
#include "session/options/given_options.h"

namespace scarp::cli {

struct GivenSurface {
  std::string path;                            ///< file of a mesh
  std::optional<double> level = std::nullopt;  ///< height of "level=512.5"

  /// The name in sentences: "before.glb", "level 512.5".
  std::string name() const;
};

/// The surfaces before and after. kUsage unless there are two, if both are levels, or if a level is no number.
Result<std::array<GivenSurface, 2>> parse_surfaces(const GivenOptions& given);

}  // namespace scarp::cli
