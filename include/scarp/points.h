// Make a mesh of scattered points, which read_points() of io.h reads.
//
// Example:
//     SCARP_TRY(const auto& survey, scarp::read_points("survey.csv"));
//     SCARP_TRY(const auto& made, scarp::simplify_points(survey, {.max_error = 5}));
//     std::printf("%zu triangles for %llu points\n", made.simplified.mesh.triangle_count(),
//                 static_cast<unsigned long long>(made.points));
#pragma once

#include <array>
#include <cstdint>
#include <optional>
#include <span>
#include <string>
#include <vector>

#include "scarp/height_field.h"
#include "scarp/lines.h"
#include "scarp/mesh.h"
#include "scarp/result.h"
#include "scarp/run.h"
#include "scarp/simplify.h"
#include "scarp/tolerances.h"

#pragma GCC visibility push(default)

namespace scarp {

/// The middle of the points' extent, rounded so coarsely that offsets from it are exact: the origin of a local frame.
/// REQUIRES: some points, finite.
std::array<double, 2> local_origin(const PointSet& points);

/// Appends the points and lines of another set, with its counts and warnings. Fails with kInput if the sets differ in
/// CRS or unit, or have local frames; with kUsage for a boundary.
Result<void> append_points(const PointSet& more, PointSet& points);

/// Sorts the points along a curve through the plane, so that neighbours in the plane are neighbours in memory. For
/// millions of points in random order, simplify_points() then needs about two thirds of the time. Points at one place
/// keep their order; indices in lines and the boundary are adapted. Meshes and errors do not depend on it. A set with a
/// coordinate that is not finite stays as it is. REQUIRES: fewer than 2^32 points. Cost: O(n), with 32 bytes a point
/// while it runs.
void sort_points(PointSet& points);

/// Drops outliers such as birds and reflections in lidar: points whose height differs by more than `most` from all, or
/// all but one, of their 8 nearest neighbours (ties: the first). Points of lines stay, as does a set with a coordinate
/// that is not finite. Adds the outliers to PointSet::spikes, and returns their number. REQUIRES: most >= 0, no
/// boundary yet. Cost: expected O(n) for points of even density.
std::uint64_t drop_spikes(double most, int threads, PointSet& points);

struct SimplifiedPoints {
  Simplified simplified;         ///< measurement: errors at the points as given; `samples` counts points
  std::uint64_t points = 0;      ///< number given
  std::uint64_t duplicates = 0;  ///< number of points given up for another at their place (equal x and y)
  std::uint64_t on_hull = 0;     ///< corners of the hull, convex or concave
  double lattice_step = 0;       ///< step of the integer lattice, in units of x and y
  std::uint64_t flat = 0;        ///< triangles whose corners lie on lines at one height
  std::uint64_t loose = 0;       ///< pieces of lines that are no edges, since they cross others of their height
  HullFit hull_fit;              ///< without boundary_length and lines
};

/// Adds lines, in the coordinates of the points, as edges of the mesh: their vertices become points. A vertex without a
/// height (NaN) gets that of the Delaunay triangulation of the points given, beyond their hull that of the hull's
/// nearest place. `duplicates`: which points of one place count. Returns how many lie beyond. Fails with kInput for
/// points that have no surface. Cost: O(vertices), with vertices without a height expected O(n log n) for n points.
Result<std::uint64_t> add_lines(std::span<const Line> lines, PointSet& points,
                                DuplicatePolicy duplicates = DuplicatePolicy::kFirst);

/// A lake that level_lakes() made.
struct PointLake {
  double level = 0;           ///< a float32; NaN for a lake that lies beyond the points: it is omitted
  std::uint64_t dropped = 0;  ///< number of points in it given up
  std::uint64_t beyond = 0;   ///< vertices of its shore beyond the points' hull, which the surface then reaches
};

/// Makes lakes of polygons: drops the points in them and adds their rings, holes included, as lines at one height, so
/// that all triangles of a lake are level. That height is a percentile, 0 … 100, of the Delaunay triangulation of all
/// points, along the rings; lakes that meet at a vertex have one. To be called after add_lines(). Fails with kInput for
/// points that have no surface, for a line with a vertex in a lake at another height, and for a lake around all points.
/// REQUIRES: polygons that do not cross or overlap, as inset_polygons() returns. Cost: expected O(n log n).
Result<std::vector<PointLake>> level_lakes(std::span<const Line> rings, double percentile, PointSet& points,
                                           DuplicatePolicy duplicates = DuplicatePolicy::kFirst);

/// Drops the points in polygons, given as rings, and all lines; returns how many points. For the judge of a mesh with
/// such lakes.
std::uint64_t drop_inside(std::span<const Line> rings, PointSet& points);

/// Unit normals of the Delaunay triangulation of the points at the vertices of a mesh in their coordinates, as
/// Mesh::normals: by differences of heights over the mean distance between points. Near the hull, and for points with
/// lines, normals of the mesh's triangles around the vertex, by area. Fails with kInput for points that have no
/// surface. Cost: expected O(n log n).
Result<std::vector<float>> point_normals(const PointSet& points, const Mesh& mesh,
                                         DuplicatePolicy duplicates = DuplicatePolicy::kFirst);

/// The result of cut_to_boundary().
struct BoundaryCut {
  std::uint64_t points_outside = 0;  ///< number of points given up
  std::uint64_t corners = 0;         ///< points added: corners of the boundary, and where lines cross it
  std::uint64_t corners_beyond = 0;  ///< corners beyond the points' convex hull, with the height of its nearest place
  double farthest = 0;               ///< distance of the farthest of them, in units of x and y
};

/// Ends the surface at polygons, given as rings: drops the points outside, cuts lines there, and sets
/// PointSet::boundary. The heights of its corners are those of the Delaunay triangulation of the points given. To be
/// called once, after add_lines(). Between corners more are added where the surface differs from the straight edge by
/// more than `tolerance`, such as half the max error. Fails with kInput without a ring and for points that have no
/// surface. Cost: expected O(n log n).
Result<BoundaryCut> cut_to_boundary(std::span<const Line> rings, double tolerance, PointSet& points,
                                    DuplicatePolicy duplicates = DuplicatePolicy::kFirst);

/// Drops the points outside the polygons, given as rings, and all lines; returns how many points. For the judge of a
/// mesh with such a boundary: see MeasureOptions::cutline.
std::uint64_t drop_outside(std::span<const Line> rings, PointSet& points);

/// A tolerance for each point, as PointOptions::tolerances: t in a region of tolerance t, t + (beyond - t) · min(1, d /
/// falloff) at a distance d from it, in units of x and y; with a falloff of 0 `beyond` outside. The smallest of several
/// regions counts. Tolerances are rounded down to float32. `found`: for each region, true if any point has a smaller
/// tolerance by it; may be null. REQUIRES: falloff, beyond >= 0; a finite `beyond` with a falloff. Cost: O(points · (1
/// + edges near the point)).
std::vector<float> region_tolerances(std::span<const Region> regions, const PointSet& points, double falloff,
                                     double beyond, std::vector<bool>* found = nullptr);

/// The goals, and how to reach them. At least one of the goals; the first that is reached ends the run.
struct PointOptions {
  /// |mesh − z| <= max_error at every point, finite and at least 0. DEFAULT: none.
  std::optional<double> max_error = std::nullopt;
  /// Upper bounds, as in SimplifyOptions. DEFAULT: none.
  std::optional<std::uint64_t> max_triangles = std::nullopt;
  std::optional<std::uint64_t> max_vertices = std::nullopt;
  /// Round positions to float32, as GLB and STL hold them; else they are double. DEFAULT: true.
  bool float32_positions = true;
  /// False: a budget that ends the run returns the last mesh, though an earlier one may have been better. DEFAULT:
  /// true.
  bool best_of_budget = true;
  DuplicatePolicy duplicates = DuplicatePolicy::kFirst;  ///< DEFAULT: the first point of each place.
  /// Above 0, in units of x and y: the mesh ends at a concave hull. Its edges are at most this long, except where a
  /// longer one is needed to connect the points. DEFAULT: at the convex hull.
  std::optional<double> boundary_length = std::nullopt;
  /// The work that follows refinement: effort, vertices, min_shape and shape, as for a raster; the rest does not apply.
  /// Vertices for `shape` get the height of the surface; it needs a max error and no budget. Free vertices lie on a
  /// lattice of 2^22 steps or more over the extent. A max error of 0, or one that the rounding of heights to float32
  /// uses up, allows fast effort only. DEFAULT: normal effort.
  Quality quality = {};
  /// |mesh − z| <= tolerance at every point, besides max_error: one for each point, at least 0; +infinity: none. For
  /// points at one place that of the one that counts, with kMean the first. Needs max_error and no budget. Borrowed.
  /// DEFAULT: empty.
  std::span<const float> tolerances = {};
  Run run = {};  ///< threads, progress, and a limit of the time
};

/// Greedy insertion on scattered samples (section 2 of the 1995 paper names it, without doing it), then the removal and
/// repair of the effort, as on a raster. With a budget and an effort above fast, an error is searched for. The domain
/// is the set's own boundary, else the convex hull, or with `boundary_length` the chi-shape of Duckham et al. (2008):
/// it begins with the Delaunay triangulation of all points, and removes triangles whose edge on the boundary is longer,
/// the longest edge first. A triangle stays if without it the domain would fall apart or lose a point, or its boundary
/// would not be a simple polygon. All corners of that polygon are vertices. Each triangle keeps the list of the points
/// in it. Coordinates are snapped to an integer lattice of up to 2^30 steps: the coarsest on which the given decimals
/// lie exactly if there is one, else the finest power of two. With an effort above fast the decimals' steps are divided
/// by a power of two, or are a power of two, at least 2^22 over the extent; so are those with float32_positions and
/// lines. Different points are never merged: where the lattice cannot keep two apart, they are refused. Among points of
/// equal error the one in the northernmost, then westernmost place is inserted. Points on a grid give, with fast
/// effort, the vertices that simplify() gives for the raster, but for ties.
///
/// A line becomes a chain of edges through some of its points, among them its ends, of a ring at least three; with
/// PointLine::keeps_vertices through all of them. Chains do
/// not cross, so no triangle crosses one. Each point of the line between two points of its chain is within max_error of
/// the mesh. Triangles between points of equal height on lines, as in the bend of a contour, are given up by flips of
/// edges where the other points allow it; the rest is counted (`flat`). Points of lines that the lattice cannot keep
/// apart share a vertex, and count all the same.
///
/// Guarantees that |mesh − z| <= max_error, and the point's tolerance, at every point that is not given up as a
/// duplicate, at its coordinates as given, for the positions as they are in the mesh. Vertices are points, except free
/// ones (high and max effort, goals for shapes) and corners of a boundary. Fails with kUsage (no goal, a max_error out
/// of range, a budget below what the hull needs, a boundary_length that is not above 0, a budget or a boundary_length
/// with lines, a budget with goals for shapes or such goals out of range, tolerances of another number than the points,
/// below 0, NaN or with a budget, the dominant order), with kInput (lines that meet with unlike heights, which are
/// named, fewer than 3 places, all on one line, a value that is not finite or beyond 1e100, an extent below 1e-100, two
/// points nearer to each other than about 2^-30 of the extent, which are named, as is the far point that makes the
/// extent so large), with kPromise where float32 positions cannot keep the bound, kCancelled. Cost: expected O(n log m)
/// for n points, with boundary_length O(n log n); some 50 to 60 bytes a point in addition to the points themselves.
Result<SimplifiedPoints> simplify_points(const PointSet& points, const PointOptions& options);

}  // namespace scarp

#pragma GCC visibility pop
