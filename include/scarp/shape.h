// Triangle shapes for simulation meshes: flow, waves, heat.
#pragma once

#include <array>
#include <cstdint>
#include <optional>

#pragma GCC visibility push(default)

namespace scarp {

/// Goals for the shapes of triangles seen from above, in the coordinates of the mesh. Delaunay refinement (Ruppert
/// 1995; Shewchuk 2002; off-centres, Üngör 2004) adds vertices until the goals are met; the error bound holds
/// throughout.
///
/// Where goals cannot all be kept, the later one yields, and how much is counted in ShapeReport: (1) the error bound;
/// (2) lines, cutlines and outlines, where they run; (3) max_edge and grade, which always hold; (4) min_angle; (5)
/// min_edge; (6) few triangles. A triangle with a smallest angle of a and a shortest edge of s is at least s·sin(a)
/// high, which is what the time step of a flow solver follows; a long edge at a small angle does not help it.
///
/// New vertices lie on samples where triangles are large compared with them, else on halves, quarters, … 256ths of a
/// sample, at the height of the raster, which is bilinear between samples. No two share a lattice point. Vertices added
/// for angles keep 1/32 of a sample (a quarter of max_edge, if that is less) from all others. So refinement always
/// ends. Outlines are split exactly; lines and cuts are split within a 256th of a sample, at their own heights. Efforts
/// above fast then remove and move the vertices that angles, lengths and the bound do not need. High effort also makes
/// the mesh of normal effort, max that of high, and the one with fewer triangles is the result, unless the time is up.
///
/// Guarantees, up to the rounding of positions: (1) no edge is longer than max_edge; (2) grade holds, as below; (3)
/// each triangle with an angle below min_angle is counted in ShapeReport::below. Up to 20 degrees, and without corners
/// of less than 60 degrees between lines or outline, theory predicts few or none. Beyond 20 degrees nothing is proven,
/// but on rasters without lines hardly any are left up to 30. Some are left where lines, or a line and a sample that
/// the bound needs, run closer together than vertices for angles may.
struct ShapeGoals {
  /// Degrees, 0 … 33. DEFAULT: 0, any.
  double min_angle = 0;
  /// In the units of the mesh's x and y; at least an eighth of a sample. DEFAULT: none.
  std::optional<double> max_edge = std::nullopt;
  /// Growth rate of edge lengths, above 0. No edge is longer than 2·(s + grade·d): s is the length of the shortest edge
  /// at any vertex, d the distance from that vertex, along edges, to the far end of the edge. An s below half a sample
  /// (of its longer side) counts as that. DEFAULT: none.
  std::optional<double> grade = std::nullopt;
  /// Shortest edge, in the units of the mesh's x and y, above 0, at most half of max_edge: the time step of a flow
  /// solver follows the shortest edge. All other goals come first: edges that they need stay shorter, and are counted
  /// in ShapeReport::shorter. Vertices added for max_edge and grade make no edge shorter than this but where they halve
  /// one that is too long. Efforts above fast remove vertices at shorter edges first, and make no edge shorter than one
  /// that they remove, or this. DEFAULT: none.
  std::optional<double> min_edge = std::nullopt;

  bool any() const { return min_angle > 0 || max_edge || grade || min_edge; }
};

/// Shapes of a mesh, seen from above.
struct ShapeReport {
  double min_angle = 0;                        ///< degrees
  double shortest_edge = 0, longest_edge = 0;  ///< in the units of x and y
  std::uint64_t below = 0;                     ///< triangles with an angle below min_angle
  std::uint64_t forced = 0;                    ///< number of these at corners between lines or outline
  std::uint64_t below_beside_lines = 0;        ///< number of the others with a corner on lines or outline
  std::uint64_t shorter = 0;                   ///< edges shorter than min_edge
  std::uint64_t shorter_beside_lines = 0;      ///< number of these with an end on lines or outline
  std::array<std::uint64_t, 12> histogram{};   ///< triangles by their smallest angle: 0 … 5 degrees, …, 55 … 60
};

}  // namespace scarp

#pragma GCC visibility pop
