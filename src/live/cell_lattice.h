// The lattice of cells: which cells an area has, and the slot of each.
#pragma once

#include <cstdint>
#include <vector>

#include "live/sample_ring.h"
#include "scarp/height_field.h"

namespace scarp::live {

/// Cells are numbered by column and row of the lattice, whose lines run through sample (0, 0). Neighbours share the
/// samples on their border.
class CellLattice {
 public:
  /// `cols`, `rows`: the size of the field.
  CellLattice(std::int32_t side, std::int32_t cols, std::int32_t rows)
      : side_(side), slot_cols_((cols - 2) / side + 2), slot_rows_((rows - 2) / side + 2) {}

  std::int32_t side() const { return side_; }
  std::uint32_t slot_count() const { return static_cast<std::uint32_t>(slot_cols_ * slot_rows_); }
  /// No two cells of a field have the same slot, wherever the field lies.
  std::uint32_t slot_of(SampleAt cell) const {
    return static_cast<std::uint32_t>(modulo(cell.row, slot_rows_) * slot_cols_ + modulo(cell.col, slot_cols_));
  }

  Area area_of(SampleAt cell) const {
    const std::int32_t west = cell.col * side_, north = cell.row * side_;
    return {west, north, west + side_, north + side_};
  }
  /// Cells that share more than a border with the field, row by row.
  std::vector<SampleAt> cells_of(const Area& field) const { return list(within(field)); }
  /// The cells of `field` that have a sample of the area `samples`.
  std::vector<SampleAt> cells_with(const Area& samples, const Area& field) const {
    const Area with{divide_down(samples.west - 1), divide_down(samples.north - 1), divide_down(samples.east),
                    divide_down(samples.south)};
    return list(with.clipped(within(field)));
  }

 private:
  std::int32_t divide_down(std::int32_t value) const { return (value - modulo(value, side_)) / side_; }
  Area within(const Area& field) const {
    return {divide_down(field.west), divide_down(field.north), divide_down(field.east - 1),
            divide_down(field.south - 1)};
  }
  static std::vector<SampleAt> list(const Area& cells) {
    std::vector<SampleAt> all;
    for (std::int32_t row = cells.north; row <= cells.south; ++row) {
      for (std::int32_t col = cells.west; col <= cells.east; ++col) all.push_back({col, row});
    }
    return all;
  }

  std::int32_t side_, slot_cols_, slot_rows_;
};

}  // namespace scarp::live
