// The common parts of all containers that hold a tile set in one file.
#pragma once

#include <memory>
#include <string>

#include "io/staged_file.h"
#include "io/tiles/byte_source.h"
#include "io/tiles/tile_spool.h"
#include "scarp/tile_set.h"

namespace scarp::io {

/// A container format. write() sorts the spool and writes the whole file; the caller then calls StagedFile::end().
/// open() fails with kInput.
struct Archive {
  std::string_view ending;
  Result<void> (*write)(TileSpool& spool, TileFormat format, StagedFile& file);
  Result<std::unique_ptr<TileSetReader>> (*open)(const std::string& path);
};

/// The format by the path's extension, in upper or lower case; null for folders.
const Archive* find_archive(const std::string& path);

Result<std::unique_ptr<TileSetWriter>> create_archive_set(const Archive& archive, const std::string& path,
                                                          TileFormat format, bool overwrite);

/// Buffers bytes for a file.
class ChunkedOutput {
 public:
  explicit ChunkedOutput(StagedFile& file) : file_(&file) {}
  Result<void> add(std::span<const std::uint8_t> bytes);
  Result<void> flush();
  std::uint64_t position() const { return position_; }

 private:
  StagedFile* file_;
  std::vector<std::uint8_t> waiting_;
  std::uint64_t position_ = 0;
};

/// The metadata of the set in its container, copied from layer.json if present.
struct SetFacts {
  std::string name = "terrain", description, attribution;
  DegreeBox bounds{-180, -90, 180, 90};
  TileGrid grid = {};
};
SetFacts facts_of(const TileSpool& spool);

/// The name of a format in containers.
std::string_view media_type(TileFormat format);

Result<void> write_pmtiles(TileSpool& spool, TileFormat format, StagedFile& file);
Result<std::unique_ptr<TileSetReader>> open_pmtiles(const std::string& path);
Result<void> write_mbtiles(TileSpool& spool, TileFormat format, StagedFile& file);
Result<std::unique_ptr<TileSetReader>> open_mbtiles(const std::string& path);
/// The last entry of a .3tz, which locates the others.
inline constexpr std::string_view kIndexOf3tz = "@3dtilesIndex1@";
Result<void> write_3tz(TileSpool& spool, TileFormat format, StagedFile& file);
Result<std::unique_ptr<TileSetReader>> open_3tz(const std::string& path);

}  // namespace scarp::io
