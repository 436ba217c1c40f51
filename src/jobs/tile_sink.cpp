#include <fmt/format.h>

#include <array>
#include <utility>

#include "base/fnv.h"
#include "io/globe_image.h"
#include "io/gzip.h"
#include "io/tiles3d.h"
#include "jobs/tile_texture.h"
#include "scarp/tile.h"
#include "scarp/tile_job.h"
#include "tiles/water/tile_waters.h"

namespace scarp {

namespace {

/// The encoder for kGlb, with a texture of the image on each tile.
TileEncoder make_draped_encoder(const PyramidPlan& plan, std::shared_ptr<const io::GlobeImage> image,
                                ImageFormat format) {
  return [&plan, image = std::move(image), format](const TerrainTile& tile) -> Result<std::vector<std::uint8_t>> {
    SCARP_TRY(auto&& texture, jobs::make_tile_texture(*image, format, plan, tile.id));
    io::TileGlbOptions options;
    options.texture = std::move(texture);
    return io::encode_tile_glb(io::place_on_earth(tile, plan), options);
  };
}

class TerrainTilesetSink final : public TileSetSink {
 public:
  TerrainTilesetSink(TileSetWriter& writer, const PyramidPlan& plan, TileEncoder encoder)
      : TileSetSink(writer, TileFormat::kGlb, plan, std::move(encoder)) {}

  Result<void> put(TileId id, std::span<const std::uint8_t> bytes) override {
    SCARP_TRY(const io::TileFacts& facts, io::read_tile_facts(bytes));
    facts_[{id.z, id.y, id.x}] = facts;
    return TileSetSink::put(id, bytes);
  }

  /// Writes the files of encode_tileset(). Adds lattice_error() to the bounds.
  Result<void> put_files(PyramidReport& report, LayerFacts facts) override {
    facts.version = version();
    for (const io::NamedFile& file : io::encode_tileset(plan(), report, facts_, facts)) {
      SCARP_RETURN_IF_ERROR(writer().put_file(file.name, file.bytes));
    }
    for (std::size_t z = 0; z < report.levels.size(); ++z)
      report.levels[z].bound += io::lattice_error(plan(), static_cast<int>(z));
    return {};
  }

 private:
  io::FactsByTile facts_;
};

}  // namespace

TileEncoder make_tile_encoder(TileFormat format, const PyramidPlan& plan) {
  if (format == TileFormat::kGlb)
    return [&plan](const TerrainTile& tile) { return io::encode_tile_glb(io::place_on_earth(tile, plan)); };
  std::shared_ptr<const tiles::WaterMasks> masks;
  if (plan.has_water_mask && plan.waters) masks = std::make_shared<tiles::WaterMasks>(*plan.waters);
  return [&plan, masks](const TerrainTile& tile) {
    const std::vector<std::uint8_t> mask = masks ? masks->draw(tile.id) : std::vector<std::uint8_t>();
    return io::compress_gzip_of_mesh(encode_quantized_mesh(tile, plan.ellipsoid, plan.grid, mask));
  };
}

Result<TileEncoder> open_tile_encoder(const TileJob& job) {
  if (!job.drape) return make_tile_encoder(job.format, job.plan);
  SCARP_TRY(auto&& image, io::open_globe_image(job.drape->path(), job.plan.ellipsoid));
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
