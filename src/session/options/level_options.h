// --lods, --lods-in-one and --lock-border: meshes that meet their neighbours and replace each other.
#pragma once

#include <optional>
#include <string>

#include "scarp/levels.h"
#include "session/options/output_kind.h"
#include "session/options/values.h"

namespace CLI {
class App;
}

namespace scarp::cli {

struct LevelArguments {
  Given lods;
  bool in_one = false, locks_border = false;

  void add_to(CLI::App& command);
  /// Nothing without --lods. Fails where the value is none, and for an OUTPUT that holds no levels.
  Result<std::optional<Levels>> parse(const OutputFormat& format, const std::string& output) const;
  std::string canonical() const;
};

/// hills.glb → hills_lod0.glb, the finest.
std::string level_path(const std::string& output, int level);

}  // namespace scarp::cli
