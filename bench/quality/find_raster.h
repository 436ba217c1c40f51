// Where the programs of bench/quality find their rasters.
#pragma once

#include <cstdlib>
#include <filesystem>
#include <optional>
#include <string>

namespace bench {

/// The project's own copy in data/, else the one in $SCARP_SHARED/data or beside the project in ../shared/data.
inline std::optional<std::string> find_raster(const std::filesystem::path& project, const std::string& name) {
  const char* variable = std::getenv("SCARP_SHARED");
  const std::filesystem::path shared = variable != nullptr ? std::filesystem::path(variable) : project / "../shared";
  for (const auto& path : {project / "data" / name, shared / "data" / name}) {
    std::error_code ignored;
    if (std::filesystem::is_regular_file(path, ignored)) return path.string();
  }
  return std::nullopt;
}

}  // namespace bench
