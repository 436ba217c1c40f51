// Any tile and any triangles: all scan kernels of this machine give the bits of the scalar kernel. The bytes choose the
// size, the heights (few levels, nodata, extreme magnitudes), the threshold, then triangles and hints with two bytes
// per coordinate.
#include <cmath>
#include <cstdint>
#include <cstdlib>
#include <cstring>
#include <limits>
#include <vector>

#include "base/point.h"
#include "bytes.h"
#include "geom/scan_kernels.h"

namespace {

void require(bool holds) {
  if (!holds) std::abort();
}

constexpr std::int32_t kMaxSide = 300;
constexpr std::size_t kPattern = 61;  ///< number of heights from bytes, which the tile repeats with slow changes

struct Tile {
  std::vector<float> samples, low, high;
  scarp::geom::TileView view;

  explicit Tile(Bytes& bytes) {
    view.cols = 2 + bytes.below(kMaxSide - 1);
    view.rows = 2 + bytes.below(kMaxSide - 1);
    view.stride = view.cols + scarp::geom::kTilePadding;
    const std::int32_t blocks = (view.cols + scarp::geom::kBlock - 1) / scarp::geom::kBlock;
    view.block_stride = blocks + scarp::geom::kTilePadding;
    samples.assign(static_cast<std::size_t>(view.stride * (view.rows + scarp::geom::kTilePadding)),
                   std::numeric_limits<float>::quiet_NaN());
    const int levels = bytes.next() % 250 + 1;
    const float step = std::ldexp(1.0F, bytes.next() % 160 - 80), drift = step * static_cast<float>(bytes.next()) / 64;
    float pattern[kPattern];
    for (float& z : pattern) {
      const std::uint8_t byte = bytes.next();
      z = byte >= 250 ? std::numeric_limits<float>::quiet_NaN() : static_cast<float>(byte % levels) * step;
    }
    for (std::int32_t y = 0; y < view.rows; ++y) {
      for (std::int32_t x = 0; x < view.cols; ++x) {
        const std::size_t k = static_cast<std::size_t>(x + y * 7 + x * y / 50) % kPattern;
        samples[static_cast<std::size_t>(y * view.stride + x)] = pattern[k] + drift * static_cast<float>(x / 9 + y / 5);
      }
    }
    low.resize(
        static_cast<std::size_t>(view.block_stride * ((view.rows + scarp::geom::kBlock - 1) / scarp::geom::kBlock)));
    high.resize(low.size());
    view.samples = samples.data();
    view.block_low = low.data();
    view.block_high = high.data();
  }

  /// Uses the scalar kernel, the reference.
  void fill_blocks() {
    const auto all = scarp::geom::available_kernels();
    std::uint64_t nodata = 0;
    const float most = all.back().fill_blocks(view, low.data(), high.data(), nodata);
    const std::vector<float> expected_low = low, expected_high = high;
    for (const scarp::geom::ScanKernels& kernels : all) {
      std::uint64_t also_nodata = 0;
      require(kernels.fill_blocks(view, low.data(), high.data(), also_nodata) == most && also_nodata == nodata);
      require(low == expected_low && high == expected_high);
    }
  }
};

scarp::Point draw_point(Bytes& bytes, const scarp::geom::TileView& view) {
  const std::int32_t x = bytes.below(view.cols);
  return {x, bytes.below(view.rows)};
}

void check_scan(const Tile& tile, double threshold, const std::vector<std::array<scarp::geom::TilePoint, 3>>& triangles,
                const std::vector<scarp::geom::TilePoint>& hints) {
  const auto all = scarp::geom::available_kernels();
  std::vector<scarp::geom::ScanHit> expected(triangles.size()), hits(triangles.size());
  all.back().scan(tile.view, threshold, triangles, {}, expected.data());
  for (const scarp::geom::ScanKernels& kernels : all) {
    kernels.scan(tile.view, threshold, triangles, hints, hits.data());
    for (std::size_t i = 0; i < hits.size(); ++i) {
      require(std::memcmp(&hits[i].error, &expected[i].error, sizeof(float)) == 0);
      require(hits[i].at == expected[i].at && hits[i].guard == expected[i].guard);
    }
  }
}

}  // namespace

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  Bytes bytes(data, size);
  Tile tile(bytes);
  tile.fill_blocks();
  const double threshold = std::ldexp(bytes.next(), bytes.next() % 160 - 88);
  std::vector<scarp::geom::TilePoint> hints(bytes.next() % 8);
  for (scarp::geom::TilePoint& hint : hints) {
    const scarp::Point p = draw_point(bytes, tile.view);
    hint = scarp::geom::tile_point(p.x, p.y);
  }
  std::vector<std::array<scarp::geom::TilePoint, 3>> triangles;
  while (bytes.left() > 0 && triangles.size() < 50) {
    std::array<scarp::Point, 3> p{draw_point(bytes, tile.view), draw_point(bytes, tile.view),
                                  draw_point(bytes, tile.view)};
    if (orient(p[0], p[1], p[2]) < 0) std::swap(p[1], p[2]);
    std::array<scarp::geom::TilePoint, 3> corners{};
    bool valid = orient(p[0], p[1], p[2]) > 0;
    for (std::size_t i = 0; i < 3; ++i) {
      corners[i] = scarp::geom::tile_point(p[i].x, p[i].y);
      valid = valid && !std::isnan(tile.view.at(corners[i]));
    }
    if (valid) triangles.push_back(corners);
  }
  check_scan(tile, threshold, triangles, hints);
  return 0;
}
