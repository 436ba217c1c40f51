// Quantized-mesh tiles, made on demand from a raster in degrees or in web Mercator.
#include <algorithm>
#include <cmath>
#include <limits>
#include <memory>
#include <numbers>
#include <utility>
#include <vector>

#include "door.h"
#include "scarp/tile.h"

namespace scarp::wasm {
namespace {

/// EPSG:3857: WGS 84's longitude and latitude on a sphere, in metres.
constexpr double kRadius = 6378137, kRadians = std::numbers::pi / 180;

/// Replaces all values by f of them, which is slow; rows repeat the value.
void replace(std::span<double> values, auto&& f) {
  double last = 0, result = f(0);
  for (double& value : values) {
    if (value != last) result = f(last = value);
    value = result;
  }
}

class MercatorOfDegrees final : public PointTransform {
 public:
  bool apply(std::span<double> x, std::span<double> y) const override {
    for (double& value : x) value *= kRadians * kRadius;
    replace(y, [](double degrees) { return kRadius * std::asinh(std::tan(degrees * kRadians)); });
    return std::all_of(y.begin(), y.end(), [](double metres) { return std::isfinite(metres); });
  }
};

class DegreesOfMercator final : public PointTransform {
 public:
  bool apply(std::span<double> x, std::span<double> y) const override {
    for (double& value : x) value /= kRadians * kRadius;
    replace(y, [](double metres) { return std::atan(std::sinh(metres / kRadius)) / kRadians; });
    return true;
  }
};

}  // namespace

struct Tiler {
  HeightField field;  ///< JavaScript's samples
  std::unique_ptr<NodeSource> nodes;
  PyramidPlan plan;
  std::vector<std::vector<std::uint64_t>> lists;  ///< by level; found on the first request
};

/// Like PyramidSettings; Field::geotransform is in degrees, or in metres of web Mercator.
struct TilerSettings {
  double is_mercator;
  double cells, max_zoom, max_error, quality, effort, background;
};

struct Bytes {
  std::vector<std::uint8_t> bytes;
};

struct TileView {
  double bytes, size, triangles, vertices;
  double node_error, bound, source_error;
};

namespace {

Result<SourceFacts> find_facts(const HeightField& field, const RasterPlace& place) {
  SCARP_TRY(const auto& covered, degrees_covered(field, place.affine, place.to_degrees.get()));
  const HeightRange range = height_range(field);
  if (range.valid == 0) return fail(ErrorKind::kInput, "none of the samples is a height");
  const double cell_x = std::hypot(place.affine[1], place.affine[4]);
  const double cell_y = std::hypot(place.affine[2], place.affine[5]);
  if (place.to_degrees == nullptr) {
    const auto metres = metres_of_unit((covered.south + covered.north) / 2);
    return SourceFacts{covered, std::sqrt(cell_x * metres[0] * cell_y * metres[1]), range.min, range.max,
                       std::sqrt(cell_x * cell_y)};
  }
  // The cell is in metres of the map, as in the program.
  return SourceFacts{covered, std::sqrt(cell_x * cell_y), range.min, range.max, 0};
}

}  // namespace
}  // namespace scarp::wasm

using namespace scarp::wasm;
using scarp::Result;

SCARP_EXPORT(scarp_tiler_create)
Tiler* scarp_tiler_create(const Field* given_field, const TilerSettings* asked) {
  return give<Tiler>([&]() -> Result<std::unique_ptr<Tiler>> {
    SCARP_TRY(auto&& field, take_field(*given_field));
    if (field.cols < 2 || field.rows < 2)
      return scarp::fail(scarp::ErrorKind::kInput, "tiles need at least 2 x 2 samples");
    auto tiler = std::make_unique<Tiler>();
    tiler->field = std::move(field);
    scarp::RasterPlace place{affine_of(*given_field)};
    if (asked->is_mercator != 0) {
      place.from_degrees = std::make_shared<MercatorOfDegrees>();
      place.to_degrees = std::make_shared<DegreesOfMercator>();
    }
    SCARP_TRY(const auto& facts, find_facts(tiler->field, place));
    scarp::PyramidSettings settings;
    settings.cells = static_cast<int>(asked->cells);
    settings.max_zoom = static_cast<int>(asked->max_zoom);
    settings.max_error = asked->max_error;
    settings.quality = asked->quality;
    settings.effort = static_cast<scarp::Effort>(asked->effort);
    settings.background = static_cast<float>(asked->background);
    SCARP_TRY(tiler->plan, scarp::plan_pyramid(facts, settings));
    SCARP_TRY(tiler->nodes, scarp::make_node_source(tiler->field, place));
    return tiler;
  });
}
SCARP_EXPORT(scarp_tiler_max_zoom) double scarp_tiler_max_zoom(const Tiler* tiler) { return tiler->plan.max_zoom(); }
SCARP_EXPORT(scarp_tiler_free) void scarp_tiler_free(Tiler* tiler) { delete tiler; }

SCARP_EXPORT(scarp_tiler_tile)
Bytes* scarp_tiler_tile(const Tiler* tiler, double z, double x, double y, TileView* out) {
  return give<Bytes>([&]() -> Result<std::unique_ptr<Bytes>> {
    const scarp::PyramidPlan& plan = tiler->plan;
    const scarp::TileId id{static_cast<int>(z), static_cast<std::uint32_t>(x), static_cast<std::uint32_t>(y)};
    if (!plan.grid.has(id) || id.z > plan.max_zoom())
      return scarp::fail(scarp::ErrorKind::kUsage,
                         "there is no such tile: z goes from 0 to maxZoom, x from 0 to 2^(z + 1) - 1, "
                         "and y from 0 to 2^z - 1, from the south");
    SCARP_TRY(const auto& tile, scarp::make_tile(plan, id, *tiler->nodes));
    auto made = std::make_unique<Bytes>();
    made->bytes = scarp::encode_quantized_mesh(tile, plan.ellipsoid, plan.grid);
    *out = {address_of(made->bytes.data()),
            static_cast<double>(made->bytes.size()),
            static_cast<double>(tile.triangles.size() / 3),
            static_cast<double>(tile.u.size()),
            tile.node_error,
            tile.bound(),
            tile.source_error};
    return made;
  });
}
/// The tiles that have heights, and those through which clients reach them: pairs of column and row, as uint32.
SCARP_EXPORT(scarp_tiler_list) Bytes* scarp_tiler_list(Tiler* tiler, double level, TileView* out) {
  return give<Bytes>([&]() -> Result<std::unique_ptr<Bytes>> {
    if (tiler->lists.empty()) {
      SCARP_TRY(tiler->lists, scarp::find_tiles(tiler->plan, tiler->nodes.get(), {.threads = 1}));
    }
    std::vector<std::uint32_t> pairs;
    for (const std::uint64_t tile : tiler->lists.at(static_cast<std::size_t>(level))) {
      pairs.push_back(static_cast<std::uint32_t>(tile));
      pairs.push_back(static_cast<std::uint32_t>(tile >> 32));
    }
    auto made = std::make_unique<Bytes>();
    const auto* const bytes = reinterpret_cast<const std::uint8_t*>(pairs.data());
    made->bytes.assign(bytes, bytes + pairs.size() * sizeof pairs[0]);
    *out = {address_of(made->bytes.data()), static_cast<double>(made->bytes.size()), 0, 0, 0, 0, 0};
    return made;
  });
}
SCARP_EXPORT(scarp_bytes_free) void scarp_bytes_free(Bytes* bytes) { delete bytes; }
