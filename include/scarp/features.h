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

#include <cstdint>
#include <optional>
#include <vector>

#include "scarp/cliffs.h"
#include "scarp/height_field.h"
#include "scarp/lines.h"
#include "scarp/result.h"
#include "scarp/ridges.h"
#include "scarp/rivers.h"
#include "scarp/run.h"
#include "scarp/water.h"

#pragma GCC visibility push(default)

namespace scarp {

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
