// The bounds of cells under a budget of triangles: a ladder of bounds, on which cells climb one by one.
#pragma once

#include <array>
#include <cstdint>
#include <optional>

#include "live/cell_lattice.h"
#include "scarp/height_field.h"
#include "scarp/live.h"

namespace scarp::live {

/// Bounds of a cell's samples and of the lines on its borders: top, bottom, left, right.
struct CellBounds {
  double inside = 0;
  std::array<double, 4> borders = {};
};

/// A rung is 2^(1/4) times the one below. Cells climb from rung to rung in the order of their slots, one by one, in 64
/// small steps of one level each. At most one cell stands between two rungs. So two cells differ by one rung at most,
/// and a cell that climbs changes one or two of its neighbours: borders have the smaller bound of their two cells. No
/// bound is below the field's max error.
class BoundLadder {
 public:
  BoundLadder(const CellLattice& lattice, double max_error, bool has_budget);

  /// Levels between two rungs.
  std::int64_t step() const { return slots_ * kSmallSteps; }
  /// Bounds are 2^-150 to 2^150.
  std::int64_t lowest() const { return -kRange * step(); }
  std::int64_t highest() const { return kRange * step(); }
  /// The level where all cells stand on the rung at or below a bound.
  std::int64_t level_of(double bound) const;
  CellBounds bounds_of(SampleAt cell, std::int64_t level) const;
  /// True if the cell has the same bounds at both levels.
  bool is_same(SampleAt cell, std::int64_t level, std::int64_t other) const {
    return heights_of(cell, level) == heights_of(cell, other);
  }

 private:
  static constexpr std::int64_t kSmallSteps = 64, kRange = 600;

  /// Heights on the ladder in small steps: of the cell, and of the lower one of the cell and each neighbour (top,
  /// bottom, left, right).
  std::array<std::int64_t, 5> heights_of(SampleAt cell, std::int64_t level) const;

  CellLattice lattice_;
  double max_error_;
  bool has_budget_;
  std::int64_t slots_;
};

/// The number of triangles that counts as using a budget: 98 % of it.
inline std::uint64_t enough(std::uint64_t budget) { return budget - budget / 50; }

/// The search for a level whose mesh has at least 98 % of the triangles of a budget and not more than all of them.
class LevelSearch {
 public:
  /// `least`: a mesh with at least this many triangles needs no search.
  LevelSearch(const BoundLadder& ladder, std::uint64_t budget, std::uint64_t least)
      : ladder_(ladder), budget_(budget), least_(least) {}

  /// The next level to try; none if the search has ended. `triangles`: those of the mesh at `level`. The flags: whether
  /// another level can change it.
  std::optional<std::int64_t> next(std::int64_t level, std::uint64_t triangles, bool can_be_finer, bool can_be_coarser);
  /// The level where the search ended: in the range, else the lowest level tried that is within the budget; none if
  /// there is no such level.
  std::optional<std::int64_t> found() const { return found_; }

 private:
  std::int64_t estimate(std::int64_t level, double surplus) const;

  const BoundLadder& ladder_;
  std::uint64_t budget_, least_;
  int tries_ = 0;
  std::optional<std::int64_t> over_, within_, found_;  // `over_`: the highest level above the budget; `within_`: the
                                                       // lowest one below the range
};

}  // namespace scarp::live
