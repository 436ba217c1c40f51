// The plan of a run: all decisions that follow from its options, made once. Every pass reads them here.
#pragma once

#include <cstdint>
#include <optional>

#include "base/memory_budget.h"
#include "fit/fit.h"
#include "metric/request.h"
#include "pieces/goals.h"
#include "scarp/height_field.h"

namespace scarp {

/// The demands of a budget search on a run in addition to its options.
struct Scale {
  double factor = 1;      ///< factor of all tolerances
  double line_error = 0;  ///< max error of lines along the raster, where there is no max error
  double start = 1;       ///< the share of all bounds that refinement goes to; fitting works towards the bounds
  std::optional<SquareGoal> squares = std::nullopt;  ///< goal of fitting. DEFAULT: for few triangles
  /// A mesh that breaks this is of no use but for its size: it is neither put in order nor proven.
  std::optional<Budget> room = std::nullopt;
};

/// A run towards its goals. The field and the options stay alive.
struct Plan {
  /// REQUIRES: checked options with a chosen effort.
  Plan(const HeightField& field, const Request& options, const Scale& scale = {});

  const HeightField& field;
  const Request& options;
  bool is_streamed;            ///< the samples stay in their source
  bool has_budget;             ///< budget of triangles or vertices
  bool has_lines;              ///< constraints of some kind
  bool has_source_bounds;      ///< bounds of their own, of streamed samples
  bool frees_vertices;         ///< vertices may move off their samples
  bool releases_starts;        ///< lines that are but a start need not stay
  bool fits;                   ///< an effort removes vertices
  bool fits_pieces;            ///< so do goals of shapes, where a piece is a strip
  bool removes_last;           ///< after refinement for shapes, which removal then keeps
  bool fits_strips;            ///< vertices are removed strip by strip
  bool finishes_strips;        ///< some pass works on a strip while its samples are in memory
  std::int32_t lattice_steps;  ///< lattice points between two samples at which vertices may be, and one of these
  bool is_exact;               ///< the mesh holds each of these points exactly
  double aim;                  ///< the share of every bound at which the engine aims; of it refinement uses scale.start
  Scale scale;
  MemoryBudget memory;
};

}  // namespace scarp
