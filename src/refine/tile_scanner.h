// Finds the candidates of a tile's triangles.
#pragma once

#include <cstdint>
#include <span>
#include <vector>

#include "base/bits.h"
#include "geom/scan_kernels.h"
#include "metric/height_metric.h"
#include "tin/tile_mesh.h"

namespace scarp::refine {

/// The candidate of a triangle, as TileMesh's key: the error's bits above the complement of the candidate's point. So
/// the larger key is the larger error, or the first point in raster order among equal errors; 0: no candidate.
constexpr std::int64_t candidate_key(float error, geom::TilePoint at) {
  return error > 0 ? static_cast<std::int64_t>(std::uint64_t{bit_cast<std::uint32_t>(error)} << 32 |
                                               static_cast<std::uint32_t>(~at))
                   : 0;
}
constexpr geom::TilePoint candidate_of(std::int64_t key) { return ~static_cast<geom::TilePoint>(key); }

/// Sides of a tile that it shares with a neighbour.
struct SharedSides {
  bool left = false, top = false, right = false, bottom = false;
};

/// Compares heights with one threshold: the guarantee of the plain metric, with the kernels' arithmetic. A triangle's
/// candidate is the sample with the largest error that exceeds the threshold in exact arithmetic.
class TileScanner {
 public:
  /// The tile's samples must outlive this. REQUIRES: each is at most kMaxScanHeight in magnitude.
  TileScanner(const geom::TileView& tile, double threshold, const geom::ScanKernels& kernels = geom::scan_kernels());

  /// Sets candidate_key() of each triangle that is not outside. `hints`: see ScanKernels::scan.
  void scan(tin::TileMesh& mesh, std::span<const tin::TileMesh::Id> triangles, std::span<const geom::TilePoint> hints);

  /// Sets the sides on which no sample can break its bound, whichever points are inserted. If exact arithmetic fails
  /// there (for heights whose magnitudes span some 2^90), the sample is no candidate and has_given_up() is true.
  void set_shared(const SharedSides& sides) { shared_ = sides; }
  bool has_given_up() const { return has_given_up_; }

  double threshold() const { return threshold_; }
  std::uint64_t samples_scanned() const { return samples_; }
  std::uint64_t triangles_scanned() const { return triangles_; }

 private:
  void settle(tin::TileMesh::Record& record);
  bool is_on_shared_side(Point p) const;

  const geom::ScanKernels& kernels_;
  geom::TileView tile_;
  double threshold_;
  metric::HeightMetric metric_;  // decides if float32 cannot
  SharedSides shared_;
  bool has_given_up_ = false;
  std::vector<std::array<geom::TilePoint, 3>> corners_;
  std::vector<tin::TileMesh::Id> ids_;
  std::vector<geom::ScanHit> hits_;
  std::uint64_t samples_ = 0, triangles_ = 0;
};

}  // namespace scarp::refine
