// Shapes of triangles for those who compute on them: flow, waves, heat.
#pragma once

#include <array>
#include <cstdint>
#include <optional>

#pragma GCC visibility push(default)

namespace scarp {

/// What triangles shall look like seen from above, in the coordinates of the mesh. Delaunay refinement (Ruppert 1995;
/// Shewchuk 2002; off-centres, Üngör 2004) adds vertices until they do; the error bound holds throughout.
///
/// New vertices lie on samples where triangles are large beside them, else on halves, quarters, … 256ths of a sample,
/// at the height of the raster, which is bilinear between samples; each on a place of its own, and for the sake of
/// angles none nearer to another than 1/32 of a sample (a quarter of max_edge, if that is less). So refinement ends
/// whatever is asked. Outlines are split where they run, lines and cuts within a 256th of a sample of that, at their
/// own heights. More than fast effort then removes and moves what angles, lengths and the bound can do without.
///
/// Guarantees, but for the rounding of positions: (1) no edge is longer than max_edge; (2) grade holds, as below; (3) a
/// triangle with an angle below min_angle is counted in ShapeReport::below. Up to 20 degrees, and without corners of
/// less than 60 degrees between lines or outline, theory leaves few or none; beyond 20 degrees nothing is proven,
/// though on rasters without lines hardly any are left up to 30. Samples very near to lines leave some.
struct ShapeGoals {
  /// Degrees, 0 … 33. DEFAULT: 0, any.
  double min_angle = 0;
  /// In the units of the mesh's x and y; at least an eighth of a sample. DEFAULT: none.
  std::optional<double> max_edge = std::nullopt;
  /// How fast sizes may grow, above 0: no edge is longer than 2·(s + grade·d), where s is the length of the shortest
  /// edge at any vertex and d the way from there, along edges, to its far end. Lengths s below half a sample (of its
  /// longer side) count as half a sample. DEFAULT: none.
  std::optional<double> grade = std::nullopt;

  bool any() const { return min_angle > 0 || max_edge || grade; }
};

/// Shapes of a mesh, seen from above.
struct ShapeReport {
  double min_angle = 0;                        ///< degrees
  double shortest_edge = 0, longest_edge = 0;  ///< in the units of x and y
  std::uint64_t below = 0;                     ///< triangles with an angle of less than was asked
  std::uint64_t forced = 0;                    ///< of these, those at corners between lines or outline
  std::array<std::uint64_t, 12> histogram{};   ///< triangles by their smallest angle: 0 … 5 degrees, …, 55 … 60
};

}  // namespace scarp

#pragma GCC visibility pop
