// What the programs of bench/quality read and write.
#pragma once

#include <cstdio>
#include <cstdlib>
#include <filesystem>
#include <fstream>
#include <optional>
#include <string>
#include <vector>

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

/// The lines of bench/quality/rasters.txt that are not comments.
inline std::vector<std::string> read_names(const std::filesystem::path& list) {
  std::vector<std::string> names;
  std::ifstream file(list);
  for (std::string line; std::getline(file, line);) {
    if (!line.empty() && line[0] != '#') names.push_back(line);
  }
  return names;
}

/// Writes the table; the program's exit code.
inline int write_table(const char* path, const std::string& table) {
  std::ofstream file(path, std::ios::binary);
  file << table;
  file.close();
  if (file) return 0;
  std::fprintf(stderr, "cannot write %s\n", path);
  return 4;
}

}  // namespace bench
