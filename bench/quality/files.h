// The inputs and outputs of the programs of bench/quality.
#pragma once

#include <cstdio>
#include <cstdlib>
#include <filesystem>
#include <fstream>
#include <map>
#include <optional>
#include <string>
#include <vector>

namespace bench {

/// The project's own copy in data/, else the one in $SCARP_SHARED/data or next to the project in ../shared/data.
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

/// Prints the reason; returns the program's exit code where something is missing.
inline int fail_with(const std::string& sentence) {
  std::fprintf(stderr, "%s\n", sentence.c_str());
  return 2;
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

/// The rows of the table at `path` with those of the raster `name` replaced by the ones of `fresh`, which begins with
/// the header; in the order of `names`, rows of others are dropped. A table with another header counts as empty.
inline std::string replace_rows(const char* path, const std::string& fresh, const std::string& name,
                                const std::vector<std::string>& names) {
  std::ifstream file(path);
  std::string header, line;
  std::getline(file, header);
  const std::string fresh_header = fresh.substr(0, fresh.find('\n'));
  std::map<std::string, std::string> rows;
  while (header == fresh_header && std::getline(file, line)) rows[line.substr(0, line.find(','))] += line + "\n";
  rows[name] = fresh.substr(fresh_header.size() + 1);
  std::string table = fresh_header + "\n";
  for (const std::string& each : names) table += rows[each];
  return table;
}

}  // namespace bench
