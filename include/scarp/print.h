// A print of a terrain: simplified, placed, cut into sheets, closed, and proven as it will be written.
#pragma once

#include <cstdint>
#include <optional>
#include <vector>

#include "scarp/height_field.h"
#include "scarp/mesh.h"
#include "scarp/result.h"
#include "scarp/simplify.h"
#include "scarp/solid.h"

#pragma GCC visibility push(default)

namespace scarp {

/// What the print is to be. z units are those of the field; print units are millimetres where there is a size, else
/// those of the field's frame.
struct PrintOptions {
  /// Height of the underside, in z units, below the lowest vertex. Not together with a thickness. DEFAULT: 2 % of the
  /// longest side below the lowest vertex.
  std::optional<double> base = std::nullopt;
  /// How far the underside lies below the lowest vertex, above 0: in z units, or in print units. One of them at most.
  std::optional<double> thickness = std::nullopt, printed_thickness = std::nullopt;
  /// The longest side in millimetres, above 0. DEFAULT: none, the coordinates are those of the frame.
  std::optional<double> size = std::nullopt;
  double exaggerate = 1;      ///< what heights are multiplied with, above 0
  int columns = 1, rows = 1;  ///< of sheets that the print is cut into, at least 1
  bool dovetail = false;      ///< as SheetOptions::dovetail
  double gap = 0;             ///< between sheets, in print units, at least 0

  bool is_split() const { return columns > 1 || rows > 1; }
  /// Coordinates of the print are not those of the frame.
  bool is_placed() const { return size.has_value() || exaggerate != 1; }
};

/// A piece of a print that is a solid of its own.
struct Sheet {
  int row = 1, column = 1;  ///< counted from 1, from the top left
  Mesh mesh;                ///< closed; positions as they are to be written
  SolidFacts facts;         ///< of `mesh`
};

/// A print, and what is known of it.
struct Print {
  double base = 0;              ///< height of the underside, in z units
  Placement placement;          ///< of all sheets; used where PrintOptions::is_placed()
  std::vector<Sheet> sheets;    ///< row by row; those without a triangle are left out
  int empty_sheets = 0;         ///< that were left out
  double max_error = 0;         ///< of the tops as they are to be written, against the samples, in z units
  std::uint64_t uncovered = 0;  ///< valid samples in gaps
  HeightRange heights;          ///< of the samples

  std::uint64_t vertices() const;   ///< of all sheets
  std::uint64_t triangles() const;  ///< of all sheets
};

struct PrintedTerrain {
  Simplified simplified;  ///< the terrain that the print was made of, in the frame of the field
  Print print;
};

/// Simplifies a field for a print. Positions of a print are float32 where the print stands, which moves them: the mesh
/// is made with 1/1024 of the max error in reserve, and made again with a smaller one, up to three times, where that is
/// not enough. So the bound holds for the sheets as they are to be written. Cuts between sheets are edges of the mesh.
/// A budget that ends the run is kept, whatever the error of the print then is.
///
/// `options`: as for simplify(). float32_positions is not looked at; cuts are added to its breaklines. `field` is given
/// the heights of hard lines, as by apply_edits(): Simplified::edits tells them. Nothing is kept of the arguments.
///
/// Fails with kUsage for options out of range or that contradict each other (the sentence begins with the field's name,
/// such as "base=300 is not …"; with "sheets: " where they cannot be cut so), and for sheets in a frame that is not
/// affine; with kPromise where samples have no top above them and no gap accounts for it, and where float32 cannot hold
/// the error; as simplify(), build_solid() and measure() do. Cost: up to four runs of simplify(), one or two as a rule,
/// each with a measure() of the print.
Result<PrintedTerrain> simplify_for_print(OwnedHeightField& field, const PrintOptions& print, SimplifyOptions options);

}  // namespace scarp

#pragma GCC visibility pop
