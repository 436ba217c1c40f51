// Times the scan kernels: nanoseconds a triangle, for triangles of given extent and every instruction set of this
// machine.
//
//   speed_kernels RASTER COLS ROWS ERROR     a Markdown table; the upper left 4097 × 4097 samples of RASTER at most
//
// Triangles are random, in boxes of a given side at most, and asked about in fans of six near each other, as the
// refinement does. No hints.

#include <algorithm>
#include <array>
#include <limits>
#include <random>

#include "base/point.h"
#include "geom/scan_kernels.h"
#include "raw.h"

namespace {

struct Tile {
  std::vector<float> samples, low, high;
  scarp::TileView view;
};

void fill_tile(const bench::RawRaster& raster, Tile& tile) {
  scarp::TileView& view = tile.view;
  view.cols = std::min(raster.cols, scarp::kMaxTileSide);
  view.rows = std::min(raster.rows, scarp::kMaxTileSide);
  view.stride = view.cols + scarp::kTilePadding;
  view.block_stride = (view.cols + scarp::kBlock - 1) / scarp::kBlock + scarp::kTilePadding;
  tile.samples.resize(static_cast<std::size_t>(view.stride * (view.rows + scarp::kTilePadding)));
  for (int y = 0; y < view.rows; ++y)
    std::copy_n(raster.samples.data() + static_cast<std::ptrdiff_t>(y) * raster.cols, view.cols,
                tile.samples.data() + y * view.stride);
  tile.low.resize(static_cast<std::size_t>(view.block_stride * ((view.rows + scarp::kBlock - 1) / scarp::kBlock)));
  tile.high.resize(tile.low.size());
  view.samples = tile.samples.data();
  view.block_low = tile.low.data();
  view.block_high = tile.high.data();
}

using Triangles = std::vector<std::array<scarp::TilePoint, 3>>;

/// Fans of six in raster order of their places, so that memory is met about once, as in a local refinement.
Triangles draw_triangles(const scarp::TileView& view, int side, int count) {
  std::mt19937 random(1);
  const auto below = [&](int n) { return static_cast<int>(random() % static_cast<unsigned>(n)); };
  std::vector<scarp::Point> places;
  for (int i = 0; i < count / 6; ++i) places.push_back({below(view.cols - side + 1), below(view.rows - side + 1)});
  std::sort(places.begin(), places.end(),
            [](scarp::Point a, scarp::Point b) { return a.y / 64 != b.y / 64 ? a.y < b.y : a.x < b.x; });
  Triangles triangles;
  for (const scarp::Point place : places) {
    for (int k = 0; k < 6;) {
      std::array<scarp::Point, 3> p;
      for (scarp::Point& corner : p) corner = {place.x + below(side), place.y + below(side)};
      if (orient(p[0], p[1], p[2]) < 0) std::swap(p[1], p[2]);
      if (orient(p[0], p[1], p[2]) <= 0) continue;
      triangles.push_back(
          {scarp::tile_point(p[0].x, p[0].y), scarp::tile_point(p[1].x, p[1].y), scarp::tile_point(p[2].x, p[2].y)});
      ++k;
    }
  }
  return triangles;
}

/// Shortest of several rounds.
double seconds(const scarp::ScanKernels& kernels, const scarp::TileView& view, double error, const Triangles& triangles,
               double& hit_share) {
  std::vector<scarp::ScanHit> hits(triangles.size());
  double least = std::numeric_limits<double>::infinity();
  for (int round = 0; round < 5; ++round) {
    const bench::Stopwatch watch;
    for (std::size_t i = 0; i < triangles.size(); i += 6)
      kernels.scan(view, error, {triangles.data() + i, 6}, {}, hits.data() + i);
    least = std::min(least, watch.cpu());
  }
  const auto found = std::count_if(hits.begin(), hits.end(), [](const scarp::ScanHit& hit) { return hit.error > 0; });
  hit_share = static_cast<double>(found) / static_cast<double>(hits.size());
  return least;
}

}  // namespace

int main(int argc, char** argv) {
  if (argc != 5) bench::die("usage: speed_kernels RASTER COLS ROWS ERROR");
  Tile tile;
  fill_tile(bench::read_raw(argv[1], argv[2], argv[3]), tile);
  const double error = std::atof(argv[4]);
  const auto all = scarp::available_kernels();
  std::printf("| box side | hits |");
  for (const auto& kernels : all) std::printf(" %s |", kernels.name);
  std::printf("\n|---|---|");
  for (std::size_t i = 0; i < all.size(); ++i) std::printf("---|");
  std::printf("\n| blocks, ms | |");
  for (const auto& kernels : all) {
    double least = std::numeric_limits<double>::infinity();
    for (int round = 0; round < 5; ++round) {
      std::uint64_t nodata = 0;
      const bench::Stopwatch watch;
      kernels.fill_blocks(tile.view, tile.low.data(), tile.high.data(), nodata);
      least = std::min(least, watch.cpu());
    }
    std::printf(" %.2f |", least * 1e3);
  }
  std::printf("\n");
  for (const int side : {4, 8, 12, 16, 24, 32, 48, 64, 96, 128, 256, 512, 1024}) {
    if (side > tile.view.cols || side > tile.view.rows) break;
    const Triangles triangles = draw_triangles(tile.view, side, side <= 64 ? 60000 : 6000000 / side / 8);
    std::string line;
    double share = 0;
    for (const auto& kernels : all) {
      const double each = seconds(kernels, tile.view, error, triangles, share) / static_cast<double>(triangles.size());
      char cell[32];
      std::snprintf(cell, sizeof cell, " %.1f |", each * 1e9);
      line += cell;
    }
    std::printf("| %d | %.0f %% |%s\n", side, share * 100, line.c_str());
  }
}
