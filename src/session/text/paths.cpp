#include "session/text/paths.h"

#include <cctype>
#include <filesystem>
#include <system_error>

namespace scarp::cli {

std::string lower_extension(const std::string& path) {
  std::string extension = std::filesystem::path(path).extension().string();
  for (char& c : extension) c = static_cast<char>(std::tolower(static_cast<unsigned char>(c)));
  return extension;
}

bool names_tile_set(const std::string& path) {
  std::error_code error;
  const std::string ending = lower_extension(path);
  return ending == ".pmtiles" || ending == ".mbtiles" || ending == ".3tz" || std::filesystem::is_directory(path, error);
}

bool is_stdout(const std::string& path) { return path == "-" || path == "/dev/stdout"; }

}  // namespace scarp::cli
