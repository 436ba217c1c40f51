// Distance between a tile and the source's own samples, each at its own position.
#pragma once

#include <cstdint>
#include <vector>

#include "check/client_tile.h"

namespace scarp::check {

class SampleJudge {
 public:
  /// Borrows the tile.
  explicit SampleJudge(const ClientTile& tile);

  /// |mesh − height| at a position, 0 … 32767 in each direction; 0 where there is no triangle.
  double error_at(double u, double v, double height) const;

 private:
  static constexpr std::size_t kBuckets = 64;  ///< in each direction
  static std::size_t bucket_of(double place);

  const ClientTile& tile_;
  std::vector<std::vector<std::uint32_t>> buckets_;  ///< first indices of the triangles that may overlap each bucket
};

}  // namespace scarp::check
