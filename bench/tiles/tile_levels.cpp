// Times tiles level by level, made as in `scarp tile`, from nodes of a raster in memory to compressed bytes.
//
//   tile_levels RASTER [--te W S E N] [--effort fast|normal|high] [--error M] [--zoom Z] [--levels A B] [--tiles N]
//               [--rounds N]
//
// Prints one line per level, from the block's down: the number of tiles (at most N (20) of those completely covered by
// the raster), their triangles and bytes. Then CPU milliseconds per tile (the least of N rounds (3)) to read nodes,
// make the tile, and encode it. A hash of all bytes shows that a change affects only time.

#include <algorithm>
#include <array>
#include <cstdint>
#include <cstdio>
#include <string>
#include <vector>

#include "../speed/field.h"
#include "scarp/tile.h"
#include "scarp/tile_job.h"
#include "scarp/tile_set.h"
#include "tiles/mesh/tile_maker.h"
#include "tiles/mesh/tile_mesh_parts.h"
#include "tiles/mesh/tile_nodes.h"

namespace {

/// Tiles of a level that the raster covers completely; if there are none, tiles that it covers in part.
std::vector<scarp::TileId> choose_tiles(const scarp::PyramidPlan& plan, int z, int most) {
  std::vector<scarp::TileId> whole, all;
  const scarp::DegreeBox& covered = plan.covered;
  const double side = 180.0 / static_cast<double>(std::uint64_t{1} << z);
  const auto first = [&](double from, double origin) { return static_cast<std::uint32_t>((from - origin) / side); };
  for (std::uint32_t y = first(covered.south, -90); y <= first(covered.north, -90); ++y) {
    for (std::uint32_t x = first(covered.west, -180); x <= first(covered.east, -180); ++x) {
      const scarp::DegreeBox box = plan.grid.bounds_of({z, x, y});
      const double slack = side / 1e3;
      all.push_back({z, x, y});
      if (box.west >= covered.west - slack && box.east <= covered.east + slack && box.south >= covered.south - slack &&
          box.north <= covered.north + slack)
        whole.push_back({z, x, y});
    }
  }
  const std::vector<scarp::TileId>& from = whole.empty() ? all : whole;
  std::vector<scarp::TileId> chosen;
  const std::size_t count = std::min(from.size(), static_cast<std::size_t>(most));
  for (std::size_t i = 0; i < count; ++i) chosen.push_back(from[i * from.size() / count]);
  return chosen;
}

}  // namespace

int main(int argc, char** argv) {
  const bench::Arguments arguments(argc, argv,
                                   "tile_levels RASTER [--te W S E N] [--effort fast|normal|high] [--error M] "
                                   "[--zoom Z] [--levels A B] [--tiles N] [--rounds N]");
  scarp::ReadOptions reading;
  reading.with_range = true;
  scarp::PyramidSettings settings;
  if (const auto box = arguments.values("--te"); !box.empty())
    reading.view.extent = std::array{std::stod(box[0]), std::stod(box[1]), std::stod(box[2]), std::stod(box[3])};
  settings.effort = bench::effort_of(arguments.value("--effort", "normal"));
  if (arguments.has("--error")) settings.max_error = arguments.number("--error", 0.0);
  if (arguments.has("--zoom")) settings.max_zoom = arguments.number("--zoom", 0);
  const auto levels = arguments.values("--levels");
  const int first = levels.empty() ? 0 : std::stoi(levels[0]);
  const int last = levels.empty() ? scarp::kMaxTileLevel : std::stoi(levels[1]);
  const int most = arguments.number("--tiles", 20), rounds = arguments.number("--rounds", 3);
  const auto raster = bench::check(scarp::GlobeRaster::open({{arguments[0]}}, reading, {scarp::Vertical::kNone}));
  settings.ellipsoid = raster->place().ellipsoid;
  const scarp::PyramidPlan plan = bench::check(scarp::plan_pyramid(raster->facts(), settings));
  const scarp::TileEncoder encode = scarp::make_tile_encoder(scarp::TileFormat::kQuantizedMesh, plan);
  std::printf("level  tiles  triangles   bytes   read   make  encode  [CPU ms a tile]  hash\n");
  for (int z = std::max(plan.block_level, first); z <= std::min(plan.max_zoom(), last); ++z) {
    const std::vector<scarp::TileId> ids = choose_tiles(plan, z, most);
    std::uint64_t triangles = 0, bytes = 0, hash = 0xcbf29ce484222325;
    std::array<double, 3> sum{};
    for (const scarp::TileId id : ids) {
      std::array<double, 3> least{};
      for (int round = 0; round < rounds; ++round) {
        const std::int32_t steps = scarp::tiles::steps_of(plan, z);
        const bench::Stopwatch watch;
        const auto nodes = bench::check(
            scarp::tiles::TileNodes::read(plan, id, steps, scarp::tiles::normal_reach(steps), raster->nodes()));
        const double is_read = watch.cpu();
        const auto tile =
            bench::check(scarp::tiles::make_tile_of(plan, id, nodes,
                                                    scarp::tiles::proof_at_nodes(plan, nodes, raster->nodes()), {}))
                .tile;
        const double is_made = watch.cpu();
        const auto packed = bench::check(encode(tile));
        const double end = watch.cpu();
        const std::array<double, 3> took{is_read, is_made - is_read, end - is_made};
        for (std::size_t k = 0; k < 3; ++k) least[k] = round == 0 ? took[k] : std::min(least[k], took[k]);
        if (round > 0) continue;
        triangles += tile.triangles.size() / 3;
        bytes += packed.size();
        for (const std::uint8_t byte : packed) hash = (hash ^ byte) * 0x100000001b3;
      }
      for (std::size_t k = 0; k < 3; ++k) sum[k] += least[k];
    }
    const auto count = static_cast<double>(ids.size());
    std::printf("%5d  %5zu  %9.0f  %6.0f  %5.2f  %5.2f   %5.2f                    %016llx\n", z, ids.size(),
                static_cast<double>(triangles) / count, static_cast<double>(bytes) / count, 1e3 * sum[0] / count,
                1e3 * sum[1] / count, 1e3 * sum[2] / count, static_cast<unsigned long long>(hash));
    std::fflush(stdout);
  }
}
