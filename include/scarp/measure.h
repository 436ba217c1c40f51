// Judge a mesh from any program against its raster by brute force: its errors at all samples, its holes, overlaps and
// angles. Also measure the volumes of cut and fill between two meshes.
//
// Example:
//     SCARP_TRY(const auto& dem, scarp::read_height_field("dem.tif"));
//     SCARP_TRY(const auto& mesh, scarp::read_mesh("hills.glb"));
//     SCARP_TRY(const auto& measured, scarp::measure(dem, mesh));
//     std::printf("max error %g at column %d, row %d; sound: %d\n", measured.max_error, measured.max_error_at[0],
//                 measured.max_error_at[1], measured.is_sound());
//     SCARP_TRY(const auto& hill, scarp::measure_volume(mesh, 500.0));
//     std::printf("%.0f above the level 500, %.0f missing below\n", hill.cut, hill.fill);
#pragma once

#include <array>
#include <cstdint>
#include <functional>
#include <limits>
#include <optional>
#include <span>
#include <vector>

#include "scarp/height_field.h"
#include "scarp/mesh.h"
#include "scarp/result.h"
#include "scarp/run.h"

#pragma GCC visibility push(default)

namespace scarp {

struct Cutline;

struct MeasureOptions {
  /// A sample is uncovered if its horizontal distance from every triangle, in samples, is larger than this. A nearer
  /// sample outside all triangles is compared with the plane of the nearest triangle, or with its nearest point if the
  /// triangle is thinner than this. The tolerance absorbs the rounding of positions in the file. DEFAULT: 1/256.
  double coverage_tolerance = 1.0 / 256;
  /// Also check angles, orientation, overlaps, open edges and T-junctions. DEFAULT: true.
  bool topology = true;
  /// Collect `Measurement::offenders`: samples whose error is above this. DEFAULT: none.
  std::optional<double> collect_above = std::nullopt;
  /// Empty, or cols·rows per-sample tolerances (+infinity: none). `Measurement::over_tolerance` counts the samples
  /// whose error is above their tolerance; these samples are offenders. Borrowed. DEFAULT: empty.
  std::span<const float> tolerance = {};
  /// A source of these tolerances, read in windows, instead of `tolerance`. Borrowed. DEFAULT: none.
  const SampleSource* tolerance_source = nullptr;
  /// The cutline of the mesh. Samples in a polygon that are farther than 1/64 sample from its rings must be covered.
  /// Samples nearer to the rings, on either side, are judged if covered. All other samples are not judged. Edges along
  /// the rings are not gaps. The rings are used as given, not as rounded in the mesh. For scattered points, the cutline
  /// affects only gaps: remove points outside by drop_outside(). Borrowed. DEFAULT: null, the whole domain.
  const Cutline* cutline = nullptr;
  /// For scattered points: the mesh may end within their convex hull, as with PointOptions::boundary_length. If the
  /// mesh's border is one loop, no open edge is a gap. DEFAULT: false.
  bool inlets = false;
  /// If set, called once for each row in ascending order with the signed error (mesh − sample) of every sample; NaN
  /// where the sample is nodata or uncovered. The span is valid during the call only.
  std::function<void(int row, std::span<const float> errors)> on_row = {};
  Run run = {};  ///< threads and progress
};

/// A sample that breaks the bound.
struct Offender {
  std::int32_t col = 0, row = 0;
  double error = 0;  ///< mesh − sample; +infinity for a valid sample that no triangle covers
};

/// Each sample is counted once; a sample on a shared edge counts with the larger error of its triangles. Errors are
/// vertical, mesh − sample, in z units. In a frame in space, an error is the distance along the sample's vertical to
/// the triangle that the vertical meets. If it meets no triangle, the error is the distance to the nearest point of the
/// triangle that covers the sample on the map.
struct Measurement {
  std::uint64_t vertices = 0, triangles = 0;

  std::uint64_t samples = 0;                         ///< valid samples that are covered and judged
  std::uint64_t uncovered = 0;                       ///< valid samples of valid cells that no triangle covers
  std::array<std::int32_t, 2> uncovered_at{-1, -1};  ///< (col, row) of the first of them, row by row; (−1, −1): none
  std::uint64_t stray = 0;                 ///< valid samples outside the domain: in no cell with three valid corners
  std::uint64_t cut_off = 0;               ///< valid samples beyond MeasureOptions::cutline, not judged
  HeightRange heights;                     ///< range of all valid samples: judged, uncovered, stray and cut off
  std::uint64_t nodata_cells_covered = 0;  ///< nodata cells (or nodata halves of cells) whose centre the mesh covers

  std::uint64_t over_tolerance = 0;                  ///< covered samples whose error exceeds their tolerance
  double max_error = 0;                              ///< largest |error|
  std::array<std::int32_t, 2> max_error_at{-1, -1};  ///< its sample (col, row); ties: lowest row, then lowest column
  double rmse = 0, mean_error = 0, mean_abs_error = 0;
  /// |error| below which 50, 95, 99, 99.9 % of the samples lie; from a histogram, rounded up by at most 0.05 %.
  double p50 = 0, p95 = 0, p99 = 0, p999 = 0;

  // Topology and shape; zero without MeasureOptions::topology.
  double min_angle = 0;                       ///< smallest angle of any triangle in degrees, seen from above (in
                                              ///< space: from above the centre)
  std::array<double, 3> angle_percentiles{};  ///< P1, P5, P50 of the triangles' smallest angles, degrees
  std::uint64_t down_facing = 0;  ///< triangles clockwise from above, on the map or in space; in an open mesh, flipped
                                  ///< triangles
  std::uint64_t degenerate = 0;   ///< triangles without area in 3-D
  std::uint64_t misoriented_edges = 0;   ///< edges whose two triangles run along them in the same direction
  std::uint64_t non_manifold_edges = 0;  ///< edges with more than two triangles
  std::uint64_t open_edges = 0;          ///< edges with one triangle
  std::uint64_t border_loops = 0;        ///< closed loops that the open edges form
  std::uint64_t t_junctions = 0;         ///< vertices inside an open edge of another triangle
  /// Open edges of an open mesh with a part of the domain on their outer side, where the mesh has a hole. Lattice lines
  /// cut each edge into pieces. Each piece has a test point next to its middle, 1/64 sample outside the edge (4 ·
  /// coverage_tolerance if that is more). In a frame with a transform, edges at vertices without an inverse image are
  /// omitted. A missing part of the domain that touches the rest only at corners has no such edge, and is not counted.
  std::uint64_t gaps = 0;
  std::uint64_t overlaps =
      0;                ///< pairs of triangles whose interiors overlap, seen from above (if closed: only up-facing)
  bool closed = false;  ///< true without open edges (a solid); heights are then judged on up-facing triangles

  std::vector<Offender>
      offenders;  ///< the worst sample of each triangle, and all uncovered ones; see MeasureOptions::collect_above

  /// True if the mesh is a single-valued terrain (or closed solid) without cracks: no flipped, overlapping or
  /// degenerate triangles, no T-junctions, no holes within the domain, no non-manifold edges.
  bool is_sound() const {
    return degenerate == 0 && misoriented_edges == 0 && non_manifold_edges == 0 && t_junctions == 0 && gaps == 0 &&
           overlaps == 0 && (closed || down_facing == 0);
  }
};

/// Returns the heights of the mesh at the samples of the field's grid, row-major (Terra's `dem`); NaN where the sample
/// is nodata or uncovered. At samples on two triangles, the triangle with the larger error counts, as in measure().
/// Failures and cost are those of measure(), plus 8 bytes per sample.
Result<std::vector<float>> resample(const HeightField& field, const Mesh& mesh, int threads = 1);
/// The same heights row by row, from the top; the span is valid during the callback only. Memory: as measure().
Result<void> resample_rows(const HeightField& field, const Mesh& mesh,
                           const std::function<void(int row, std::span<const float> heights)>& on_row, int threads = 1);

/// Judges `mesh` against every valid sample of `field`, in the field's frame. Shares no scan code with simplify().
/// Fails with kInput if the mesh has no triangles, an index out of range, or a position that is not finite or beyond
/// 1e100 (in its own coordinates or, in affine frames, in cells). Also fails with kCancelled, and with the errors of
/// the field's source. A field with a source is read in bands of rows, with two bands in memory for each thread. Cost:
/// O(samples + triangles).
Result<Measurement> measure(const HeightField& field, const Mesh& mesh, const MeasureOptions& options = {});

/// Adds topology and shape to `result`, a measurement of the same mesh without them, such as Simplified::measurement.
/// Reads the members cutline, coverage_tolerance and run of `options`. Fails as measure() does. Cost: O(triangles).
Result<void> measure_topology(const HeightField& field, const Mesh& mesh, const MeasureOptions& options,
                              Measurement& result);

/// Judges a mesh against points by brute force. Measurement::samples counts points; max_error_at and offenders have
/// {index of the point, 0}; on_row is called once, with all points. Duplicates are first removed according to the given
/// policy. The unit of coverage_tolerance is the mean distance between points, √(area / points). Gaps are open edges
/// within the convex hull (see MeasureOptions::inlets). MeasureOptions::tolerance has one tolerance for each point;
/// errors may exceed it by the rounding of this function, 1e-12 of the heights. Failures and cost: as measure().
Result<Measurement> measure_points(const PointSet& points, const Mesh& mesh, DuplicatePolicy duplicates,
                                   const MeasureOptions& options = {});

// Volumes between surfaces.

/// The volumes between two surfaces within the area that both cover, seen from above. Volumes are in the units of x, y
/// and z: cubic metres if all three are metres. No volume is negative.
struct Volumes {
  double cut = 0;           ///< volume where the second surface is below the first: ground to dig away
  double fill = 0;          ///< volume where the second surface is above the first: ground to heap up
  double common_area = 0;   ///< area that both surfaces cover
  double from_outside = 0;  ///< area of the first surface that the second does not cover
  double to_outside = 0;    ///< area of the second surface that the first does not cover; 0 for a level

  /// The surplus of the cut: the integral of first − second over the common area.
  double net() const { return cut - fill; }
  /// The volumes from the second surface to the first.
  Volumes reversed() const { return {fill, cut, common_area, to_outside, from_outside}; }
};

/// Measures the volumes between the ground before (`from`) and after (`to`). Triangles of one surface are clipped by
/// those of the other. An exact formula computes the volume above each part. The rounding is about 1e-15 of the largest
/// |z| times the common area. A mesh against itself has volumes of exactly 0. Swapping the meshes exchanges cut and
/// fill bit for bit. `from_outside` and `to_outside` are 0 if they would be at most 1e-12 of their surface's area.
/// Run::threads and Run::progress are used; threads never change the result.
///
/// Both meshes must be in one frame: x, y and z are compared as Mesh::vertex() returns them. Metadata and bounds are
/// ignored. If the heights of the surfaces are known to ±E₁ and ±E₂, each of cut, fill and net is known to ±(E₁ + E₂) ·
/// common_area. Meshes without a common area have volumes of 0.
///
/// Fails with kInput as measure() does, and for a mesh with more than one height at a place: a closed solid, a triangle
/// that is vertical or faces down (the message names the triangle), or triangles that overlap, seen from above.
/// Triangles without area in space are ignored. Cost: O(n log n + overlapping pairs of triangles). Memory: some 100
/// bytes a triangle.
Result<Volumes> measure_volume(const Mesh& from, const Mesh& to, const Run& run = {});
/// Measures the volumes from a surface to an unbounded level: cut is the volume of ground above the level, fill the
/// volume missing below the level. Fails with kUsage for a level that is not finite. Cost: O(n).
Result<Volumes> measure_volume(const Mesh& from, double level, const Run& run = {});

}  // namespace scarp

#pragma GCC visibility pop
