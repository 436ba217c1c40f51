// Points on disk, sorted into blocks of neighbours.
#pragma once

#include <array>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <span>
#include <vector>

#include "scarp/point_blocks.h"
#include "scarp/result.h"

namespace scarp::io {

/// Points in an unnamed file in the folder for temporary files, which vanishes with this object. Each needs 48 bytes
/// there. First add() all points, then divide().
class PointSpool final : public PointBlocks {
 public:
  PointSpool() = default;
  ~PointSpool() override;

  /// Fails with kOutput if there is no space. REQUIRES: equal sizes.
  Result<void> add(std::span<const double> x, std::span<const double> y, std::span<const double> z);
  /// Sorts the points into blocks of at most `most`, each of neighbours; points at one place keep their order. Uses
  /// some 25 MB of memory. Fails with kMemory if more than `most` points lie within 2^-10 of the extent.
  Result<void> divide(std::uint64_t most);
  /// Replaces the points of a block by as many or fewer.
  Result<void> replace(std::size_t block, const PointSet& points);

  std::uint64_t size() const override { return size_; }
  std::size_t block_count() const override { return blocks_.size(); }
  Result<PointSet> read(std::size_t block) const override;

 private:
  struct Place {
    double x, y, z;
  };
  struct Block {
    std::uint64_t first, count;  // in places of the file
  };
  class Cells;

  Result<void> write(std::uint64_t first, std::span<const Place> places);
  Result<void> read(std::uint64_t first, std::span<Place> places) const;
  template <class Visit>
  Result<void> visit_added(const Visit& visit) const;

  int file_ = -1;
  std::uint64_t size_ = 0;
  std::vector<Block> blocks_;
  std::array<double, 2> least_{HUGE_VAL, HUGE_VAL}, most_{-HUGE_VAL, -HUGE_VAL};
};

}  // namespace scarp::io
