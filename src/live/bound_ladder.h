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

  friend bool operator==(const CellBounds&, const CellBounds&) = default;
};

/// A rung is 2^(1/4) times the one below. Cells climb from rung to rung in the order of their slots, one by one and in
/// 16 small steps, a level each: at most one cell stands between two rungs. So two cells differ by one rung at most,
/// and a cell that climbs changes one or two of its neighbours: borders have the smaller bound of their two cells. No
/// bound is below the field's max error.
class BoundLadder {
 public:
  /// Bounds of 2^-150 to 2^150.
  static constexpr std::int64_t kLowest = -600, kHighest = 600;

  BoundLadder(const CellLattice& lattice, double max_error, bool has_budget);

  /// Levels between two rungs.
  std::int64_t step() const { return slots_ * kSmallSteps; }
  /// The level where all cells stand on the rung at or below a bound.
  std::int64_t level_of(double bound) const;
  CellBounds bounds_of(SampleAt cell, std::int64_t level) const;
  /// True if each cell's bound is the max error, or the lowest rung.
  bool is_lowest(std::int64_t level) const;
  bool is_highest(std::int64_t level) const { return level >= kHighest * step(); }

 private:
  static constexpr std::int64_t kSmallSteps = 16;

  double bound_of(SampleAt cell, std::int64_t level) const;

  CellLattice lattice_;
  double max_error_;
  bool has_budget_;
  std::int64_t slots_;
};

/// The search for a level whose mesh has at least 98 % of a budget and not more than all of it.
class LevelSearch {
 public:
  LevelSearch(std::uint64_t budget, std::int64_t step) : budget_(budget), step_(step) {}

  /// The next level to try, or none: the search ends at `level`, whose mesh has so many triangles. `is_finest`: a lower
  /// level would not change the mesh.
  std::optional<std::int64_t> next(std::int64_t level, std::uint64_t triangles, bool is_finest);

 private:
  struct Trial {
    std::int64_t level = 0;
    double triangles = 0;
  };
  std::int64_t estimate(const Trial& now) const;

  std::uint64_t budget_;
  std::int64_t step_;
  int tries_ = 0;
  std::optional<Trial> over_, within_;  // the highest level above the budget, the lowest one within it
  std::optional<Trial> last_;
};

}  // namespace scarp::live
