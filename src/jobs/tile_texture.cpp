#include "jobs/tile_texture.h"

#include <algorithm>
#include <utility>

#include "io/mesh/srgb.h"
#include "scarp/tile.h"

namespace scarp::jobs {
namespace {

constexpr int kLeastSide = 256;
/// Largest side of a texture for a tile with children (its side on screen before clients load them), and without.
constexpr int kMostSide = 512, kMostLeafSide = 2048;

int choose_side(const io::GlobeImage& image, const PyramidPlan& plan, TileId id) {
  const DegreeBox box = plan.grid.bounds_of(id);
  const auto [east, north] = image.per_degree();
  const double pixels = std::max((box.east - box.west) * east, (box.north - box.south) * north);
  const int most = id.z >= finest_level(plan, id) ? kMostLeafSide : kMostSide;
  int side = kLeastSide;
  while (side < most && side < pixels) side *= 2;
  return side;
}

}  // namespace

Result<std::optional<io::TileTexture>> make_tile_texture(const io::GlobeImage& image, ImageFormat format,
                                                         const PyramidPlan& plan, TileId id) {
  const int side = choose_side(image, plan, id);
  const DegreeBox tile = plan.grid.bounds_of(id);
  const double more_east = (tile.east - tile.west) / (side - 2), more_north = (tile.north - tile.south) / (side - 2);
  const DegreeBox box{tile.west - more_east, tile.south - more_north, tile.east + more_east, tile.north + more_north};
  std::array<std::uint8_t, 3> ground{};
  for (std::size_t k = 0; k < 3; ++k) ground[k] = io::srgb_of_linear(io::kGroundColor[k]);
  SCARP_TRY(auto&& picture, image.read(box, side, ground));
  if (!picture) return std::optional<io::TileTexture>();
  // The image ends at the poles.
  const auto copy_row = [&](int from, int to) {
    const std::ptrdiff_t row = 3 * std::ptrdiff_t{side};
    const auto begin = picture->rgb.begin();
    std::copy(begin + from * row, begin + (from + 1) * row, begin + to * row);
  };
  if (box.north > 90) copy_row(1, 0);
  if (box.south < -90) copy_row(side - 2, side - 1);
  SCARP_TRY(auto&& bytes, encode_image(*picture, format));
  return std::optional(io::TileTexture{std::move(bytes), format, side});
}

}  // namespace scarp::jobs
