// --solid and --split: a print of the terrain, whole or in print tiles.
#pragma once

#include <optional>
#include <string>

#include "scarp/print.h"
#include "session/options/values.h"

namespace CLI {
class App;
}

namespace scarp::cli {

struct SolidArguments {
  Given solid, split;

  void add_to(CLI::App& command);
  /// Nothing without --solid.
  Result<std::optional<PrintOptions>> parse(std::vector<std::string>& warnings) const;
  std::string canonical() const { return canonical_option("--solid", solid) + canonical_option("--split", split); }
};

/// "hills-r1-c2.stl": the file of a print tile.
std::string tile_path(const std::string& output, int row, int column);

}  // namespace scarp::cli
