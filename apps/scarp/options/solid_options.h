// --solid and --split: a print of the terrain, whole or in sheets.
#pragma once

#include <array>
#include <optional>
#include <string>

#include "options/options.h"
#include "scarp/mesh.h"
#include "scarp/solid.h"

namespace CLI {
class App;
}

namespace scarp::cli {

/// A length of the print, in millimetres or, of a solid without a size, in the units of the raster.
struct Length {
  double value = 0;
  bool is_metric = false;  ///< it was given as mm, cm, m or in
};

struct SolidPlan {
  std::optional<double> base;       ///< height in the raster's units
  std::optional<Length> thickness;  ///< below the lowest vertex
  std::optional<double> size;       ///< of the longest side, in mm
  double exaggerate = 1;
  int columns = 1, rows = 1;  ///< of sheets
  bool dovetail = false;
  std::optional<Length> gap;

  bool is_split() const { return columns * rows > 1; }
  /// Coordinates are not those of the raster.
  bool is_placed() const { return size.has_value() || exaggerate != 1; }
};

struct SolidArguments {
  Given solid, split;

  void add_to(CLI::App& command);
  /// Nothing without --solid.
  Result<std::optional<SolidPlan>> parse() const;
  std::string canonical() const { return canonical_option("--solid", solid) + canonical_option("--split", split); }
};

/// Where the terrain's print stands, and its base in the raster's heights: 2 % of the longest side below the lowest
/// vertex where the plan says nothing. kUsage if the base is not below the lowest vertex (named).
struct SolidPlace {
  double base = 0;
  Placement placement;
};
Result<SolidPlace> find_place(const SolidPlan& plan, const Mesh& terrain);

/// "hills-r1-c2.stl": the file of a sheet.
std::string sheet_path(const std::string& output, int row, int column);

}  // namespace scarp::cli
