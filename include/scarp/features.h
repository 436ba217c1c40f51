// Declare terrain features that the mesh must represent at any max error: breaklines, lakes, rivers, walls, ridges,
// points, and the cutline.
//
// Lines of rivers, walls and ridges are fitted to the max error of the mesh, so a coarse mesh needs few vertices along
// them. With a budget, each step of the search for the max error rebuilds these lines.
//
// Example:
//     SCARP_TRY(auto&& dem, scarp::read_height_field("dem.tif"));
//     SCARP_TRY(const auto& ponds, scarp::read_lines("lakes.geojson", {.crs = dem.info.crs}));
//     scarp::Features features;  // SimplifyOptions::features
//     features.breaklines.affine = scarp::map_affine(dem.info, dem.rows);
//     SCARP_TRY(features.lakes, scarp::flatten_lakes(dem, ponds.lines, {.affine = features.breaklines.affine}));
//     features.ridges = scarp::RidgeGoals{.height = 40};
#pragma once

#include <array>
#include <cstdint>
#include <optional>
#include <span>
#include <string>
#include <vector>

#include "scarp/height_field.h"
#include "scarp/lines.h"
#include "scarp/result.h"
#include "scarp/run.h"

#pragma GCC visibility push(default)

namespace scarp {

// Standing water: lakes that are flat.

struct Lake {
  std::string name;
  double level = 0;           ///< elevation of the water
  std::uint64_t samples = 0;  ///< samples set to the level
  std::uint64_t raised = 0;   ///< surrounding samples raised above the level
  double largest_change = 0;  ///< largest change of a sample
  std::uint64_t bytes = 0;    ///< bytes that a field with a source uses for the lake
  std::vector<Line> shore;    ///< the lake's rings, with the level as height, for Features::breaklines
};

struct WaterOptions {
  std::array<double, 6> affine{0, 1, 0, 0, 0, 1};  ///< map from samples to the coordinates of the lines: map_affine()
  /// The level is this percentile (0 … 100) of the heights along the shore. Most heights along a shore are too high,
  /// because most cells there contain more land than water.
  double percentile = 5;
  /// Samples around a lake are raised to at least this height above its level. In z units, above 0.
  double freeboard = 0.01;
  /// The memory limit of the process in bytes (0: none), and the bytes already in use, as in SimplifyOptions::run. The
  /// call fails with kMemory if the lakes need more memory. DEFAULT: no limit.
  Run run = {};  ///< memory, and progress of the pass "water"
};

/// Flattens each polygon of `lines`: sets all valid samples in the polygon (by the even-odd rule for its rings) to one
/// level. The level is a percentile of the heights of the raster's surface along all rings, at two points per sample.
/// Then all samples next to the lake (8-neighbours outside all lakes) are raised to at least level + freeboard, so that
/// the water has a rim. Lakes are processed in the order of `lines`; a sample in two lakes belongs to the later one.
/// Levels are computed from the original field. Lines other than rings, and polygons without a valid sample on their
/// shore, are omitted.
///
/// If the field has a source, a source with the flattened samples replaces it. The memory of the new source
/// (Lake::bytes) grows with the lengths of the shores, not with the areas of the lakes.
///
/// If the shores are breaklines and all vertices are samples, a mesh is level within each lake. REQUIRES: the affine
/// map can be inverted. Fails with kUsage for options out of range, with kCancelled, and with the errors of the field's
/// source. For a field with a source, also fails with kInput if coordinates of a shore are too large. Memory: that of
/// the shores as breaklines. Cost: O(samples in and around the lakes + n log n) for shores along n samples. From a
/// source, the rows with shores are read first, then the rows with lakes.
Result<std::vector<Lake>> flatten_lakes(OwnedHeightField& field, std::span<const Line> lines,
                                        const WaterOptions& options);

/// Returns the same lakes as flatten_lakes(), with levels and shores only, and does not change the field. Options and
/// errors are the same, except that the memory limit is not checked. Cost: from a source, only the rows with shores are
/// read.
Result<std::vector<Lake>> find_lakes(const HeightField& field, std::span<const Line> lines,
                                     const WaterOptions& options);

struct FlatOptions {
  std::array<double, 6> affine{0, 1, 0, 0, 0, 1};  ///< map from samples to the coordinates of shores: map_affine()
  std::uint64_t min_samples = 100;                 ///< at least 3
  /// Like WaterOptions::run. The limit includes the memory of the shores as breaklines. DEFAULT: no limit.
  Run run = {};  ///< memory, and progress of the pass "flats"
};

/// Finds the flat areas of the raster, each of at least min_samples 4-connected samples of equal height. The field does
/// not change. Shores run from sample to sample, around the cells and half cells whose corners all belong to the area.
/// If the shores are breaklines and all vertices are samples, a mesh is level within each area. Areas are ordered by
/// their first samples. An area that is nowhere two samples wide is omitted. Fails with kUsage for a min_samples below
/// 3, with kCancelled, and with the errors of the field's source. Memory: 24 bytes for each horizontal run of equal
/// samples in unfinished areas. Cost: O(samples); a source's rows are read once, from the top down.
Result<std::vector<Lake>> find_flats(const OwnedHeightField& field, const FlatOptions& options);

// Running water: lines that never rise downstream.

struct River {
  std::string name;
  double source = 0, mouth = 0;  ///< heights of its upper and lower ends within the raster
  double deepest_cut = 0;        ///< its largest depth below the raster
  bool is_turned = false;        ///< true if it flows against the given order of its points
  Line course;                   ///< with heights, for Features::breaklines; yields to shores
};

struct RiverOptions {
  std::array<double, 6> affine{0, 1, 0, 0, 0, 1};  ///< map from samples to the coordinates of the lines: map_affine()
  /// Max height difference between a course and the exact course, in z units, at least 0. DEFAULT: 0, which needs two
  /// vertices per sample.
  double tolerance = 0;
};

/// For each line of `lines`, computes heights that never rise downstream. A river flows from the end where the raster
/// is higher to the other end. The height of a point is the lowest height of the raster's surface at the point and
/// upstream of it. At a shared vertex, all rivers have the lowest of their heights, so that a confluence has no step.
/// In a lake, and less than a sample from it, a river has the lake's level, even if the river rises there. `lakes`:
/// from flatten_lakes() or find_flats() for this field.
///
/// Parts of lines outside the raster or in nodata have no heights. Rings, and lines without any height, are omitted.
/// The raster does not change. In the mesh, hard breaklines below the raster become gorges one sample wide. Heights are
/// float32. Fails with kUsage for a negative tolerance, and with the errors of the field's source. REQUIRES: the affine
/// map can be inverted. Cost: O(n log n) for lines and shores along n samples.
Result<std::vector<River>> carve_rivers(const HeightField& field, std::span<const Line> lines,
                                        std::span<const Lake> lakes, const RiverOptions& options);

// Cliffs: walls of buildings and quarries, where the height jumps between two samples.
//
// The raster does not define the exact position of a jump. A wall at an angle to the grid becomes a staircase, and a
// mesh with vertices on samples follows each stair. But a straight line fits between the samples of all the stairs.
// With two such lines, close together along the wall's top and foot, the surface on both sides remains smooth. So a
// straight piece of wall costs two triangles.

struct CliffOptions {
  /// Neighbouring samples in a row or a column that differ by more than this height form a cliff. In z units, above 0
  /// and finite. Values below twice the max error are of little use.
  double height = 0;
  /// Max error of the future mesh, at least 0 and finite. Samples along a line differ in height from the line by at
  /// most 0.9 times this error. Refinement ensures the error bound in any case, but lines with larger differences are
  /// of little use.
  double max_error = 0;
  std::array<double, 6> affine{0, 1, 0, 0, 0, 1};  ///< map from samples to the coordinates of lines: map_affine()
  std::span<const Line> avoid = {};                ///< lines that no wall may cross or touch
  /// For a field with a source: the memory limit of the process, and the bytes in use, as in SimplifyOptions. The call
  /// fails with kMemory if the walls need more memory. DEFAULT: no limit.
  Run run = {};
};

struct Cliffs {
  /// Two lines for each wall: the line along its top, then the line along its foot. All lines have heights, and
  /// vertices on a lattice of 1/256 sample. Their kind is kWall.
  std::vector<Line> lines;
  std::uint64_t wall_count = 0;
  std::uint64_t vertices = 0;  ///< distinct vertices of the lines
};

/// Finds the walls of a raster, and makes two lines for each part of a wall that is worth its vertices. All samples on
/// the upper side lie to the left of both lines (seen from above with rows downwards), and all samples on the lower
/// side to the right. No sample lies on or between the lines, so walls change neither samples nor guarantees. Nodata
/// samples form no cliffs. Two walls never share a point.
///
/// Among all lines through a wall, those with the fewest vertices are chosen. Their vertices lie on cracks (jumps
/// between two samples), or in cells where the wall turns. A part is worth its vertices if it needs fewer than three
/// pairs of vertices per ten cracks. Fails with kUsage for options out of range, and with the errors of the field's
/// source. A source is read once from the top down; the lines are the same as for samples in memory. REQUIRES: the
/// affine map can be inverted. Memory: 40 bytes per crack, 1000 bytes per crack of the longest wall, and the lines.
/// Cost: O(samples) and about 20 µs per crack, on one thread.
Result<Cliffs> detect_cliffs(const HeightField& field, const CliffOptions& options);

// Ridges and valleys: the lines along which the raster's surface bends most.
//
// A mesh of few triangles lowers all crests and fills all valley beds, by up to its max error. Water then follows the
// triangles instead of the terrain. So lines along crests and beds become edges of the mesh.
//
// Profiles identify ridges (profile recognition: Chang, Song & Hsu, Computers & Geosciences 24:1, 1998; the highest and
// lowest samples of profiles: Peucker & Douglas, Computer Graphics and Image Processing 4:4, 1975). Four profiles pass
// through a sample: along its row, its column and both diagonals. At least two profiles of a ridge sample must fall by
// the given height on both sides before they rise above the sample. This rule excludes noise below this height, and
// flanks of cones, which bend along one profile only. Half the height is enough for samples that continue a ridge of
// full height. A maximum spanning tree links connected samples along the highest paths; its long branches are the
// ridges. Valleys are the ridges of the negated raster.

struct RidgeOptions {
  /// The least height of a ridge above the terrain within 16 samples on both sides. In z units, above 0 and finite.
  /// Heights below the max error are of little use.
  double height = 0;
  /// Max error of the future mesh, at least 0 and finite. Like soft lines, ridges follow the raster to within half of
  /// this error.
  double max_error = 0;
  std::array<double, 6> affine{0, 1, 0, 0, 0, 1};  ///< map from samples to the coordinates of lines: map_affine()
  std::span<const Line> avoid = {};                ///< ridges are not searched for near these lines
  bool are_kept = false;                           ///< true: the final mesh contains all lines at every effort
  /// For a field with a source: the memory limit of the process, and the bytes in use, as in SimplifyOptions. The call
  /// fails with kMemory if the ridges need more memory. DEFAULT: no limit.
  Run run = {};
};

struct Ridges {
  /// Soft lines for Features::breaklines, with vertices on samples, of kind kRidge or kKeptRidge.
  std::vector<Line> ridges, valleys;
  std::uint64_t vertices = 0;  ///< vertices of the lines; a shared vertex counts once for each line
};

/// Finds the ridges and valleys of a raster, in an order that depends on the raster only. Each line runs within one
/// sample of the crest or bed samples that it represents, with as few vertices as this distance and the error bound
/// allow. Where one line joins another, both have a vertex. Lines of fewer than 8 samples are omitted. Negating all
/// samples exchanges ridges and valleys. A profile ends at nodata.
///
/// Fails with kUsage for options out of range, with kCancelled, and with the errors of the field's source. A source is
/// read four times from the top down; the lines are the same as for samples in memory. REQUIRES: the affine map can be
/// inverted. Memory: about 50 bytes for each sample near a possible ridge or valley; for samples in memory, also 6
/// bytes per sample. Cost: O(samples) and, for the n samples near lines, O(n log n). A million samples need about 0.1
/// to 0.3 s for terrain, up to 1 s for noise.
Result<Ridges> detect_ridges(const HeightField& field, const RidgeOptions& options);

/// Walls, each represented by a pair of lines; see detect_cliffs().
struct WallGoals {
  double height = 0;  ///< CliffOptions::height: above 0, in z units
};

/// Ridges and valleys that the mesh prefers or must contain; see detect_ridges().
struct RidgeGoals {
  double height = 0;      ///< RidgeOptions::height: above 0, in z units
  bool are_kept = false;  ///< RidgeOptions::are_kept
};

/// The features of a mesh. simplify() fits them to the max error of the mesh by fit_features(). Features need a max
/// error, tolerances or a budget. With a budget, simplify() searches for a max error at every effort, and fits the
/// features to each error that it tries. It fails with kUsage if the budget is too small for lines and outline.
struct Features {
  /// Lines that do not depend on the error. Their affine map applies to all features. A hard line has its own heights;
  /// a soft line follows the raster. Where a hard line passes through a sample with a different height, the sample is
  /// set to the line's height, and the guarantees hold for the changed samples (Simplified::edits). If the heights of
  /// lines conflict, simplify() fails with kInput and names the lines. DEFAULT: none.
  LineConstraints breaklines = {};
  /// Lakes found by flatten_lakes() or find_flats() in the field. Their shores become lines, and rivers flow into the
  /// lakes.
  std::vector<Lake> lakes = {};
  std::vector<Line> rivers = {};                    ///< courses in x and y, for carve_rivers()
  std::optional<WallGoals> walls = std::nullopt;    ///< DEFAULT: none
  std::optional<RidgeGoals> ridges = std::nullopt;  ///< DEFAULT: none
  /// Samples that become vertices before refinement begins, in this order, and are never removed. Samples outside the
  /// valid data are skipped. DEFAULT: none.
  std::vector<SampleAt> points = {};
  /// The surface (the domain of guarantee (2) of simplify()) is cut to these polygons. Their rings become edges of the
  /// mesh, moved by at most 1/512 sample (3/512 where lines cross). Between samples, these edges follow the raster's
  /// heights to within half of max_error or, less than a sample from a vertex, to within max_error. Samples outside the
  /// polygons are not judged. simplify() fails with kInput if no surface lies in the polygons. DEFAULT: none.
  Cutline cutline = {};

  /// True if the mesh has lines.
  bool have_lines() const { return !breaklines.lines.empty() || !lakes.empty() || depend_on_error(); }
  /// True if some lines depend on the max error of the mesh.
  bool depend_on_error() const { return !rivers.empty() || walls || ridges; }
  /// Lines that do not depend on the error: breaklines, then shores.
  LineConstraints fixed_lines() const;
};

struct FeatureFitOptions {
  double max_error = 0;  ///< max error of the future mesh, in z units, at least 0 and finite
  Run run = {};          ///< progress of the pass "ridges"
};

/// The lines of a mesh for one max error, and their features.
struct FittedFeatures {
  LineConstraints lines;         ///< breaklines, shores, rivers, walls, ridges, valleys
  std::vector<River> rivers;     ///< except rings and lines without heights
  std::optional<Cliffs> walls;   ///< nothing unless Features::walls is set
  std::optional<Ridges> ridges;  ///< nothing unless Features::ridges is set

  /// Number of lines except those of walls and ridges.
  std::uint64_t given_lines() const;
};

/// Makes all lines for a mesh of a given max error. Courses of rivers differ from the exact courses by at most half of
/// the error. Walls avoid all lines except ridges; ridges avoid all other lines. The result depends only on features,
/// field and error. simplify() calls this function for each mesh that it builds; Simplified::features and lines_for
/// contain the last result.
///
/// Fails with kUsage if `max_error` is negative or not finite, and with the errors of carve_rivers(), detect_cliffs()
/// and detect_ridges(). Cost: that of these functions.
Result<FittedFeatures> fit_features(const HeightField& field, const Features& features,
                                    const FeatureFitOptions& options);

}  // namespace scarp

#pragma GCC visibility pop
