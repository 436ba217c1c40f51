// Cracks, which are steps between neighbouring samples of a raster, and the chains that they form.
//
// A crack lies between two samples that are neighbours in a row or column and differ by more than a given height. In a
// cell of four samples with two cracked sides, a wall enters at one of these sides and leaves at the other. So cracks
// form chains, with all high samples on the left (rows count downwards) and all low samples on the right. A line that
// crosses the cracks of a chain in order separates high from low samples.
//
// Samples are read once, from the top down, three rows at a time, so rasters may be larger than memory.
#pragma once

#include <array>
#include <cstdint>
#include <functional>
#include <utility>
#include <vector>

#include "base/point.h"

namespace scarp::features {

struct Crack {
  Point high, low;                ///< samples
  float top = 0, foot = 0;        ///< their heights
  bool is_before_saddle = false;  ///< the chain passes twice through the cell between this crack and the next
  friend bool operator==(const Crack&, const Crack&) = default;
};

struct CrackChain {
  std::vector<Crack> cracks;  ///< successive cracks are two sides of a cell of four heights
  bool is_ring = false;       ///< the last crack connects to the first
};

/// All cracks between samples that differ by more than `height`, each in one chain. A chain ends at a cell with one
/// crack, three cracks, two contradictory cracks, or nodata. A cell with four cracks, a saddle, is passed twice, around
/// the two samples that differ more. Cost: O(samples + n log n) for n cracks.
class CrackChains {
 public:
  /// `is_left_out`: true for samples whose cracks are ignored.
  CrackChains(std::int32_t cols, std::int32_t rows, double height, std::function<bool(Point)> is_left_out)
      : cols_(cols), rows_(rows), height_(height), is_left_out_(std::move(is_left_out)) {}

  /// Scans a row. `above` and `below`: the neighbouring rows, null at the top and the bottom. Nodata is NaN. REQUIRES:
  /// one call for each row, from the top down.
  void add_row(std::int32_t row, const float* above, const float* here, const float* below);
  /// REQUIRES: all rows have been scanned.
  void link();
  /// Visits chains in raster order of their first cracks, rings last. REQUIRES: link().
  void visit(const std::function<void(const CrackChain&)>& visit) const;

  std::uint64_t count() const { return sides_.size(); }  ///< number of cracks
  static constexpr std::uint64_t kBytesPerCrack = 40;    ///< while rows are added; fewer afterwards

 private:
  /// A crack between a sample and its neighbour on the right or below.
  struct Side {
    std::uint64_t key;  // in raster order; the right side before the lower one
    float from, to;
  };
  /// Sides of a cell, clockwise from the upper one: side k joins corners k and k + 1.
  using Cell = std::array<std::uint32_t, 4>;
  enum Flag : std::uint8_t { kIsAheadWhole = 1, kHasPrevious = 2, kIsBeforeSaddle = 4 };

  std::uint64_t key_of(Point from, bool is_down) const {
    return 2 * (static_cast<std::uint64_t>(from.y) * static_cast<std::uint64_t>(cols_) +
                static_cast<std::uint64_t>(from.x)) +
           (is_down ? 1 : 0);
  }
  Point from_of(const Side& side) const;
  Point cell_ahead(const Side& side) const;
  Crack crack_of(std::uint32_t i) const;
  std::uint32_t find(std::uint64_t key) const;
  float corner(const Cell& cell, std::size_t k) const;
  bool goes_out(const Cell& cell, std::size_t k) const;
  void link(std::uint32_t i);

  std::int32_t cols_, rows_;
  double height_;
  std::function<bool(Point)> is_left_out_;
  std::vector<Side> sides_;  // in raster order
  std::vector<std::uint8_t> flags_;
  std::vector<std::uint32_t> next_;
};

}  // namespace scarp::features
