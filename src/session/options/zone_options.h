// Materials by polygon and node strings along lines, for flow models.
#pragma once

#include <string>
#include <vector>

#include "scarp/features.h"
#include "scarp/height_field.h"
#include "scarp/zones.h"
#include "session/options/output_kind.h"
#include "session/options/values.h"

namespace CLI {
class App;
}

namespace scarp::cli {

struct ZoneArguments {
  Given materials, field;
  std::vector<std::string> strings;

  void add_to(CLI::App& command);
  /// Refuses options that need others, and outputs that have no place for it.
  Result<void> check(const OutputFormat& format) const;
  /// The option that asks for lines in the mesh; null if there is none.
  const char* find_lines() const;
  std::string canonical() const;
};

}  // namespace scarp::cli
