#include <fmt/format.h>

#include <algorithm>
#include <cerrno>
#include <filesystem>
#include <system_error>
#include <utility>

#include "io/file_reason.h"
#include "io/tiles/byte_source.h"
#include "io/tiles/folder_set.h"
#include "io/tiles/tile_levels.h"
#include "io/tiles/tile_names.h"

namespace scarp::io {
namespace {

class FolderReader final : public TileSetReader {
 public:
  FolderReader(std::string folder, TileFormat format, TileLevels levels, std::vector<std::string> files)
      : folder_(std::move(folder)), format_(format), levels_(std::move(levels)), files_(std::move(files)) {}

  TileFormat format() const override { return format_; }
  const std::vector<std::vector<std::uint64_t>>& tiles() const override { return levels_.levels(); }
  std::vector<std::string> files() const override { return files_; }
  Result<std::vector<std::uint8_t>> read_tile(TileId id) const override {
    if (!levels_.has(id)) return fail_missing(tile_name(format_, id));
    return read(tile_name(format_, id));
  }
  Result<std::vector<std::uint8_t>> read_file(const std::string& name) const override {
    if (!std::binary_search(files_.begin(), files_.end(), name)) return fail_missing(name);
    return read(name);
  }

 private:
  tl::unexpected<Error> fail_missing(const std::string& name) const {
    return fail(ErrorKind::kInput, fmt::format("{} holds no {}", folder_, name));
  }
  Result<std::vector<std::uint8_t>> read(const std::string& name) const {
    SCARP_TRY(const auto& source, ByteSource::open(folder_ + "/" + name));
    return source->read(0, source->size());
  }

  std::string folder_;
  TileFormat format_;
  TileLevels levels_;
  std::vector<std::string> files_;
};

}  // namespace

Result<std::unique_ptr<TileSetReader>> open_folder_set(const std::string& path) {
  namespace fs = std::filesystem;
  TileLevels terrain, glb;
  std::vector<std::string> names_of_glb, files;
  std::error_code error;
  const fs::path folder(path);
  for (auto at = fs::recursive_directory_iterator(folder, error); !error && at != fs::recursive_directory_iterator();
       at.increment(error)) {
    // A link may lead outside the set.
    if (at->symlink_status().type() != fs::file_type::regular) continue;
    std::string name = at->path().lexically_relative(folder).generic_string();
    if (const auto id = find_tile_id(TileFormat::kQuantizedMesh, name)) {
      terrain.add(*id);
    } else if (const auto of_glb = find_tile_id(TileFormat::kGlb, name)) {
      glb.add(*of_glb);
      names_of_glb.push_back(std::move(name));
    } else if (is_plain_name(name)) {
      files.push_back(std::move(name));
    }
  }
  if (error) return fail(ErrorKind::kInput, fmt::format("cannot read {}: {}", path, reason_of(error.value())));
  if (terrain.count() + glb.count() == 0)
    return fail(ErrorKind::kInput,
                fmt::format("{} is no set of tiles: it has no files named z/x/y.terrain or r/z/x/y.glb", path));
  const bool is_terrain = terrain.count() > 0;
  if (is_terrain) files.insert(files.end(), names_of_glb.begin(), names_of_glb.end());
  std::sort(files.begin(), files.end());
  TileLevels& levels = is_terrain ? terrain : glb;
  levels.sort();
  return std::make_unique<FolderReader>(path, is_terrain ? TileFormat::kQuantizedMesh : TileFormat::kGlb,
                                        std::move(levels), std::move(files));
}

}  // namespace scarp::io
