// Declare features of the land that the mesh must hold, whatever its max error: breaklines, lakes, rivers, walls,
// ridges, points, and the cutline where it ends.
//
// Rivers, walls and ridges are fitted to the max error of the mesh: a coarse mesh needs few vertices along them. A
// budget searches for that error, and each run of the search makes the lines again.
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
  double level = 0;           ///< the elevation of all of it
  std::uint64_t samples = 0;  ///< samples put onto the level
  std::uint64_t raised = 0;   ///< samples around it put above the level
  double largest_change = 0;  ///< largest change of a sample
  std::uint64_t bytes = 0;    ///< bytes that the field keeps for it, where its samples are not in memory as one array
  std::vector<Line> shore;    ///< its rings, at the level: breaklines for Features::breaklines
};

/// How lakes are made flat.
struct WaterOptions {
  std::array<double, 6> affine{0, 1, 0, 0, 0, 1};  ///< from samples to the coordinates of the lines: map_affine()
  /// The level is this percentile of the heights along the shore, 0 … 100. Most of a shore is too high, because a cell
  /// of it holds more land than water.
  double percentile = 5;
  /// Samples around a lake are raised to at least this height above its level, in z units, above 0.
  double freeboard = 0.01;
  /// Like SimplifyOptions::run: the memory limit of the process in bytes, 0 for none, and the bytes of it that others
  /// use. Lakes that do not fit are refused with kUsage. DEFAULT: no limit.
  Run run = {};  ///< memory; progress: of the pass "water"
};

/// Makes each polygon of `lines` flat: all valid samples in it, even-odd by its rings, get the level given by the
/// percentile of its shore. The shore is the raster's surface along all its rings, at two points a sample. Then the
/// eight neighbours of its samples that belong to no lake and are lower than level + freeboard are raised to that
/// height, so that the water has a rim. Lakes are processed in the order of `lines`; a sample in two of them belongs to
/// the later one. Levels are those of the field as given. Polygons without a valid sample on their shore are omitted,
/// as lines are.
///
/// A field with a source receives another source, with the same samples as the field would have in memory; lakes are
/// the same either way. It then keeps Lake::bytes, in proportion to shores, however large the lakes are.
///
/// A mesh with the shores as breaklines and vertices on samples is level within each lake: all corners of its triangles
/// are at the level. REQUIRES: the affine map can be inverted. Fails with kUsage for options out of range, with
/// kCancelled; as the field's source does, and with a source with kInput for shores whose coordinates are too large.
/// Memory: as breaklines. Cost: O(samples in and around the lakes, and n log n for shores along n samples); of a source
/// the rows of shores are read first, then the rows of lakes, once.
Result<std::vector<Lake>> flatten_lakes(OwnedHeightField& field, std::span<const Line> lines,
                                        const WaterOptions& options);

/// The lakes of flatten_lakes(), with their levels and shores; the field does not change. Options and failures as
/// there, but that no memory for samples is used. Cost: of a source the rows of shores are read.
Result<std::vector<Lake>> find_lakes(const HeightField& field, std::span<const Line> lines,
                                     const WaterOptions& options);

struct FlatOptions {
  std::array<double, 6> affine{0, 1, 0, 0, 0, 1};  ///< from samples to the coordinates of shores: map_affine()
  std::uint64_t min_samples = 100;                 ///< at least 3
  /// Like WaterOptions::run. The limit includes the memory of the shores as breaklines. DEFAULT: no limit.
  Run run = {};  ///< memory; progress: of the pass "flats"
};

/// The flat areas of the raster: at least min_samples samples of one height, connected side by side. The field does not
/// change. Shores run from sample to sample, around the cells and half cells whose corners belong to the area. A mesh
/// with the shores as breaklines and vertices on samples is level within each area. Areas are in the order of their
/// first samples. An area that is nowhere two samples wide is omitted. Fails with kUsage for fewer than 3 samples, with
/// kCancelled, and as the field's source does. Memory: 24 bytes for each run of samples of one height in a row, in
/// areas whose end has not been reached. Cost: O(samples); a source's rows are read once, from the top down.
Result<std::vector<Lake>> find_flats(const OwnedHeightField& field, const FlatOptions& options);

// Running water: lines that never rise downstream.

struct River {
  std::string name;
  double source = 0, mouth = 0;  ///< heights of its ends, or of its first and last point in the raster
  double deepest_cut = 0;        ///< its largest depth below the raster
  bool is_turned = false;        ///< it flows against the order of its points as given
  Line course;                   ///< with heights: a breakline for Features::breaklines that yields to shores
};

struct RiverOptions {
  std::array<double, 6> affine{0, 1, 0, 0, 0, 1};  ///< from samples to the coordinates of the lines: map_affine()
  /// The most by which a course may differ from the exact one between its vertices, in z units, at least 0. DEFAULT: 0,
  /// two vertices a sample.
  double tolerance = 0;
};

/// Gives each line of `lines` heights that never rise downstream. Each line flows from the end where the raster is
/// higher to the other end. The height of a point is the lowest of the raster's surface there and upstream. Rivers that
/// share a vertex share its height, the lowest of all, so that a confluence is no step. Within `lakes`, which
/// flatten_lakes() or find_flats() made of this field, and less than a sample away from them, rivers have the lake's
/// level, even where that is a rise.
///
/// Parts outside the raster and in nodata have no heights. Rings, and lines without any height, are omitted. The raster
/// does not change: as hard breaklines, rivers run in gorges a sample wide where they lie below it. Heights are
/// float32. Fails with kUsage for a negative tolerance, and as the field's source does. REQUIRES: the affine map can be
/// inverted. Cost: O(n log n) for lines and shores along n samples.
Result<std::vector<River>> carve_rivers(const HeightField& field, std::span<const Line> lines,
                                        std::span<const Lake> lakes, const RiverOptions& options);

// Cliffs: walls of buildings and quarries, where a raster steps from one sample to the next.
//
// The raster does not know where between two samples a step is. A wall at an angle to the grid becomes a staircase, and
// a mesh on samples follows each stair. But a straight line fits between the samples of all the stairs. Two such lines
// close together, one along the wall's top, one along its foot, keep the surface on either side smooth. So a straight
// piece of wall costs two triangles.

struct CliffOptions {
  /// Neighbouring samples in a row or a column that differ by more are a cliff. In z units, above 0 and finite. It is
  /// of little use below twice the max error.
  double height = 0;
  /// Max error of the mesh to come, at least 0 and finite. Heights of samples along a line differ from the line by at
  /// most 0.9 of it. The bound does not depend on that, since refinement ensures it; but a line from which samples lie
  /// farther is of little use.
  double max_error = 0;
  std::array<double, 6> affine{0, 1, 0, 0, 0, 1};  ///< from samples to the coordinates of lines: map_affine()
  std::span<const Line> avoid = {};                ///< lines that no wall may cross or touch
  /// For a field with a source: bytes that the process may use, and bytes in use, as in SimplifyOptions. Walls
  /// that do not fit are refused with kMemory, before memory runs out. DEFAULT: no limit.
  Run run = {};
};

struct Cliffs {
  /// Two for each wall, the line along its top before the line along its foot. All have heights, and vertices on the
  /// lattice of 1/256 sample. Their kind is kWall.
  std::vector<Line> lines;
  std::uint64_t wall_count = 0;
  std::uint64_t vertices = 0;  ///< number of vertices of the lines, each counted once
};

/// Finds the walls of a raster, and two lines for each part that is worth its vertices. All samples of its upper side
/// lie on the left of both lines (seen from above with rows downwards), all samples of its lower side on the right of
/// both, and none on them or between them. So walls change no sample and no promise. Nodata samples make no cliffs. Two
/// walls never share a point.
///
/// Among all lines through a wall, those with the fewest vertices are chosen. Their vertices lie on cracks between two
/// samples, or in cells where the wall turns. A part is worth its vertices if it needs fewer than three pairs of them
/// for ten cracks. Fails with kUsage for options out of range, and as the field's source does. A source is read once
/// from the top down, and gives the same lines as the same samples in memory. REQUIRES: the affine map can be inverted.
/// Memory: 40 bytes a crack, 1000 a crack of the longest wall, and the lines. Cost: O(samples), and some 20 µs a crack;
/// one thread.
Result<Cliffs> detect_cliffs(const HeightField& field, const CliffOptions& options);

// Ridges and valleys: the lines along which a surface bends most, found in the raster.
//
// A mesh of few triangles cuts the crest off a ridge and fills the bed of a valley, each by no more than its max error,
// but everywhere. Water then follows the triangles instead of the land. Lines along crests and beds, as edges of the
// mesh, keep them.
//
// Profiles decide what is a ridge (profile recognition: Chang, Song & Hsu, Computers & Geosciences 24:1, 1998; the
// highest and lowest samples of profiles: Peucker & Douglas, Computer Graphics and Image Processing 4:4, 1975). There
// are four profiles through a sample: along its row, its column and both diagonals. At least two of them must fall by
// the given height, on either side, before they rise above the sample. Lower noise is no ridge, nor is the flank of a
// cone, which bends along one profile only. Half the height is enough for samples that continue a ridge of full height.
// A maximum spanning tree links connected samples along the highest paths; its long branches are the ridges. Valleys
// are the ridges of the raster turned upside down, sample by sample.

struct RidgeOptions {
  /// The least height of a ridge above the land on both sides of it, at most 16 samples away. In z units, above 0 and
  /// finite. A height below the max error is of little use.
  double height = 0;
  /// Max error of the mesh to come, at least 0 and finite. Lines follow the raster to within half of it, as soft lines
  /// do.
  double max_error = 0;
  std::array<double, 6> affine{0, 1, 0, 0, 0, 1};  ///< from samples to the coordinates of lines: map_affine()
  std::span<const Line> avoid = {};                ///< no ridge is searched for near these lines
  bool are_kept = false;                           ///< the final mesh holds all lines, whatever the effort
  /// For a field with a source: bytes that the process may use, and bytes in use, as in SimplifyOptions.
  /// Ridges that do not fit are refused with kMemory, before memory runs out. DEFAULT: no limit.
  Run run = {};
};

struct Ridges {
  /// Soft lines for Features::breaklines, vertices on samples. Their kind is kRidge or kKeptRidge.
  std::vector<Line> ridges, valleys;
  std::uint64_t vertices = 0;  ///< number of vertices of the lines; where several meet, once for each
};

/// Finds the ridges and valleys of a raster, in an order that depends on the raster only. Each line runs within a
/// sample of the highest or lowest samples that it represents, with as few vertices as that and the bound allow. Where
/// one line joins another, both have a vertex. Lines of fewer than 8 samples are omitted. Negating all samples
/// exchanges ridges and valleys, and changes nothing else. Nodata ends a profile; the part before it counts.
///
/// Fails with kUsage for options out of range, with kCancelled, and as the field's source does. A source is read four
/// times from the top down, and gives the same lines as the same samples in memory. REQUIRES: the affine map can be
/// inverted. Memory: 6 bytes a sample, and some 50 for each sample near a high or low one; of a source, those 50 alone.
/// Cost: O(samples) and O(n log n) for the n samples near lines; some 0.1 to 0.3 s a million samples of land, up to 1 s
/// of noise.
Result<Ridges> detect_ridges(const HeightField& field, const RidgeOptions& options);

/// Walls that the mesh represents by a pair of lines each, see detect_cliffs().
struct WallGoals {
  double height = 0;  ///< CliffOptions::height: above 0, in z units
};

/// Ridges and valleys that the mesh prefers, or keeps, see detect_ridges().
struct RidgeGoals {
  double height = 0;      ///< RidgeOptions::height: above 0, in z units
  bool are_kept = false;  ///< RidgeOptions::are_kept
};

/// The features of a mesh. simplify() fits them to the max error of the mesh by fit_features(). It needs a max error,
/// tolerances or a budget with them. With a budget it searches for an error, whatever the effort, fits the features to
/// the error of each run, and fails with kUsage for a budget below what lines and outline need.
struct Features {
  /// Lines that do not depend on the error. Their affine map applies to all lines here. A hard line keeps its heights,
  /// a soft one follows the raster. Where a hard line passes through a sample that has another height, the sample is
  /// given the line's, and what is promised holds for the samples as they are then (Simplified::edits). simplify()
  /// fails with kInput for lines whose heights conflict, and names them. DEFAULT: none.
  LineConstraints breaklines = {};
  /// Results of flatten_lakes() or find_flats() on the field: their shores become lines, rivers flow into them.
  std::vector<Lake> lakes = {};
  std::vector<Line> rivers = {};                    ///< courses seen from above, for carve_rivers()
  std::optional<WallGoals> walls = std::nullopt;    ///< DEFAULT: none
  std::optional<RidgeGoals> ridges = std::nullopt;  ///< DEFAULT: none
  /// Samples that become vertices before the first scan, in this order, and stay, whatever the effort; those outside of
  /// the valid data do not. DEFAULT: none.
  std::vector<SampleAt> points = {};
  /// Polygons that the surface is cut to: of guarantee (2)'s domain what lies in them. Their rings become edges of the
  /// mesh, moved by 1/512 sample at most (3/512 where lines cross), at the heights of the raster between its samples;
  /// they follow it to within half of max_error, all of it within a sample of their vertices. Samples outside are not
  /// judged. Fails as faults do, and with kInput where no surface lies in the polygons. DEFAULT: none.
  Cutline cutline = {};

  /// The mesh holds some lines.
  bool have_lines() const { return !breaklines.lines.empty() || !lakes.empty() || depend_on_error(); }
  /// Some lines depend on the max error of the mesh.
  bool depend_on_error() const { return !rivers.empty() || walls || ridges; }
  /// The lines that do not depend on it: breaklines, then shores.
  LineConstraints fixed_lines() const;
};

struct FeatureFitOptions {
  double max_error = 0;  ///< max error of the mesh to come, in z units, at least 0 and finite
  Run run = {};          ///< progress: of the pass "ridges"
};

/// The lines of a mesh of one max error, and their origins.
struct FittedFeatures {
  LineConstraints lines;         ///< breaklines, shores, rivers, walls, ridges, valleys
  std::vector<River> rivers;     ///< rings, and lines without a height anywhere, are omitted
  std::optional<Cliffs> walls;   ///< nothing where none were asked for
  std::optional<Ridges> ridges;  ///< nothing where none were asked for

  /// Number of given lines: without those of walls and ridges.
  std::uint64_t given_lines() const;
};

/// Makes all lines for a mesh of a given max error. Courses of rivers differ from the exact ones by at most half of the
/// error. Walls avoid all lines so far, and ridges avoid the walls. The same features, field and error give the same
/// lines. simplify() calls it for each mesh that it makes; Simplified::features and lines_for hold the last result.
///
/// Nothing is kept of `field` and `features`. Fails with kUsage for an error below 0 or not finite, and as
/// carve_rivers(), detect_cliffs() and detect_ridges() do. Cost: theirs.
Result<FittedFeatures> fit_features(const HeightField& field, const Features& features,
                                    const FeatureFitOptions& options);

}  // namespace scarp

#pragma GCC visibility pop
