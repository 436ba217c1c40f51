// What a run was asked to do, resolved once: every pass reads the answers here and asks nothing again.
#pragma once

#include <cstdint>

#include "base/memory_budget.h"
#include "scarp/height_field.h"
#include "scarp/simplify.h"

namespace scarp {

/// A run towards its goals. The field and the options stay alive.
struct Plan {
  /// REQUIRES: options that were checked, with an effort that was chosen.
  Plan(const HeightField& field, const SimplifyOptions& options);

  const HeightField& field;
  const SimplifyOptions& options;
  bool is_streamed;            ///< the samples stay in their source
  bool has_budget;             ///< of triangles or vertices
  bool has_lines;              ///< constraints of some kind
  bool frees_vertices;         ///< they may leave their samples
  bool releases_starts;        ///< lines that are but a start need not stay
  bool fits;                   ///< an effort removes vertices
  bool fits_pieces;            ///< so do goals of shapes, where a piece is a strip
  bool removes_last;           ///< after refinement for shapes, which removal then keeps
  bool fits_strips;            ///< vertices are removed strip by strip
  bool finishes_strips;        ///< a strip is worked on while its samples are there, in whatever way
  std::int32_t lattice_steps;  ///< lattice points between two samples that vertices may take, and one of these
  bool is_exact;               ///< the mesh holds each of these points exactly
  double aim;                  ///< the share of every bound that is asked of the engine
  MemoryBudget memory;
};

}  // namespace scarp
