// Sets of tiles as folders.
#pragma once

#include <memory>
#include <string>

#include "scarp/tile_set.h"

namespace scarp::io {

Result<std::unique_ptr<TileSetWriter>> create_folder_set(const std::string& path, TileFormat format, bool overwrite);
Result<std::unique_ptr<TileSetReader>> open_folder_set(const std::string& path);

}  // namespace scarp::io
