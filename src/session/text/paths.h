// Facts derived from file names.
#pragma once

#include <string>

namespace scarp::cli {

/// The path's extension in lower case with its dot (".png"), or empty.
std::string lower_extension(const std::string& path);
/// True if the path can be a tileset: a folder, or a file with a tile archive's ending.
bool names_tile_set(const std::string& path);
/// True if writing to the path writes to standard output ("-", /dev/stdout).
bool is_stdout(const std::string& path);

}  // namespace scarp::cli
