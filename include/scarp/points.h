// Make a mesh from scattered points, which read_points() of io.h reads.
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
/// REQUIRES: at least one point, all finite.
std::array<double, 2> local_origin(const PointSet& points);

/// Appends the points and lines of another set, with its counts and warnings. Fails with kInput if the sets differ in
/// CRS or unit, or have local frames. Fails with kUsage if a set has a boundary.
Result<void> append_points(const PointSet& more, PointSet& points);

/// Sorts the points along a curve through the plane, so that neighbours in the plane are neighbours in memory. For
/// millions of points in random order, simplify_points() then needs about two thirds of the time. Points at one place
/// keep their order; indices in lines and the boundary are adapted. Meshes and errors do not depend on the order. A set
/// with a coordinate that is not finite is not changed. REQUIRES: fewer than 2^32 points. Cost: O(n), with 32 bytes a
/// point while it runs.
void sort_points(PointSet& points);

/// Drops outliers such as birds and reflections in lidar: points whose height differs by more than `most` from all, or
/// all but one, of their 8 nearest neighbours (ties: the first). Points of lines are not dropped, and a set with a
/// coordinate that is not finite is not changed. Adds the number of outliers to PointSet::spikes, and returns it.
/// REQUIRES: most >= 0, no boundary yet. Cost: expected O(n) for points of even density.
std::uint64_t drop_spikes(double most, int threads, PointSet& points);

struct SimplifiedPoints {
  Simplified simplified;         ///< its measurement holds errors at the given points, and `samples` counts points
  std::uint64_t points = 0;      ///< number given
  std::uint64_t duplicates = 0;  ///< points dropped because another one has equal x and y
  std::uint64_t on_hull = 0;     ///< corners of the hull, convex or concave
  double lattice_step = 0;       ///< step of the integer lattice, in units of x and y
  std::uint64_t flat = 0;        ///< triangles whose corners lie on lines at one height
  std::uint64_t loose = 0;       ///< pieces of lines that are not edges, since they cross other pieces of the same
                                 ///< height
  HullFit hull_fit;              ///< set if there are neither boundary_length nor lines
};

/// Adds lines, in the coordinates of the points, as edges of the mesh: their vertices become points. A vertex without a
/// height (NaN) gets the height of the Delaunay triangulation of the given points or, beyond their hull, of the nearest
/// place on the hull. `duplicates` selects the point that counts at each place. Returns how many vertices without a
/// height lie beyond the hull. Fails with kInput for points without a surface. Cost: O(vertices); if vertices lack
/// heights, expected O(n log n) for n points.
Result<std::uint64_t> add_lines(std::span<const Line> lines, PointSet& points,
                                DuplicatePolicy duplicates = DuplicatePolicy::kFirst);

/// A lake that level_lakes() made.
struct PointLake {
  double level = 0;           ///< a float32; NaN for a lake beyond the points, which is omitted
  std::uint64_t dropped = 0;  ///< points dropped in it
  std::uint64_t beyond = 0;   ///< vertices of its shore beyond the points' hull; the surface extends to these
};

/// Makes lakes from polygons: drops the points in them and adds their rings, including holes, as lines at one height,
/// so that all triangles of a lake are level. This height is a percentile, 0 … 100, of the heights along the rings in
/// the Delaunay triangulation of all points. Lakes that meet at a vertex share one height. Call it after add_lines().
/// Fails with kInput for points without a surface, if a line's vertex lies in a lake but not at the lake's height, and
/// if a lake contains all points. REQUIRES: polygons that do not cross or overlap, such as those of inset_polygons().
/// Cost: expected O(n log n).
Result<std::vector<PointLake>> level_lakes(std::span<const Line> rings, double percentile, PointSet& points,
                                           DuplicatePolicy duplicates = DuplicatePolicy::kFirst);

/// Drops all lines, and the points in polygons, which are given as rings. Returns the number of points dropped. Use it
/// before measure_points() for a mesh with such lakes.
std::uint64_t drop_inside(std::span<const Line> rings, PointSet& points);

/// Unit normals for Mesh::normals of a mesh in the coordinates of the points. They are computed from height differences
/// over the mean distance between points, in the Delaunay triangulation of the points. Near the hull, and for points
/// with lines, each normal is the area-weighted mean normal of the mesh's triangles around its vertex. Fails with
/// kInput for points without a surface. Cost: expected O(n log n).
Result<std::vector<float>> point_normals(const PointSet& points, const Mesh& mesh,
                                         DuplicatePolicy duplicates = DuplicatePolicy::kFirst);

struct BoundaryCut {
  std::uint64_t points_outside = 0;  ///< points dropped
  std::uint64_t corners = 0;         ///< points added at corners of the boundary and at its crossings with lines
  std::uint64_t corners_beyond = 0;  ///< corners beyond the points' convex hull, with the height at the hull's nearest
                                     ///< place
  double farthest = 0;               ///< largest distance of such a corner from the hull, in units of x and y
};

/// Ends the surface at polygons, given as rings: drops the points outside, cuts lines at the rings, and sets
/// PointSet::boundary. Corners of the boundary have the heights of the Delaunay triangulation of the given points.
/// Corners are added on edges that differ from the surface by more than `tolerance`, such as half the max error. Call
/// it once, after add_lines(). Fails with kInput without a ring and for points without a surface. Cost: expected O(n
/// log n).
Result<BoundaryCut> cut_to_boundary(std::span<const Line> rings, double tolerance, PointSet& points,
                                    DuplicatePolicy duplicates = DuplicatePolicy::kFirst);

/// Drops all lines, and the points outside the polygons, which are given as rings. Returns the number of points
/// dropped. Use it before measure_points() for a mesh with such a boundary: see MeasureOptions::cutline.
std::uint64_t drop_outside(std::span<const Line> rings, PointSet& points);

/// Computes a tolerance for each point, for PointOptions::tolerances. It is t in a region of tolerance t, and t +
/// (beyond - t) · min(1, d / falloff) at a distance d from the region, in units of x and y. With a falloff of 0, it is
/// `beyond` everywhere outside. With several regions, the smallest tolerance counts. Tolerances are rounded down to
/// float32. `found`: for each region, true if it decreases any point's tolerance; may be null. REQUIRES: falloff,
/// beyond >= 0; a finite `beyond` if falloff > 0. Cost: O(points · (1 + edges near the point)).
std::vector<float> region_tolerances(std::span<const Region> regions, const PointSet& points, double falloff,
                                     double beyond, std::vector<bool>* found = nullptr);

/// At least one goal is required; the first one reached ends the run.
struct PointOptions {
  /// |mesh − z| <= max_error at every point, finite and at least 0. DEFAULT: none.
  std::optional<double> max_error = std::nullopt;
  /// Upper bounds, as in SimplifyOptions. DEFAULT: none.
  std::optional<std::uint64_t> max_triangles = std::nullopt;
  std::optional<std::uint64_t> max_vertices = std::nullopt;
  /// The quantity that a budget minimises. kRms needs a budget and more than fast effort. DEFAULT: kMax.
  Objective objective = Objective::kMax;
  /// True: positions are rounded to float32, as in GLB and STL; false: double. DEFAULT: true.
  bool float32_positions = true;
  /// Instead, x and y are rounded as those of a print: (x − origin) · scale is a float32. DEFAULT: none;
  /// simplify_for_print() sets it.
  std::optional<Placement> placement = std::nullopt;
  /// False: if a budget ends the run, the result is the last mesh, though an earlier one may have been better. DEFAULT:
  /// true.
  bool best_of_budget = true;
  DuplicatePolicy duplicates = DuplicatePolicy::kFirst;  ///< DEFAULT: the first point at each place.
  /// Longest edge of a concave hull at which the mesh ends, above 0, in units of x and y. Longer edges remain only
  /// where they are needed to connect the points. DEFAULT: the mesh ends at the convex hull.
  std::optional<double> boundary_length = std::nullopt;
  /// The work after refinement: effort, vertices, min_shape and shape, as for a raster. Other members do not apply.
  /// Vertices added for `shape` get the height of the surface. Free vertices lie on a lattice of 2^22 steps or more
  /// over the extent. A max error of 0, or one not above the rounding of heights to float32, allows fast effort only.
  /// DEFAULT: normal effort.
  Quality quality = {};
  /// |mesh − z| <= tolerance at every point, in addition to max_error. One tolerance for each point, at least 0;
  /// +infinity: none. For points at one place, the tolerance of the point that counts is used; with kMean, that of the
  /// first. Needs max_error. With a budget, all bounds are multiplied by Simplified::tolerance_factor. Borrowed.
  /// DEFAULT: empty.
  std::span<const float> tolerances = {};
  Run run = {};  ///< threads, progress, and a time limit
};

/// Inserts scattered samples greedily (which section 2 of the 1995 paper only mentions), then removes vertices
/// according to the effort, as on a raster. With a budget and an effort above fast, lines, tolerances or goals
/// for shapes, it searches for an error. The domain is the set's own boundary; else, with `boundary_length`, the
/// chi-shape of Duckham et al. (2008); else the convex hull. The chi-shape begins as the Delaunay triangulation of all
/// points. Triangles whose boundary edge exceeds boundary_length are removed, the longest edge first. A triangle is
/// kept if its removal would split the domain or exclude a point, or if the domain's boundary would not remain a simple
/// polygon. All corners of this polygon are vertices. Each triangle stores the list of its points. Coordinates are
/// snapped to an integer lattice of up to 2^30 steps: the coarsest lattice that contains the given decimals exactly; if
/// there is none, the finest lattice whose step is a power of two. With an effort above fast, or with float32_positions
/// and lines, the step is that of the decimals divided by a power of two, or a power of two; the extent then has at
/// least 2^22 steps. Different points are never merged: the call fails if the lattice cannot separate two points. Among
/// points of equal error, the northernmost, then westernmost one is inserted. For points on a grid, fast effort selects
/// the same vertices as simplify() for the raster, except for ties.
///
/// A line becomes a chain of edges through some of its points, including its ends (for a ring, at least three points).
/// With PointLine::keeps_vertices, the chain passes through all points. Chains do not cross, so no triangle crosses a
/// chain. Each point of the line between two points of its chain is within max_error of the mesh. Triangles between
/// points of equal height on lines, as in the bend of a contour, are removed by edge flips where the other points allow
/// this; remaining ones are counted (`flat`). Points of lines that the lattice cannot separate share a vertex, but each
/// of them counts.
///
/// Guarantees that |mesh − z| is at most max_error, and at most the point's tolerance, at every point that is not
/// dropped as a duplicate. This holds at the point's given coordinates, for the positions stored in the mesh. Vertices
/// are points, except free ones (high and max effort, goals for shapes) and corners of a boundary. Fails with kUsage
/// for no goal; a max_error out of range; a budget too small for the hull, lines or shapes; the objective rms without a
/// budget or with fast effort; min_shape out of range or with fast effort; a boundary_length not above 0, or with
/// lines; goals for shapes out of range; a wrong number of tolerances; tolerances below 0, NaN or without a max_error;
/// the dominant order. Fails with kInput for lines that meet at different heights (the message names the lines); fewer
/// than 3 places; all places on one line; a value that is not finite or beyond 1e100; an extent below 1e-100; two
/// points nearer to each other than about 2^-30 of the extent (the message names these points and the far point that
/// makes the extent so large). Fails with kPromise if float32 positions cannot satisfy the bound, and with kCancelled.
/// Cost: expected O(n log m) for n points, with boundary_length O(n log n); some 50 to 60 bytes a point in addition to
/// the points themselves.
Result<SimplifiedPoints> simplify_points(const PointSet& points, const PointOptions& options);

}  // namespace scarp

#pragma GCC visibility pop
