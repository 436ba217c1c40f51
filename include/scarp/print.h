// Prepare a terrain for printing: simplified, placed in millimetres, cut into print tiles, closed, with a proof for the
// written positions.
//
// Example:
//     SCARP_TRY(auto&& dem, scarp::read_height_field("dem.tif"));
//     const scarp::PrintOptions print{.size = 150, .exaggerate = 2};
//     SCARP_TRY(const auto& made, scarp::simplify_for_print(dem, print, {.goals = {.max_error = 20}}));
//     SCARP_RETURN_IF_ERROR(scarp::write_mesh(made.print.tiles.front().mesh, "hills.stl"));
#pragma once

#include <cstdint>
#include <optional>
#include <vector>

#include "scarp/height_field.h"
#include "scarp/mesh.h"
#include "scarp/points.h"
#include "scarp/result.h"
#include "scarp/simplify.h"

#pragma GCC visibility push(default)

namespace scarp {

/// The shape of the print. z units are those of the field. Print units are millimetres if there is a size, else those
/// of the field's frame.
struct PrintOptions {
  /// Height of the underside, in z units, below the lowest vertex. Not allowed with a thickness. DEFAULT: 2 % of the
  /// longest side below the lowest vertex.
  std::optional<double> base = std::nullopt;
  /// Distance from the underside to the lowest vertex, above 0: `thickness` in z units, `printed_thickness` in print
  /// units. At most one of them is set.
  std::optional<double> thickness = std::nullopt, printed_thickness = std::nullopt;
  /// The longest side in millimetres, above 0. DEFAULT: none, the coordinates are those of the frame.
  std::optional<double> size = std::nullopt;
  double exaggerate = 1;  ///< factor of heights, above 0
  /// The max error of the print, in print units, above 0. With Goals::max_error, the stricter one counts. DEFAULT:
  /// none.
  std::optional<double> max_error = std::nullopt;
  int columns = 1, rows = 1;  ///< print tiles, at least 1
  bool dovetail = false;      ///< a trapezoid tab in the middle of each common edge of two tiles
  double gap = 0;             ///< distance between print tiles, in print units, at least 0

  bool is_split() const { return columns > 1 || rows > 1; }
  /// True if the coordinates of the print differ from those of the frame.
  bool is_placed() const { return size.has_value() || exaggerate != 1; }
};

/// A print tile: a piece of a print, and a separate solid.
struct PrintTile {
  int row = 1, column = 1;  ///< counted from 1, from the top left
  Mesh mesh;                ///< closed; positions as written
  SolidFacts facts;         ///< properties of `mesh`
};

struct Print {
  double base = 0;               ///< height of the underside, in z units
  Placement placement;           ///< placement of all print tiles; used if PrintOptions::is_placed()
  std::vector<PrintTile> tiles;  ///< row by row; tiles without a triangle are omitted
  int empty_tiles = 0;           ///< tiles omitted
  double max_error = 0;          ///< max error of the tops, as written, at the samples, in z units
  std::uint64_t uncovered = 0;   ///< valid samples in gaps
  HeightRange heights;           ///< range of the samples

  std::uint64_t vertices() const;   ///< total of all print tiles
  std::uint64_t triangles() const;  ///< total of all print tiles
};

struct PrintedTerrain {
  Simplified simplified;  ///< the terrain from which the print was made, in the frame of the field
  Print print;
};

/// Estimates the number of print units for one z unit, without a mesh, from the samples with heights. Reads a field
/// once if it is not in memory. Fails if a read fails, and with kInput if no sample has a height.
Result<double> estimate_print_scale(const HeightField& field, const PrintOptions& print);

/// The same for points, from their extent.
Result<double> estimate_print_scale(const PointSet& points, const PrintOptions& print);

/// Simplifies a field for a print. Rounding moves the placed positions, so the mesh is made with 1/1024 of the max
/// error in reserve. If that is not enough, the mesh is remade with a smaller max error, up to three times. The bound
/// then holds for the print tiles as written. Cuts between tiles are edges of the mesh. If a budget ends the run, the
/// mesh of this run is the result, regardless of the error of the print.
///
/// `options`: as for simplify(). float32_positions is ignored, and cuts are added to the breaklines. The heights of
/// hard lines are written to `field`, as by apply_edits(); Simplified::edits lists these edits. The arguments are not
/// needed after the call.
///
/// Fails with kUsage for options in conflict or out of range (the message begins with the option's name, such as
/// "base=300 is not …", or with "print tiles: " if the print cannot be cut in this way), for several tiles in a
/// non-affine frame, and for a frame in space. Fails with kPromise if samples outside of gaps have no top above them,
/// and if float32 positions cannot satisfy the max error. Also fails as simplify(), build_solid() and measure() do.
/// Cost: usually one or two runs of simplify(), at most four, each with a measure() of the print.
Result<PrintedTerrain> simplify_for_print(OwnedHeightField& field, const PrintOptions& print, SimplifyOptions options);

struct PrintedPoints {
  SimplifiedPoints made;  ///< the terrain from which the print was made, in the coordinates of the points
  Print print;
};

/// The same for points. `options`: as for simplify_points(); float32_positions is ignored. PointOptions::tolerances
/// hold for the terrain; for the print only the max error is judged. Fails with kUsage for several print tiles.
Result<PrintedPoints> simplify_for_print(const PointSet& points, const PrintOptions& print, PointOptions options);

}  // namespace scarp

#pragma GCC visibility pop
