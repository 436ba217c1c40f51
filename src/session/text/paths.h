// The facts that a file's name holds.
#pragma once

#include <string>

namespace scarp::cli {

/// The path's extension in lower case, with its point (".png"); empty if there is none.
std::string lower_extension(const std::string& path);
/// True if the path can be a set of tiles: a folder, or a file with the ending of an archive of tiles.
bool names_tile_set(const std::string& path);
/// True if writing to the path is writing to standard output ("-", /dev/stdout).
bool is_stdout(const std::string& path);

}  // namespace scarp::cli
