#include "scarp/tile_set.h"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cctype>
#include <filesystem>
#include <utility>

#include "base/fnv.h"
#include "io/tiles/folder_set.h"
#include "io/tiles/set_archive.h"
#include "scarp/gzip.h"
#include "scarp/io.h"
#include "scarp/tile_job.h"
#include "scarp/tile_waters.h"
#include "scarp/tiles3d.h"

namespace scarp {

namespace {

/// Endings of files that are no set of tiles, besides those of meshes.
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
  if (const Archive* archive = find_archive(path)) return create_archive_set(*archive, path, format, overwrite);
  return create_folder_set(path, format, overwrite);
}

Result<std::unique_ptr<TileSetReader>> open_tile_set(const std::string& path) {
  std::error_code error;
  if (!std::filesystem::exists(path, error))
    return fail(ErrorKind::kInput, fmt::format("no such file or folder: {}", path));
  if (std::filesystem::is_directory(path, error)) return open_folder_set(path);
  if (const Archive* archive = find_archive(path)) return archive->open(path);
  return fail(ErrorKind::kInput,
              fmt::format("{} is no set of tiles: neither a folder nor a .pmtiles, .mbtiles or .3tz", path));
}

TileEncoder make_tile_encoder(TileFormat format, const PyramidPlan& plan) {
  if (format == TileFormat::kGlb)
    return [&plan](const TerrainTile& tile) { return encode_tile_glb(place_on_earth(tile, plan)); };
  std::shared_ptr<const WaterMasks> masks;
  if (plan.has_water_mask && plan.waters) masks = std::make_shared<WaterMasks>(*plan.waters);
  return [&plan, masks](const TerrainTile& tile) {
    const std::vector<std::uint8_t> mask = masks ? masks->draw(tile.id) : std::vector<std::uint8_t>();
    return compress_gzip_of_mesh(encode_quantized_mesh(tile, plan.ellipsoid, plan.grid, mask));
  };
}

TileEncoder make_draped_encoder(const PyramidPlan& plan, std::shared_ptr<const GlobeImage> image, ImageFormat format) {
  return [&plan, image = std::move(image), format](const TerrainTile& tile) -> Result<std::vector<std::uint8_t>> {
    SCARP_TRY(auto&& texture, make_tile_texture(*image, format, plan, tile.id));
    TileGlbOptions options;
    options.texture = std::move(texture);
    return encode_tile_glb(place_on_earth(tile, plan), options);
  };
}

Result<TileEncoder> open_tile_encoder(const TileJob& job) {
  if (!job.drape) return make_tile_encoder(job.format, job.plan);
  SCARP_TRY(auto&& image, open_globe_image(job.drape->path(), job.plan.ellipsoid));
  return make_draped_encoder(job.plan, std::move(image), job.drape->format);
}

std::unique_ptr<TileSetSink> make_tile_sink(TileFormat format, TileSetWriter& writer, const PyramidPlan& plan,
                                            TileEncoder encoder) {
  if (format == TileFormat::kGlb) return std::make_unique<TerrainTilesetSink>(writer, plan, std::move(encoder));
  return std::make_unique<TileSetSink>(writer, format, plan, std::move(encoder));
}

TileSetSink::TileSetSink(TileSetWriter& writer, TileFormat format, const PyramidPlan& plan, TileEncoder encoder)
    : writer_(&writer), plan_(&plan), encoder_(encoder ? std::move(encoder) : make_tile_encoder(format, plan)) {}

Result<std::vector<std::uint8_t>> TileSetSink::encode(const TerrainTile& tile) const { return encoder_(tile); }

Result<void> TileSetSink::put(TileId id, std::span<const std::uint8_t> bytes) {
  Fnv name;
  name.add(std::array{static_cast<std::uint32_t>(id.z), id.x, id.y});
  name.add(bytes);
  hash_ += name.hash();  // sums do not depend on the order
  return writer_->put_tile(id, bytes);
}

std::string TileSetSink::version() const { return fmt::format("{:016x}", hash_); }

Result<void> TileSetSink::put_files(PyramidReport& report, LayerFacts facts) {
  facts.version = version();
  return writer_->put_file("layer.json", encode_layer_json(*plan_, report, facts));
}

}  // namespace scarp
