// The outline of a raster, decided edge by edge: rasters that share a row or a column of samples, simplified apart,
// then meet without a gap, and so do levels of detail of one raster.
#pragma once

#include <cstdint>
#include <optional>
#include <span>
#include <vector>

#pragma GCC visibility push(default)

namespace scarp {

/// Samples of the four edges of a raster, ascending: columns of its first (top) and last (bottom) row, rows of its
/// first (left) and last (right) column.
struct EdgeVertices {
  std::vector<std::int32_t> top, bottom, left, right;
};

/// Heights one row above and below a raster, and one column to its left and right: those that its neighbours have. NaN
/// is nodata; an empty list is not known.
struct BeyondEdges {
  std::vector<float> top, bottom, left, right;
};

/// The edge of the raster as a line that nothing but the edge's own samples decides.
///
/// On each edge the vertices of the mesh are those of the line, whatever the effort: none is added, removed or moved,
/// and they have their samples' heights. Samples of the edge between two vertices lie on the line to within their
/// bounds. Where nodata lies right behind an edge whose samples are valid, corners of the surface's outline may lie
/// between two vertices of the line; they are more vertices, at the line's height, rounded to float32.
///
/// Normals at an edge are a function of what both neighbours know: its own samples, and those beyond it on either side
/// where these are given (`beyond`). Where they are not, the surface counts as level across the edge.
///
/// Breaklines may end at vertices of the line and nowhere else on an edge; the others need them given (`vertices`).
///
/// One thread refines such a mesh, with the samples in memory and two copies of them, 8 bytes a sample; see Order.
struct Border {
  bool is_locked = false;  ///< DEFAULT: false, edges are simplified with the surface.
  /// Max error of the line, at most that of the goals. DEFAULT: that of the goals, and where the samples have
  /// tolerances or weights, theirs. A search for a budget's mesh does not change the line.
  std::optional<double> max_error = std::nullopt;
  /// The line itself. Corners, and the first and last sample of each run of valid ones, are vertices anyway. DEFAULT:
  /// that of simplify_edge().
  std::optional<EdgeVertices> vertices = std::nullopt;
  /// For normals; each list as long as its edge, or empty. DEFAULT: not known. See read_beyond().
  BeyondEdges beyond = {};
};

/// The vertices of an edge, ascending: as few as a line from sample to sample can have that passes every sample at no
/// more than 511/512 of `tolerance` (or of its own of `tolerances`, +infinity for none, where these are given). The
/// rest is for the rounding of positions. NaN is nodata: the first and the last sample of each run of heights are
/// vertices. Among lines of as few vertices it is the one whose last vertices come first. No segment spans more than
/// 8192 steps, so that the cost is O(samples · 8192) at worst, and mostly a few steps a sample. The same numbers give
/// the same vertices on every machine.
std::vector<std::int32_t> simplify_edge(std::span<const float> heights, double tolerance,
                                        std::span<const double> tolerances = {});

}  // namespace scarp

#pragma GCC visibility pop
