// The part that a row of tiles has of a cut.
//
//     row above, done ───────┬──────    walls are cut where rows meet, as all lines are, so each row has whole ones.
//     row at hand    stays │wall        Those along the line between two rows are both rows', and each asks on which
//     ────────────────═══════───────    side of them it lies.
#pragma once

#include <array>
#include <cstdint>
#include <functional>
#include <optional>
#include <vector>

#include "lines/constraints.h"

namespace scarp {

class RowCut {
 public:
  /// `graph`: of the whole raster, its edges cut where rows meet. Stays alive.
  explicit RowCut(const ConstraintGraph& graph);

  /// Of a row of `rows` rows of samples from `first` on, in its own coordinates; nothing where nothing is cut.
  /// `number_of`: of a point of the graph, its number in the row.
  std::optional<SurfaceCut> part_of(std::int32_t first, std::int32_t rows,
                                    const std::function<std::uint32_t(std::uint32_t)>& number_of) const;

 private:
  const ConstraintGraph& graph_;
  std::vector<std::array<std::uint32_t, 2>> walls_;  // by their upper ends, as the next
  std::vector<std::array<Point, 2>> outline_;
};

}  // namespace scarp
