// The recipe of a run: all decisions that follow from its options, made once. Passes and budget searches read them
// here.
#pragma once

#include <cstdint>
#include <optional>

#include "base/memory_budget.h"
#include "fit/fit.h"
#include "metric/request.h"
#include "pieces/budget.h"
#include "pieces/effort.h"
#include "scarp/height_field.h"

namespace scarp::pieces {

/// The parameters of a run that a search sets, in addition to the options.
struct Scale {
  double factor = 1;      ///< factor of all tolerances
  double line_error = 0;  ///< max error of lines that follow the raster, if the options have no max error
  double start = 1;       ///< share of every bound that refinement uses; fitting uses the whole bound
  std::optional<fit::SquareGoal> squares = std::nullopt;  ///< goal of fitting. DEFAULT: few triangles
  /// Only the size of a mesh above this budget matters: the mesh is neither ordered nor proven.
  std::optional<Budget> room = std::nullopt;
  bool refines_only = false;  ///< fast effort, whatever the options request
};

/// Search for the mesh of a budget.
enum class Search {
  kNone,     ///< one run: no budget, or insertion stops at the budget
  kError,    ///< runs for several errors (simplify/budget_search.h)
  kSquares,  ///< a run for a small squared error (simplify/squares_search.h)
};

/// Order in which a run inserts samples.
enum class Route {
  kLocked,  ///< inside a locked border: in the dominant order as one tile if possible, else greedily
  kTiles,   ///< in the dominant order, tile by tile, on all threads; strip by strip if samples are streamed
  kGreedy,  ///< the worst sample of the whole raster first
};

/// True if errors are norms over heights and channels.
inline bool has_norm(const HeightField& field) { return !field.channels.empty() || field.height_scale != 1; }

/// The options as simplify() executes them. Effort, threads and the border's max error are chosen if absent; vertices
/// are on samples if errors are norms. REQUIRES: checked options.
metric::Request settle_request(const HeightField& field, const SimplifyOptions& asked);

/// The decisions for one run. Borrows the field's samples and the options.
struct Recipe {
  /// REQUIRES: checked options with a chosen effort.
  Recipe(const HeightField& field, const metric::Request& options, const Scale& scale = {});
  /// The same recipe for a field whose heights were changed by lines.
  Recipe on(const HeightField& prepared) const;

  HeightField field;
  const metric::Request& options;
  Scale scale;
  Effort effort;           ///< never kAuto
  EffortTraits traits;     ///< the work of that effort
  bool is_streamed;        ///< the samples stay in their source
  bool has_budget;         ///< for triangles or vertices
  bool has_lines;          ///< constraints of some kind
  bool has_source_bounds;  ///< streamed samples have bounds of their own
  bool has_own_bounds;     ///< samples in memory have bounds of their own
  bool is_dominant;        ///< the dominant order can reach the goals
  Route route;
  /// True if insertion can stop at a budget. It cannot if there are lines, which depend on the error, nor strip by
  /// strip.
  bool insertion_stops;
  bool fits;  ///< the effort removes vertices
  Search search;
  bool frees_vertices;         ///< vertices may move off their samples
  bool releases_starts;        ///< edges that serve only as a start may be removed
  bool fits_pieces;            ///< pieces are fitted: by the effort, or for shape goals
  bool raises_bound;           ///< fitting raises the bound of refinement until the mesh is within scale.room
  bool removes_last;           ///< removal follows refinement for shapes and preserves them: far fewer triangles
  bool fits_strips;            ///< vertices are removed strip by strip
  bool finishes_strips;        ///< some pass works on a strip while its samples are in memory
  bool reads_beyond;           ///< reads samples that refinement does not read, so nodata must be NaN
  bool rounds_offsets;         ///< x and y are rounded to float32
  double height_step;          ///< heights become multiples of this power of two; 0: unchanged
  std::int32_t lattice_steps;  ///< lattice steps between two samples; vertices lie on the lattice
  bool is_exact;               ///< the mesh represents each lattice point exactly
  bool is_exact_on_samples;    ///< the mesh represents each sample's position exactly
  /// The share of every bound that the engine uses; refinement uses scale.start of this share. The rest covers rounded
  /// heights and, for vertices between samples, rounded positions, since no sample can be inserted there to repair
  /// errors.
  double aim;
  MemoryBudget memory;  ///< bytes per vertex at the peak: proof, writing, or fitting as a whole
  fit::FitOptions fit;  ///< without threshold, norm, samples' bounds, threads and progress
};

}  // namespace scarp::pieces
