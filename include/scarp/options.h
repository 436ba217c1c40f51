// Set what the mesh must keep, and how much work may make it small: the options of simplify().
//
// Example:
//     SCARP_TRY(const auto& dem, scarp::read_height_field("dem.tif"));
//     scarp::SimplifyOptions options;
//     options.goals.max_error = 20;                   // in the unit of the heights
//     options.quality.effort = scarp::Effort::kHigh;  // a third of the triangles, in some ten times the time
//     options.domain.outline_tolerance = 1;           // samples
//     options.output.normals = true;
//     for (const std::string& conflict : scarp::list_conflicts(dem, options)) std::printf("%s\n", conflict.c_str());
#pragma once

#include <array>
#include <cstdint>
#include <optional>
#include <span>
#include <string>
#include <vector>

#include "scarp/features.h"
#include "scarp/height_field.h"
#include "scarp/run.h"
#include "scarp/tolerances.h"

#pragma GCC visibility push(default)

namespace scarp {

// The goals of a mesh.

/// The quantity that a budget minimises.
enum class Objective {
  kMax,  ///< the max error
  kRms,  ///< the root of the mean square error (with channels: of the norm, as the max error is), while the max error
         ///< stays within max_error or, without one, within what fast effort reaches. With a budget and more than fast
         ///< effort only; see simplify().
};

/// How a sample's errors in heights and channels are combined into one.
enum class Norm {
  kSum,      ///< L1
  kSquares,  ///< L2
  kMax,      ///< L∞
};

/// At least one goal; the first that is reached ends the run.
struct Goals {
  /// Vertical error bound in z units, at least 0: |mesh − sample| <= max_error at every valid sample. 0 reproduces
  /// every sample. DEFAULT: none.
  std::optional<double> max_error = std::nullopt;
  /// Upper bounds. If one of them ends the run, the result is the mesh with the smallest max error among those with at
  /// least 95 % of the budget (max error is not monotone in the number of points); with more than fast effort what the
  /// search for an error has found (see "Budgets" at simplify()). DEFAULT: none.
  std::optional<std::uint64_t> max_triangles = std::nullopt;
  std::optional<std::uint64_t> max_vertices = std::nullopt;
  /// kRms fails with kUsage without a budget. DEFAULT: kMax.
  Objective objective = Objective::kMax;
  /// Over heights and channels, where the field has channels. DEFAULT: L1, as in the 1995 paper.
  Norm norm = Norm::kSum;
};

/// The goal that ended the run.
enum class StopReason { kMaxError, kMaxTriangles, kMaxVertices, kExact };

// Triangle shapes for simulation meshes: flow, waves, heat.

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

// How good the mesh is to be for its goals: the order of insertion, the work after it, where vertices may lie, and the
// shapes of triangles.

/// In which order candidates are inserted.
enum class Order {
  kAuto,      ///< kDominant where it applies, else kGreedy
  kGreedy,    ///< the worst sample of the whole raster first, as the paper's Algorithm III
  kDominant,  ///< the worst sample of its neighbourhood first, tile by tile: many times faster, on all threads, with as
              ///< many vertices. For one error, on heights alone, with Delaunay edges; see simplify().
};

/// How much work follows refinement: for a smaller mesh that satisfies the same bound; with a budget, for a better mesh
/// of the same size.
enum class Effort {
  kAuto,    ///< kNormal; kFast in the greedy order if that is asked for, unless min_shape or the like ask for more,
            ///< and where a memory limit has no room for removal. Simplified::why_fast reports the reason.
  kFast,    ///< none: the refined mesh stays
  kNormal,  ///< removes vertices while every sample stays within the bound: half the triangles, for a few times the
            ///< time. Works strip by strip if samples are not in memory; see simplify().
  kHigh,  ///< removes more, and repairs broken bounds by flipping edges and moving vertices (see Vertices): a third of
          ///< the triangles, for some ten times the time of the greedy order. Possible where kNormal is.
  kMax,   ///< the same, deeper, for some hundred times the time. Ends when Run::is_time_up asks for it, or when there
          ///< is nothing more to gain. Possible where kNormal is.
};

/// Positions allowed for vertices.
enum class Vertices {
  kAuto,     ///< kFree where kHigh and kMax can move them: in affine frames, without channels; else kSamples
  kSamples,  ///< on samples, with their heights
  kFree,     ///< between samples too, in steps of an eighth, with float32 heights of their own. For kHigh and kMax, in
             ///< affine frames, on heights alone; vertices on outlines of nodata, and corners, stay on samples
};

struct Quality {
  /// DEFAULT: kAuto.
  Effort effort = Effort::kAuto;
  /// kFree fails with kUsage below kHigh. DEFAULT: kAuto.
  Vertices vertices = Vertices::kAuto;
  /// Floor of the shapes of triangles, height over longest edge, 0 … 0.5, 0 for none: no vertex is removed or moved, no
  /// edge flipped if that makes a triangle below it, unless it removes one that is as bad. Triangles of refinement, and
  /// those that the outline of nodata forces, may lie below. The default yields: what kNormal removes is removed first,
  /// whatever the shapes, and where more than 15 % of the triangles lie below by then it binds nothing. DEFAULT: 0.1
  /// where vertices are free, else 0.
  std::optional<double> min_shape = std::nullopt;
  /// Angles, edge lengths and their growth, for simulations: vertices are added until they hold, then removed as far as
  /// they still do (with a grade the other way round). With a budget an error is searched for, as with lines. Fails
  /// with kUsage without a max error or a budget, for goals out of range, and for a budget below what they need.
  /// DEFAULT: none.
  ShapeGoals shape = {};
  /// kAuto is kDominant towards an error where that order has no conflicts (list_conflicts()) and, in memory, samples
  /// have no bounds of their own; else kGreedy. kDominant with such bounds refines tiles to the largest, then greedily
  /// to each sample's own; if some sample has none, greedily from the start. kDominant with a budget searches for the
  /// error, or the factor of tolerances, whose mesh fits. DEFAULT: kAuto.
  Order order = Order::kAuto;
};

// The outline of a raster, decided edge by edge: rasters that share a row or a column of samples, simplified apart,
// then meet without a gap, and so do levels of detail of one raster.

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

// Strategies of greedy insertion: the importance of samples, the search for the next one, and the rule for edges.
//
// They cover the paper "Fast Polygonal Approximation of Terrains and Height Fields" (Garland & Heckbert, CMU-CS-95-181,
// 1995) and its programs Scape and Terra. The promise is the same for all strategies: no sample breaks its bound when
// the run ends at its error goal.

/// The importance of a sample (the paper's section 3). Among the samples that break their bound the one with the
/// largest importance is inserted. The promised and reported errors are always the true ones.
///
/// importance = |error| (if `global`) · feature (if any, damped). Features are measured on the raster and do not depend
/// on the mesh, but for the last:
///   kLocal4, kLocal8   |z − mean of the 4 or 8 neighbours|
///   kCurvature         √(z_xx² + 2 z_xy² + z_yy²) by central differences
///   kDistance          from the nearest corner of the sample's triangle, in samples: attenuates errors near vertices
/// Opposite neighbours count in pairs. An incomplete pair (nodata, beyond the border) is omitted, so a plane has no
/// feature on its border either.
struct Importance {
  enum class Feature { kNoFeature, kLocal4, kLocal8, kCurvature, kDistance };
  enum class Damping {
    kUndamped,     ///< f
    kPlusOne,      ///< f + 1
    kSqrtPlusOne,  ///< √(f + 1)
  };
  bool global = true;
  Feature feature = Feature::kNoFeature;
  Damping damping = Damping::kUndamped;
  /// One pass: rank all samples by the feature, insert the best in that order until a goal is reached, never
  /// reconsider. REQUIRES: a feature of the raster, and global = false.
  bool one_pass = false;

  friend bool operator==(const Importance&, const Importance&) = default;
};

/// How the next candidate is found (the paper's section 4). All three insert the same samples in the same order.
enum class Algorithm {
  kBruteForce,  ///< I: scan everything before each insertion. O(m n)
  kLocal,       ///< II: rescan changed triangles, scan all triangles. O(n log m + m²)
  kHeap,        ///< III: rescan changed triangles, keep triangles in a heap. O((n + m) log m)
};

/// Inserting several samples per pass ("parallel" insertion in the paper; Scape's thresholds).
struct Batch {
  enum class Rule {
    kSequential,   ///< one at a time: the best meshes
    kConstant,     ///< per pass all candidates that break their bound
    kFraction,     ///< per pass all candidates of at least `fraction` times the largest importance
    kIndependent,  ///< per pass all candidates whose triangle this pass has not changed yet, worst first
  };
  Rule rule = Rule::kSequential;
  double fraction = 1;  ///< in (0, 1], for kFraction

  friend bool operator==(const Batch&, const Batch&) = default;
};

/// Score of a diagonal in data-dependent triangulation: the smaller one is kept (Scape's -sum, -max, -sqerr, -abn).
enum class EdgeScore {
  kSum,      ///< sum of the two triangles' largest errors
  kMax,      ///< the larger of them
  kSquares,  ///< sum of squared errors over both triangles
  kNormals,  ///< angle between the two triangles' normals (Dyn, Levin, Rippa 1990), in samples and units of z
  kTight,    ///< sum of the squares of the two largest errors, with its own rule of shape; the edges around each new
             ///< vertex are tried until none improves: the fewest triangles (docs/algorithm.md)
};

/// The diagonal of a quadrilateral that is kept.
struct EdgeRule {
  bool data_dependent = false;  ///< false: Delaunay
  EdgeScore score = EdgeScore::kSum;
  /// In [0, 1]. Quality of a diagonal: product over its triangles of area / longer side of the bounding box. If the
  /// worse of the two diagonals has more than `shape_threshold` times the quality of the better one, the score
  /// decides; else the shape. 0: purely data-dependent; 1: purely by shape. For kTight: the least 2·area / longest
  /// side² of a triangle at which the score may decide. Negative: the score's default, 0.5 (kTight: 0.1).
  double shape_threshold = -1;
  /// Finer lattice for triangles that hold few samples: errors for the *score* are then measured against the bilinear
  /// interpolant, ⌈(width + height) / (2 · area · supersample)⌉ times finer. 0: off. Scape calls 0.8 moderate.
  double supersample = 0;
  /// After the last insertion, flip edges while that lowers the sum of squared errors and raises no largest error. Not
  /// for kNormals. False: as the paper's program.
  bool settle = true;

  friend bool operator==(const EdgeRule&, const EdgeRule&) = default;
};

/// How samples are inserted, for simplify_by_paper().
struct Strategy {
  Importance importance = {};  ///< DEFAULT: global error
  Algorithm algorithm = Algorithm::kHeap;
  Batch batch = {};     ///< DEFAULT: one at a time
  EdgeRule edges = {};  ///< DEFAULT: Delaunay
  /// False: a budget that ends the run returns the last mesh, as Scape does, though an earlier one may have been
  /// better. DEFAULT: true. Always so where importance is not an error: one pass, products.
  bool best_of_budget = true;

  friend bool operator==(const Strategy&, const Strategy&) = default;
};

/// The part of the raster that the mesh covers.
struct Domain {
  /// How far, in samples, the outline of the valid data may be simplified, at least 0. It only moves outwards, over
  /// nodata: no valid sample is cut off. Voids that hold no sample close where they are nowhere farther from their
  /// outline. DEFAULT: 0, the exact outline.
  double outline_tolerance = 0;
  /// The edge of the raster. DEFAULT: simplified with the surface.
  Border border = {};
};

/// The contents of the mesh.
struct Output {
  /// Round positions to float32, as GLB and STL hold them, so that what is proven is what is written. False: positions
  /// are double, as OBJ and PLY hold them, and vertices lie on their samples in every affine frame. DEFAULT: true.
  bool float32_positions = true;
  /// Positions that encode_glb() compresses without moving them, where rows run along x (elsewhere this changes
  /// nothing): x and y are double, whatever float32_positions is, and heights are rounded to multiples of a power of
  /// two, at most 1/128 of max_error and of a locked border's. The engine aims 1/256 below max_error for it, unless the
  /// samples are such multiples. Heights stay as they are without a max_error, or where tolerances, weights or channels
  /// bound errors. DEFAULT: false.
  bool lattice = false;
  bool normals = false;  ///< fill Mesh::normals from the full-resolution samples. DEFAULT: false.
  bool uvs = false;      ///< fill Mesh::uvs. DEFAULT: false.
};

/// The goals, and how to reach them. list_conflicts() names settings that do not go together.
struct SimplifyOptions {
  Goals goals = {};
  Tolerances tolerances = {};
  Features features = {};
  Quality quality = {};
  Domain domain = {};
  Output output = {};
  Run run = {};
};

/// The conflicts among the settings of a call of simplify(), each a sentence: "X cannot be combined with Y: reason". It
/// fails with kUsage and the first of them. Empty: none. docs/conflicts.md has the table.
std::vector<std::string> list_conflicts(const HeightField& field, const SimplifyOptions& options);

}  // namespace scarp

#pragma GCC visibility pop
