#include "pieces/plan.h"

#include "metric/source_bounds.h"
#include "pieces/effort.h"
#include "pieces/goals.h"

namespace scarp {

Plan::Plan(const HeightField& on, const Request& asked, const Scale& by)
    : field(on),
      options(asked),
      is_streamed(on.samples == nullptr),
      has_budget(scarp::has_budget(asked)),
      has_lines(scarp::has_lines(asked)),
      has_source_bounds(scarp::has_source_bounds(on, asked)),
      frees_vertices(vertices_are_free(on, asked)),
      releases_starts(asked.quality.effort == Effort::kNormal || frees_vertices),
      fits(asked.quality.effort != Effort::kFast),
      // Shape goals need strips without the redundant vertices of tile borders, whatever the effort.
      fits_pieces((fits && !by.squares) || asked.quality.shape.any()),
      removes_last(scarp::removes_last(on, asked)),
      fits_strips(is_streamed && fits_pieces),
      finishes_strips(fits_strips || (is_streamed && (has_lines || has_source_bounds))),
      lattice_steps(choose_lattice_steps(on, asked)),
      is_exact(lattice_is_exact(on, asked, lattice_steps)),
      aim(aim_of(on, asked)),
      scale(by),
      memory(memory_budget(on, asked)) {}

}  // namespace scarp
