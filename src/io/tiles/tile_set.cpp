#include "scarp/tile_set.h"

#include <fmt/format.h>

#include <algorithm>
#include <cctype>
#include <filesystem>
#include <utility>

#include "io/tiles/folder_set.h"
#include "io/tiles/set_archive.h"
#include "scarp/io.h"

namespace scarp {

namespace {

/// Extensions of files that are no tile sets, in addition to mesh formats.
constexpr const char* kEndingsOfFiles[] = {"terrain", "json", "b3dm", "gltf", "zip", "html",
                                           "tif",     "tiff", "png",  "pgm",  "svg", "eps"};

bool is_named_like_a_file(const std::string& path) {
  std::string ending = std::filesystem::path(path).extension().string();
  if (ending.size() < 2) return false;
  if (find_mesh_format(path)) return true;
  for (char& c : ending) c = static_cast<char>(std::tolower(static_cast<unsigned char>(c)));
  return std::ranges::count(kEndingsOfFiles, ending.substr(1)) > 0;
}

}  // namespace

Result<void> check_set_name(const std::string& path) {
  if (path.empty()) return fail(ErrorKind::kUsage, "OUTPUT is empty: give the name of a set of tiles to make");
  std::error_code error;
  if (!is_named_like_a_file(path) || std::filesystem::is_directory(path, error)) return {};
  return fail(
      ErrorKind::kUsage,
      fmt::format("{}: a set of tiles is a folder, or one .pmtiles, .mbtiles or .3tz file: give such a name, or "
                  "{}/ for a folder of that name",
                  path, path));
}

Result<std::unique_ptr<TileSetWriter>> create_tile_set(const std::string& path, TileFormat format, bool overwrite) {
  SCARP_RETURN_IF_ERROR(check_set_name(path));
  if (const io::Archive* archive = io::find_archive(path))
    return io::create_archive_set(*archive, path, format, overwrite);
  return io::create_folder_set(path, format, overwrite);
}

Result<std::unique_ptr<TileSetReader>> open_tile_set(const std::string& path) {
  std::error_code error;
  if (!std::filesystem::exists(path, error))
    return fail(ErrorKind::kInput, fmt::format("no such file or folder: {}", path));
  if (std::filesystem::is_directory(path, error)) return io::open_folder_set(path);
  if (const io::Archive* archive = io::find_archive(path)) return archive->open(path);
  return fail(ErrorKind::kInput,
              fmt::format("{} is no set of tiles: neither a folder nor a .pmtiles, .mbtiles or .3tz", path));
}

}  // namespace scarp
