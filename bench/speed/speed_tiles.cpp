// The costs and gains of tiles and coarse starts: the dominant order in tiles of a given side, each started from two
// triangles, compared with the engine with the same side, which starts from a coarser raster where that pays.
//
//   speed_tiles RASTER COLS ROWS ERROR SIDE...     one JSON line a side; a side above the raster's: one tile
//
// Borders stay fixed: vertices are what they cost. One thread.

#include <algorithm>
#include <optional>
#include <vector>

#include "engines.h"
#include "pieces/border_chain.h"
#include "pieces/tiling.h"
#include "refine/dominant.h"
#include "refine/tile_domain.h"
#include "tin/assembly.h"

namespace {

template <typename T>
T check(scarp::Result<T> result) {
  if (!result) bench::die(result.error().message);
  return std::move(*result);
}

std::vector<scarp::TilePoint> find_border(const scarp::HeightField& field, const scarp::TileWindow& window,
                                          const scarp::SharedSides& shared, double threshold) {
  std::vector<scarp::TilePoint> border;
  for (const scarp::BorderLine& line : scarp::shared_lines(window, shared)) {
    for (const std::int32_t step : check(scarp::simplify_border(field, line, threshold)))
      border.push_back(scarp::tile_point(line.col - window.col + (line.is_vertical ? 0 : step),
                                         line.row - window.row + (line.is_vertical ? step : 0)));
  }
  return border;
}

/// Vertices of all tiles, each started from two triangles.
std::size_t refine_plainly(const scarp::HeightField& field, double threshold, int side) {
  const scarp::Tiling tiling(field.cols, field.rows, side);
  scarp::Assembly assembly(tiling.per_row());
  scarp::Tile tile;
  scarp::TileMesh mesh;
  scarp::PieceMaker pieces;
  for (std::size_t i = 0; i < tiling.count(); ++i) {
    const scarp::TileWindow window = tiling.window(i);
    if (const auto loaded = tile.load(field, window); !loaded) bench::die(loaded.error().message);
    const auto border = find_border(field, window, tiling.shared(i), threshold);
    if (const auto started = scarp::start_tile(tile, border, mesh); !started) bench::die(started.error().message);
    scarp::TileScanner scanner(tile.view(), threshold);
    scanner.set_shared(tiling.shared(i));
    scarp::refine_dominant(mesh, scanner);
    assembly.append(pieces.make(mesh, {window.col, window.row}, window.cols, window.rows));
  }
  return assembly.vertex_count();
}

std::size_t refine_by_engine(const scarp::HeightField& field, double threshold, int side) {
  scarp::TiledOptions options;
  options.threshold = threshold;
  options.threads = 1;
  options.tile_side = side;
  const auto tiled = check(scarp::refine_tiled(field, options));
  return tiled ? tiled->domain.tin.vertex_count() : 0;
}

template <typename Refine>
void print_run(int side, const char* start, Refine refine) {
  const bench::Stopwatch watch;
  const std::size_t vertices = refine();
  std::printf("{\"side\": %d, \"start\": \"%s\", \"vertices\": %zu, %s}\n", side, start, vertices,
              bench::json_of(watch.read()).c_str());
}

}  // namespace

int main(int argc, char** argv) {
  if (argc < 6) bench::die("usage: speed_tiles RASTER COLS ROWS ERROR SIDE...");
  const bench::RawRaster raster = bench::read_raw(argv[1], argv[2], argv[3]);
  const double error = std::atof(argv[4]);
  const scarp::HeightField field = bench::field_of(raster);
  for (int i = 5; i < argc; ++i) {
    const int side = std::atoi(argv[i]);
    print_run(side, "two triangles", [&] { return refine_plainly(field, error, side); });
    print_run(side, "coarse", [&] { return refine_by_engine(field, error, side); });
  }
}
