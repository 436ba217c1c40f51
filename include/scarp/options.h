// Set the options of simplify(): the goals of the mesh, and the effort to make it small.
//
// Example:
//     SCARP_TRY(const auto& dem, scarp::read_height_field("dem.tif"));
//     scarp::SimplifyOptions options;
//     options.goals.max_error = 20;                   // in the unit of the heights
//     options.quality.effort = scarp::Effort::kHigh;  // a third of kFast's triangles, but much slower
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
  kRms,  ///< the RMS error (with channels: the RMS of the norm). The max error stays within max_error or, if that is
         ///< not set, within the max error of fast effort. Requires a budget and more than fast effort; see simplify().
};

/// Combines errors in height and channels into one.
enum class Norm {
  kSum,      ///< L1
  kSquares,  ///< L2
  kMax,      ///< L∞
};

/// At least one goal is required; the first one reached ends the run.
struct Goals {
  /// Vertical error bound in z units, at least 0: |mesh − sample| <= max_error at every valid sample. 0 reproduces
  /// every sample. DEFAULT: none.
  std::optional<double> max_error = std::nullopt;
  /// Upper bounds. If one of them ends the run, the result is the mesh with the smallest max error among meshes of at
  /// least 95 % of the budget. (The max error is not monotone in the number of points.) With more than fast effort, the
  /// result is that of the search for an error (see "Budgets" at simplify()). DEFAULT: none.
  std::optional<std::uint64_t> max_triangles = std::nullopt;
  std::optional<std::uint64_t> max_vertices = std::nullopt;
  /// kRms fails with kUsage without a budget. DEFAULT: kMax.
  Objective objective = Objective::kMax;
  /// The norm over heights and channels, for fields with channels. DEFAULT: L1, as in the 1995 paper.
  Norm norm = Norm::kSum;
};

/// The goal that ended the run.
enum class StopReason { kMaxError, kMaxTriangles, kMaxVertices, kExact };

// Triangle shapes for simulation meshes: flow, waves, heat.

/// Goals for the shapes of triangles seen from above, in the coordinates of the mesh. Delaunay refinement (Ruppert
/// 1995; Shewchuk 2002; off-centres, Üngör 2004) adds vertices until the goals are met; the error bound holds
/// throughout.
///
/// Where goals conflict, the later one in this list yields, and ShapeReport counts the violations: (1) the error bound;
/// (2) the position of lines, cutlines and outlines; (3) max_edge and grade, which always hold; (4) min_angle; (5)
/// min_edge; (6) few triangles. A triangle with a smallest angle of a and a shortest edge of s is at least s·sin(a)
/// high. The time step of a flow solver depends on this height; a long edge at a small angle does not increase the
/// height.
///
/// New vertices lie on samples where triangles are much larger than cells. Elsewhere they lie at multiples of a half, a
/// quarter, … a 256th of a sample, at the bilinear height of the raster. No two vertices have the same position.
/// Vertices added for angles are at least 1/32 of a sample (or a quarter of max_edge, if less) from all other vertices,
/// so refinement always ends. Outlines are split exactly; lines and cuts are split within a 256th of a sample, at their
/// own heights. Efforts above fast then remove vertices that angles, lengths and the bound do not need, and move
/// others. High effort also makes the mesh of normal effort, and max effort that of high effort. The result is the mesh
/// with fewer triangles, unless the time is up.
///
/// Guarantees, up to the rounding of positions: (1) no edge is longer than max_edge; (2) grade holds, as below; (3)
/// each triangle with an angle below min_angle is counted in ShapeReport::below. Up to 20 degrees, and without corners
/// of less than 60 degrees between lines or the outline, theory predicts few or no such triangles. Beyond 20 degrees
/// nothing is proven, but on rasters without lines hardly any such triangles remain up to 30 degrees. Some remain where
/// two lines, or a line and a sample that the bound needs, are closer together than vertices added for angles may be.
struct ShapeGoals {
  /// Degrees, 0 … 33. DEFAULT: 0, any.
  double min_angle = 0;
  /// Longest edge, in the units of the mesh's x and y; at least an eighth of a sample. DEFAULT: none.
  std::optional<double> max_edge = std::nullopt;
  /// Growth rate of edge lengths, above 0. No edge is longer than 2·(s + grade·d) for any vertex: s is the length of
  /// the shortest edge at the vertex, d the distance along edges from the vertex to the far end of the long edge. s is
  /// at least half of a sample's longer side. DEFAULT: none.
  std::optional<double> grade = std::nullopt;
  /// Shortest edge, in the units of the mesh's x and y, above 0, at most half of max_edge. The time step of a flow
  /// solver depends on it. All other goals have priority: shorter edges that they need remain, and are counted in
  /// ShapeReport::shorter. Vertices added for max_edge and grade make no edge shorter than this, except where they
  /// halve an edge that is too long. Efforts above fast first remove vertices at shorter edges. They never make an edge
  /// shorter than min_edge unless they remove an even shorter one. DEFAULT: none.
  std::optional<double> min_edge = std::nullopt;

  bool any() const { return min_angle > 0 || max_edge || grade || min_edge; }
};

/// Triangle shapes, seen from above.
struct ShapeReport {
  double min_angle = 0;                        ///< degrees
  double shortest_edge = 0, longest_edge = 0;  ///< in units of x and y
  std::uint64_t below = 0;                     ///< triangles with an angle below min_angle
  std::uint64_t forced = 0;                    ///< triangles of `below` at corners between lines or the outline
  std::uint64_t below_beside_lines = 0;        ///< other triangles of `below` with a corner on a line or the outline
  std::uint64_t shorter = 0;                   ///< edges shorter than min_edge
  std::uint64_t shorter_beside_lines = 0;      ///< edges of `shorter` with an end on a line or the outline
  std::array<std::uint64_t, 12> histogram{};   ///< triangles by their smallest angle: 0 … 5 degrees, …, 55 … 60
};

// The quality of the mesh: order of insertion, effort, positions of vertices, shapes of triangles.

/// The order in which candidates are inserted.
enum class Order {
  kAuto,      ///< kDominant where it applies, else kGreedy
  kGreedy,    ///< the worst sample of the whole raster first, as in the paper's Algorithm III
  kDominant,  ///< the worst sample of each neighbourhood first, tile by tile: many times faster, on all threads, with
              ///< as many vertices. Requires one error, no channels, Delaunay edges; see simplify().
};

/// The work after refinement: it makes a smaller mesh for the same bound or, with a budget, a better mesh of the same
/// size.
enum class Effort {
  kAuto,    ///< kNormal; kFast if the greedy order is requested and no option such as min_shape needs more
            ///< effort, or if the memory limit is too small for removal. Simplified::why_fast reports the reason.
  kFast,    ///< no further work: the result is the refined mesh
  kNormal,  ///< removes vertices while every sample stays within the bound: half the triangles of kFast, but a few
            ///< times slower. Works strip by strip for samples not in memory; see simplify().
  kHigh,    ///< removes more vertices, and repairs broken bounds by flipping edges and moving vertices (see Vertices).
            ///< Makes a third of kFast's triangles, in some ten times the time of the greedy order. Allowed where
            ///< kNormal is.
  kMax,     ///< the same with a deeper search, in some hundred times the time of kFast. Ends when Run::is_time_up
            ///< returns true, or without further gains. Allowed where kNormal is.
};

/// Positions allowed for vertices.
enum class Vertices {
  kAuto,     ///< kFree for kHigh and kMax in affine frames without channels; else kSamples
  kSamples,  ///< on samples, with their heights
  kFree,     ///< also between samples, in steps of an eighth of a sample, with optimised float32 heights. Only in
             ///< affine frames without channels, and not for kFast. Corners, and vertices on outlines of nodata, remain
             ///< on samples
};

struct Quality {
  /// DEFAULT: kAuto.
  Effort effort = Effort::kAuto;
  /// kFree fails with kUsage for kFast. DEFAULT: kAuto.
  Vertices vertices = Vertices::kAuto;
  /// Lower bound for the shape of triangles (height over longest edge), 0 … 0.5, 0 for none. No removal, move or flip
  /// makes a triangle below this bound, unless it removes an equally bad triangle. Triangles of refinement, and those
  /// forced by the outline of nodata, may lie below the bound. The default bound is weaker: kNormal's removals ignore
  /// it, and it has no effect if more than 15 % of the triangles then lie below it. DEFAULT: 0.1 for kHigh and kMax
  /// where vertices are free, else 0.
  std::optional<double> min_shape = std::nullopt;
  /// Goals for angles, edge lengths and their growth, for simulations: vertices are added until the goals hold, then
  /// removed while the goals hold (with a grade, in reverse order). With a budget, simplify() searches for an error, as
  /// with lines. It fails with kUsage with neither a max error nor a budget, for goals out of range, and for a budget
  /// too small for the goals. DEFAULT: none.
  ShapeGoals shape = {};
  /// With an error goal, kAuto means kDominant if that order has no conflicts (list_conflicts()) and samples in memory
  /// have no individual bounds; else kGreedy. With individual bounds, kDominant first refines tiles to the largest
  /// bound, then refines greedily to each sample's bound. If a sample has no bound, kDominant refines greedily from the
  /// start. With a budget, kDominant searches for the error, or the factor of tolerances, whose mesh fits the budget.
  /// DEFAULT: kAuto.
  Order order = Order::kAuto;
};

// The outline of a raster, simplified edge by edge: rasters that share a row or a column of samples then meet without a
// gap, as do levels of detail of one raster.

/// Samples of the four edges of a raster, ascending: columns of its first (top) and last (bottom) row, rows of its
/// first (left) and last (right) column.
struct EdgeVertices {
  std::vector<std::int32_t> top, bottom, left, right;
};

/// Heights of the neighbouring rasters, one row above and below a raster, and one column to its left and right. NaN is
/// nodata; an empty list means unknown.
struct BeyondEdges {
  std::vector<float> top, bottom, left, right;
};

/// The edge of the raster as a line that depends on the edge's own samples only.
///
/// On each edge, the vertices of the mesh are those of the line, at their samples' heights: no effort adds, removes or
/// moves any. Samples between two vertices of an edge are within their bounds of the line. Where nodata is adjacent to
/// valid samples of an edge, corners of the surface's outline may lie between two vertices of the line. These corners
/// become additional vertices, at the line's height, rounded to float32.
///
/// Normals at an edge depend only on samples that both rasters know: those of the edge, and those beyond it on either
/// side (`beyond`). Without `beyond`, the surface counts as level across the edge.
///
/// Breaklines may end on an edge only at vertices of the line (set `vertices` to add vertices).
///
/// One thread refines a mesh with a locked border. This refinement needs the samples in memory and two copies of them,
/// 8 bytes a sample; see Order.
struct Border {
  bool is_locked = false;  ///< DEFAULT: false, edges are simplified with the surface.
  /// Max error of the line, at most that of the goals. DEFAULT: that of the goals, or bounds from tolerances or
  /// weights. A search for a budget does not change the line.
  std::optional<double> max_error = std::nullopt;
  /// The vertices of the line. Corners, and the first and last sample of each run of valid samples, are always
  /// vertices. DEFAULT: those of simplify_edge(); for fields with channels, those of a line that satisfies the norm,
  /// with segments of at most 256 steps.
  std::optional<EdgeVertices> vertices = std::nullopt;
  /// Heights for normals; each list is as long as its edge, or empty. DEFAULT: unknown. See read_beyond().
  BeyondEdges beyond = {};
};

/// Returns the vertices of an edge, ascending. They are the fewest for which the line through them differs from every
/// sample by at most 511/512 of `tolerance` (or of the sample's value in `tolerances`, if given; +infinity: no bound).
/// The remaining 1/512 allows for the rounding of positions. NaN is nodata: the first and the last sample of each run
/// of heights are vertices. Among lines with equally few vertices, the one whose last vertices come earliest is
/// returned. No segment spans more than 8192 steps, so the cost is at most O(samples · 8192), and usually a few steps a
/// sample. The result is the same on every machine.
std::vector<std::int32_t> simplify_edge(std::span<const float> heights, double tolerance,
                                        std::span<const double> tolerances = {});

// Strategies of greedy insertion: importance of samples, search for the next sample, rule for edges.
//
// They cover the paper "Fast Polygonal Approximation of Terrains and Height Fields" (Garland & Heckbert, CMU-CS-95-181,
// 1995) and its programs Scape and Terra. All strategies guarantee that no sample breaks its bound when the run ends at
// its error goal.

/// The importance of a sample (the paper's section 3). Among the samples that break their bound, the one with the
/// largest importance is inserted. Bounds and reports use the true errors.
///
/// importance = |error| (if `global`) · feature (if any, damped). Features depend on the raster only, except the last
/// one, which depends on the mesh:
///   kLocal4, kLocal8   |z − mean of the 4 or 8 neighbours|
///   kCurvature         √(z_xx² + 2 z_xy² + z_yy²) by central differences
///   kDistance          distance to the nearest corner of the triangle, in samples: attenuates errors near vertices
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
  /// One pass: rank all samples once by the feature, and insert them in that order until a goal is reached. REQUIRES: a
  /// feature of the raster, and global = false.
  bool one_pass = false;

  friend bool operator==(const Importance&, const Importance&) = default;
};

/// The search for the next candidate (the paper's section 4). All three insert the same samples in the same order.
enum class Algorithm {
  kBruteForce,  ///< I: scan all samples before each insertion. O(m n)
  kLocal,       ///< II: rescan changed triangles, compare all triangles. O(n log m + m²)
  kHeap,        ///< III: rescan changed triangles, keep triangles in a heap. O((n + m) log m)
};

/// Insertion of several samples per pass ("parallel" insertion in the paper; Scape's thresholds).
struct Batch {
  enum class Rule {
    kSequential,   ///< one at a time: the best meshes
    kConstant,     ///< all candidates that break their bound
    kFraction,     ///< all candidates whose importance is at least `fraction` times the largest
    kIndependent,  ///< all candidates whose triangle the pass has not changed yet, worst first
  };
  Rule rule = Rule::kSequential;
  double fraction = 1;  ///< in (0, 1], for kFraction

  friend bool operator==(const Batch&, const Batch&) = default;
};

/// Score of a diagonal in data-dependent triangulation: the diagonal with the smaller score is used (Scape's -sum,
/// -max, -sqerr, -abn).
enum class EdgeScore {
  kSum,      ///< sum of the two triangles' largest errors
  kMax,      ///< the larger of these two errors
  kSquares,  ///< sum of squared errors over both triangles
  kNormals,  ///< angle between the two triangles' normals (Dyn, Levin, Rippa 1990), in samples and units of z
  kTight,    ///< sum of the squares of the two largest errors, with its own shape rule. Edges around each new vertex
             ///< are flipped until no flip improves the score. Makes the fewest triangles (docs/algorithm.md)
};

/// The choice of the diagonal of a quadrilateral.
struct EdgeRule {
  bool data_dependent = false;  ///< false: Delaunay
  EdgeScore score = EdgeScore::kSum;
  /// In [0, 1]. The quality of a diagonal is the product, over its two triangles, of area / longer side of the bounding
  /// box. If the worse diagonal has more than `shape_threshold` times the quality of the better one, the score decides;
  /// else the quality does. 0: purely data-dependent; 1: purely by shape. For kTight: the least 2·area / longest side²
  /// of a triangle at which the score may decide. Negative: the score's default, 0.5 (kTight: 0.1).
  double shape_threshold = -1;
  /// For triangles with few samples, errors for the *score* are measured against the bilinear interpolant on a lattice
  /// ⌈(width + height) / (2 · area · supersample)⌉ times finer. 0: off. Scape calls 0.8 moderate.
  double supersample = 0;
  /// True: after the last insertion, edges are flipped while this lowers the sum of squared errors without raising the
  /// largest error. Not for kNormals. False: no such flips, as in the paper's program.
  bool settle = true;

  friend bool operator==(const EdgeRule&, const EdgeRule&) = default;
};

/// The strategy of simplify_by_paper().
struct Strategy {
  Importance importance = {};  ///< DEFAULT: global error
  Algorithm algorithm = Algorithm::kHeap;
  Batch batch = {};     ///< DEFAULT: one at a time
  EdgeRule edges = {};  ///< DEFAULT: Delaunay
  /// False: if a budget ends the run, the result is the last mesh, as in Scape, though an earlier one may have been
  /// better. If importance is not an error (one pass, products), the last mesh is always the result. DEFAULT: true.
  bool best_of_budget = true;

  friend bool operator==(const Strategy&, const Strategy&) = default;
};

/// The part of the raster that the mesh covers.
struct Domain {
  /// Tolerance, in samples, for simplifying the outline of the valid data, at least 0. The outline only moves outwards,
  /// over nodata: no valid sample is cut off. Voids without a sample are closed if no point in them is farther than
  /// this tolerance from their outline. DEFAULT: 0, the exact outline.
  double outline_tolerance = 0;
  /// The edge of the raster. DEFAULT: simplified with the surface.
  Border border = {};
};

struct Output {
  /// Rounds positions to float32, as GLB and STL store them, so that the proof holds for the written file. False:
  /// positions are double, as in OBJ and PLY, and vertices lie on their samples in every affine frame. DEFAULT: true.
  bool float32_positions = true;
  /// Rounds positions so that encode_glb() compresses them without moving them. Has no effect unless rows run along x.
  /// x and y are always double. Heights are rounded to multiples of a power of two, at most 1/128 of max_error and of a
  /// locked border's max error. To allow for this rounding, the engine uses a bound 1/256 below max_error, unless the
  /// samples already are such multiples. Heights are not rounded without a max_error, or where tolerances, weights or
  /// channels bound errors. DEFAULT: false.
  bool lattice = false;
  bool normals = false;  ///< fill Mesh::normals from the full-resolution samples. DEFAULT: false.
  bool uvs = false;      ///< fill Mesh::uvs. DEFAULT: false.
};

/// list_conflicts() lists conflicting settings.
struct SimplifyOptions {
  Goals goals = {};
  Tolerances tolerances = {};
  Features features = {};
  Quality quality = {};
  Domain domain = {};
  Output output = {};
  Run run = {};
};

/// The conflicts among the settings of a call of simplify(), each as a sentence: "X cannot be combined with Y: reason".
/// If there are any, simplify() fails with kUsage and the first sentence. docs/conflicts.md lists all conflicts.
std::vector<std::string> list_conflicts(const HeightField& field, const SimplifyOptions& options);

}  // namespace scarp

#pragma GCC visibility pop
