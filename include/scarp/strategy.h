// Strategies of greedy insertion: the importance of samples, the search for the next one, and the rule for edges.
//
// They cover the paper "Fast Polygonal Approximation of Terrains and Height Fields" (Garland & Heckbert, CMU-CS-95-181,
// 1995) and its programs Scape and Terra. The promise is the same for all strategies: no sample breaks its bound when
// the run ends at its error goal.
#pragma once

#pragma GCC visibility push(default)

namespace scarp {

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

}  // namespace scarp

#pragma GCC visibility pop
