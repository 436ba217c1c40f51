// The scan of a triangle in float32 vectors: finds the sample farthest from its plane.
//
// One source is compiled for every instruction set; the best one that the machine supports is chosen at run time. All
// compilations, and the scalar twin, return the same bits. Each sample's error results from the same sequence of
// separately rounded float32 operations everywhere (no fused multiply-add). Among equal errors the first sample in
// raster order wins, so neither the vector width nor the order of work matters.
//
// The computation for the triangle (a, b, c) with heights za, zb, zc and the base a:
//   slopes in double from the differences to a, rounded once to float32: slope_x, slope_y
//   surface(x, y) = slope_x·(x − a.x) + slope_y·(y − a.y)        each product and the sum rounded
//   error(x, y)   = |surface − (z − za)|                          each difference rounded
// Differences of close heights are exact, so rounding errors grow with the relief of the triangle, not with the height
// above sea level. ScanPlane::guard bounds them. If an error lies within the guard of a threshold, the caller decides
// in exact arithmetic.
#pragma once

#include <array>
#include <cstdint>
#include <span>

#include "geom/scan_plane.h"
#include "geom/tile_view.h"

namespace scarp::geom {

struct ScanHit {
  float error = 0;   ///< 0: no sample's computed error is above scan_floor(threshold, guard). Then none exceeds the
                     ///< threshold if guard <= threshold; otherwise exact arithmetic must decide
  TilePoint at = 0;  ///< the first sample in raster order with that error
  float guard = 0;   ///< ScanPlane::guard, set even if there is no hit; the sample is certainly above the threshold if
                     ///< error > threshold + guard
};

/// The limit that a computed error must exceed: threshold − guard, never below 0.
inline float scan_floor(double threshold, float guard) {
  return static_cast<float>(greater(threshold - double{guard}, 0));
}

/// Rows shorter than this are faster without vectors.
constexpr std::int32_t kMinVectorRow = 16;

struct ScanKernels {
  const char* name;  ///< Highway's name: "AVX3", "AVX2", "SSE4", "NEON", "WASM", "EMU128", …; "SCALAR": the twin

  /// hits[i] = the farthest sample of the closed triangle i, if its computed error is above the floor. `hints` are
  /// points likely to have large errors (candidates of the previous triangles). They shorten the search in large
  /// triangles and never change a hit. Nodata samples are ignored. Returns the number of samples and blocks compared
  /// with a plane, a statistic that is the same for all vector kernels but not for the scalar twin. REQUIRES: corners
  /// are valid samples of the tile, orient > 0; every |height| of the tile <= kMaxScanHeight; threshold >= 0.
  std::uint64_t (*scan)(const TileView& tile, double threshold, std::span<const std::array<TilePoint, 3>> triangles,
                        std::span<const TilePoint> hints, ScanHit* hits);

  /// Fills the block arrays of a tile, including their padding, from its samples. `low` and `high` are the arrays
  /// behind tile.block_low and block_high. Returns the largest |height|; sets `nodata` to the number of NaN samples.
  float (*fill_blocks)(const TileView& tile, float* low, float* high, std::uint64_t& nodata);

  /// For x in [0, count): error = |base + slope · (offset + x) − samples[x]| in double, each operation rounded, as
  /// Plane::height_at() does. If the largest error exceeds `worst`, stores it there and the first such x in `at`, and
  /// returns true. NaN samples are ignored. Equals the plain metric's row bit for bit. REQUIRES: sums of `offset` and
  /// integers up to `count` are exact.
  bool (*scan_row)(const float* samples, std::int32_t count, double base, double slope, double offset, double& worst,
                   std::int32_t& at);
};

/// The kernels in use: the best set of this machine, or the one that the environment variable SCARP_KERNEL names (any
/// name of available_kernels(), in upper or lower case; other names are ignored). Chosen at the first call.
const ScanKernels& scan_kernels();

/// All kernels that run on this machine, best first, the scalar twin last.
std::span<const ScanKernels> available_kernels();

}  // namespace scarp::geom
