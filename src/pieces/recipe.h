// The recipe of a run: all decisions that follow from its options, made once. Every pass, and every search for a
// budget, reads them here.
#pragma once

#include <cstdint>
#include <optional>

#include "base/memory_budget.h"
#include "fit/fit.h"
#include "metric/request.h"
#include "pieces/budget.h"
#include "pieces/effort.h"
#include "scarp/height_field.h"

namespace scarp {

/// The demands of a search on a run in addition to its options.
struct Scale {
  double factor = 1;      ///< factor of all tolerances
  double line_error = 0;  ///< max error of lines along the raster, where there is no max error
  double start = 1;       ///< the share of all bounds that refinement goes to; fitting works towards the bounds
  std::optional<SquareGoal> squares = std::nullopt;  ///< goal of fitting. DEFAULT: for few triangles
  /// A mesh that breaks this is of no use but for its size: it is neither put in order nor proven.
  std::optional<Budget> room = std::nullopt;
  bool refines_only = false;  ///< fast effort, whatever the options ask for
};

/// How the mesh of a budget is found.
enum class Search {
  kNone,     ///< by one run: there is no budget, or insertion stops at it
  kError,    ///< by runs for several errors (simplify/budget_search.h)
  kSquares,  ///< by a run for a small squared error (simplify/squares_search.h)
};

/// How a run inserts samples.
enum class Route {
  kLocked,  ///< inside a locked border: in the dominant order as one tile, where that may be, else greedily
  kTiles,   ///< in the dominant order, tile by tile, on all threads; strip by strip where samples are streamed
  kGreedy,  ///< the worst of the whole raster first
};

/// True if errors are norms over heights and channels.
inline bool has_norm(const HeightField& field) { return !field.channels.empty() || field.height_scale != 1; }

/// The request that simplify() carries out for these options: effort, threads and the border's max error are chosen
/// where they are not given, and vertices are on samples if errors are norms. REQUIRES: checked options.
Request settle_request(const HeightField& field, const SimplifyOptions& asked);

/// A run towards its goals. The field's samples and the options stay alive.
struct Recipe {
  /// REQUIRES: checked options with a chosen effort.
  Recipe(const HeightField& field, const Request& options, const Scale& scale = {});
  /// The same for the field as lines have changed its heights.
  Recipe on(const HeightField& prepared) const;

  HeightField field;
  const Request& options;
  Scale scale;
  Effort effort;           ///< never kAuto
  EffortTraits traits;     ///< the work of that effort
  bool is_streamed;        ///< the samples stay in their source
  bool has_budget;         ///< budget of triangles or vertices
  bool has_lines;          ///< constraints of some kind
  bool has_source_bounds;  ///< bounds of their own, of streamed samples
  bool is_dominant;        ///< the dominant order can reach the goals
  Route route;
  /// Insertion can stop at a budget. Where it cannot, lines are what they are for one error, or strips are refined one
  /// after the other.
  bool insertion_stops;
  bool fits;  ///< the effort removes vertices
  Search search;
  bool frees_vertices;         ///< vertices may move off their samples
  bool releases_starts;        ///< lines that are but a start need not stay
  bool fits_pieces;            ///< so do goals of shapes, where a piece is a strip
  bool removes_last;           ///< after refinement for shapes, which removal then keeps: far fewer triangles
  bool fits_strips;            ///< vertices are removed strip by strip
  bool finishes_strips;        ///< some pass works on a strip while its samples are in memory
  bool reads_beyond;           ///< samples are read beyond those of refinement: nodata has to be NaN
  bool rounds_offsets;         ///< x and y are rounded to float32
  double height_step;          ///< the power of two whose multiples heights become; 0: they stay as they are
  std::int32_t lattice_steps;  ///< lattice points between two samples at which vertices may be, and one of these
  bool is_exact;               ///< the mesh holds each of these points exactly
  bool is_exact_on_samples;    ///< and each sample
  /// The share of every bound at which the engine aims; of it refinement uses scale.start. The rest is for the rounding
  /// of heights, and with vertices between samples for that of positions, because no sample can be inserted among them
  /// to repair the damage.
  double aim;
  MemoryBudget memory;  ///< bytes a vertex: the peak of a run, in the proof, while the mesh is written, or fitted whole
  FitOptions fit;       ///< without threshold, norm, bounds of samples, threads and progress
};

}  // namespace scarp
