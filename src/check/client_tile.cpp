#include "check/client_tile.h"

#include <algorithm>
#include <cmath>

#include "io/gzip.h"
#include "scarp/tile.h"

namespace scarp::check {
namespace {

/// Size limit of an unpacked tile, so that a few bytes cannot exhaust memory.
constexpr std::size_t kMostBytes = std::size_t{1} << 28;
/// In units of the axes. A point farther out means that the tile is never hidden, since 3D Tiles need a finite point.
constexpr double kFarOut = 100;

Result<ClientTile> take_quantized(QuantizedMesh mesh, const DegreeBox& box, const World& world) {
  ClientTile tile;
  for (std::size_t k = 0; k < mesh.u.size(); ++k) {
    tile.u.push_back(mesh.u[k]);
    tile.v.push_back(mesh.v[k]);
    tile.heights.push_back(mesh.height(k));
    tile.places.push_back(world.place(geographic_at(box, mesh.u[k], mesh.v[k], tile.heights.back())));
  }
  for (const auto& normal : mesh.normals)
    tile.normals.push_back({static_cast<float>(normal[0]), static_cast<float>(normal[1]), 0});
  tile.triangles = std::move(mesh.triangles);
  tile.water_mask = std::move(mesh.water_mask);
  tile.edges = {std::move(mesh.west), std::move(mesh.south), std::move(mesh.east), std::move(mesh.north)};
  tile.centre = mesh.center;
  tile.low = double{mesh.min_height};
  tile.high = double{mesh.max_height};
  tile.sphere_centre = {mesh.sphere[0], mesh.sphere[1], mesh.sphere[2]};
  tile.radius = mesh.sphere[3];
  tile.horizon = mesh.horizon_point;
  return tile;
}

/// At a pole, all longitudes are the same position. This function places a vertex there above the middle of its
/// neighbours.
void place_at_poles(ClientTile& tile, const std::vector<bool>& is_pole) {
  std::vector<double> sum(is_pole.size()), count(is_pole.size());
  for (std::size_t k = 0; k < tile.triangles.size(); ++k) {
    const std::uint32_t vertex = tile.triangles[k];
    if (!is_pole[vertex]) continue;
    for (std::size_t c = k / 3 * 3; c < k / 3 * 3 + 3; ++c) {
      if (is_pole[tile.triangles[c]]) continue;
      sum[vertex] += tile.u[tile.triangles[c]];
      ++count[vertex];
    }
  }
  for (std::size_t k = 0; k < is_pole.size(); ++k) {
    if (is_pole[k] && count[k] > 0) tile.u[k] = sum[k] / count[k];
  }
}

Result<ClientTile> take_glb(io::TileGlb glb, const DegreeBox& box, const World& world, const io::TileFacts* facts) {
  ClientTile tile;
  tile.places = std::move(glb.positions);
  std::vector<bool> is_pole(tile.places.size());
  const double middle = (box.west + box.east) / 2;
  for (std::size_t k = 0; k < tile.places.size(); ++k) {
    Geographic at = world.find(tile.places[k]);
    if (!world.is_flat()) {
      at.longitude += 360 * std::floor((middle - at.longitude) / 360 + 0.5);
      is_pole[k] = std::hypot(tile.places[k][0], tile.places[k][1]) <= 2 * glb.step;
    }
    tile.u.push_back((at.longitude - box.west) / (box.east - box.west) * kWholeTile);
    tile.v.push_back((at.latitude - box.south) / (box.north - box.south) * kWholeTile);
    tile.heights.push_back(at.height);
  }
  for (const auto& normal : glb.normals)
    tile.normals.push_back(
        {static_cast<float>(normal[0]), static_cast<float>(normal[1]), static_cast<float>(normal[2])});
  tile.uvs = std::move(glb.uvs);
  tile.image = std::move(glb.image);
  tile.triangles = std::move(glb.triangles);
  tile.skirt = std::move(glb.skirt);
  tile.skirt_triangles = std::move(glb.skirt_triangles);
  tile.edges = {std::move(glb.west), std::move(glb.south), std::move(glb.east), std::move(glb.north)};
  if (std::find(is_pole.begin(), is_pole.end(), true) != is_pole.end()) place_at_poles(tile, is_pole);
  const io::TileFacts& said = facts != nullptr ? *facts : glb.facts;
  tile.low = said.min_height;
  tile.high = said.max_height;
  tile.sphere_centre = {said.sphere[0], said.sphere[1], said.sphere[2]};
  tile.radius = said.sphere[3];
  tile.horizon = said.horizon_point;
  if (length(tile.horizon) > kFarOut) tile.horizon.fill(NAN);
  tile.resolution = glb.step;
  return tile;
}

}  // namespace

Geographic geographic_at(const DegreeBox& box, double u, double v, double height) {
  return {box.west + (box.east - box.west) * (u / kWholeTile), box.south + (box.north - box.south) * (v / kWholeTile),
          height};
}

Result<ClientTile> decode_client_tile(TileFormat format, std::span<const std::uint8_t> bytes, TileId id,
                                      const TileGrid& grid, const World& world, const io::TileFacts* facts) {
  const std::string name = tile_name(format, id);
  std::vector<std::uint8_t> unpacked;
  if (io::is_gzip(bytes)) {
    auto whole = io::decompress_gzip(bytes, kMostBytes);
    if (!whole) return fail(ErrorKind::kInput, name + " cannot be unpacked: " + whole.error().message);
    unpacked = std::move(*whole);
    bytes = unpacked;
  }
  Result<ClientTile> tile;
  const DegreeBox box = grid.bounds_of(id);
  if (format == TileFormat::kGlb) {
    SCARP_TRY(auto&& glb, io::decode_tile_glb(bytes, name));
    tile = take_glb(std::move(glb), box, world, facts);
  } else {
    SCARP_TRY(auto&& mesh, decode_quantized_mesh(bytes, name));
    tile = take_quantized(std::move(mesh), box, world);
  }
  tile->id = id;
  tile->format = format;
  tile->box = box;
  tile->is_flat = world.is_flat();
  return tile;
}

}  // namespace scarp::check
