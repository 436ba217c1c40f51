// Making a print of a terrain: simplified so that the bound holds for what is written, placed, cut, closed, proven.
#pragma once

#include <optional>
#include <string>
#include <vector>

#include "options/solid_options.h"
#include "reports/json.h"
#include "scarp/simplify.h"
#include "scarp/solid.h"

namespace scarp::cli {

struct Sheet {
  int row = 1, column = 1;
  Mesh mesh;  ///< a solid
  SolidFacts facts;
};

/// A print, and what is known of it.
struct Print {
  SolidPlace place;
  std::vector<Sheet> sheets;  ///< row by row; those without a triangle are left out
  int empty_sheets = 0;
  double max_error = 0;         ///< of the tops as they are written, against the samples, in z units
  std::uint64_t uncovered = 0;  ///< samples in gaps
  HeightRange heights;          ///< of the samples
  std::uint64_t vertices() const;
  std::uint64_t triangles() const;
};

/// The sheets of --split; nothing if the print is whole. Fails with kUsage in frames that are not affine, and as
/// SheetPlan.
Result<std::optional<SheetPlan>> plan_sheets(const SolidPlan& plan, const HeightField& field);

/// Places, cuts and closes the terrain, of which the cuts are edges, and judges the tops against the samples, those
/// within the cutline if there is one. Fails as build_solid(), and with kPromise where samples have no top above them
/// and no gap accounts for it.
Result<Print> make_print(const SolidPlan& plan, const HeightField& field, const SheetPlan* sheets, const Mesh& terrain,
                         const Cutline* cutline, int threads);

/// simplify() with the cuts as lines, again with a smaller bound where rounding to the print's float32 costs more than
/// was reserved. Fails with kPromise where that does not help, and as simplify() and make_print().
struct PrintedTerrain {
  Simplified simplified;
  Print print;
};
Result<PrintedTerrain> simplify_for_print(const SolidPlan& plan, OwnedHeightField& field, SimplifyOptions options);

/// The "solid" object of the report; `paths` has the file of each sheet, or one for all.
Json describe_print(const SolidPlan& plan, const Print& print, const std::vector<std::string>& paths);
/// Its part of the summary.
std::string print_lines(const SolidPlan& plan, const Print& print);

}  // namespace scarp::cli
