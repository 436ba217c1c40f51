// The passes that a piece goes through on its way from samples to a mesh that satisfies the bound with few vertices:
//
//     seed → insert constraints → refine → fit
//
// Each prepares the piece for the next. The recipe of a run decides which passes run, and with which goals.
#pragma once

#include <cstdint>

#include "fit/fit.h"
#include "lines/constraints.h"
#include "metric/error_metric.h"
#include "pieces/piece.h"
#include "scarp/result.h"
#include "scarp/run.h"

namespace scarp {

/// Seeds the mesh of a piece between neighbours: its domain, with the outline's vertices only. If no cell is surface,
/// all triangles are outside. Edges along shared rows are free, since the neighbour also decides whether the domain
/// ends there.
Result<void> seed(Piece& piece);

/// How constraints are inserted.
struct ConstraintGoals {
  double threshold = 0;          ///< threshold of the errors, where the piece has no aims of its own
  bool releases_starts = false;  ///< edges that are only a start become free in the end, with their vertices
  int threads = 1;
};

/// Makes the graph, in the piece's coordinates, chains of constrained edges, and refines what they break: only around
/// them if the piece is refined already, else everywhere. Then the lattice is that of kLatticeSteps. Adds to `work`.
/// Fails as ConstrainedMesh::insert(), with kInput for too many triangles, and as piece.check does.
Result<void> insert_constraints(Piece& piece, const ConstraintGraph& graph, const ConstraintGoals& goals, Work& work);

/// Inserts the samples that break their bound, worst first, and adds to `work`. Fails with kInput for too many
/// triangles and as piece.check does. REQUIRES: the metric is of the piece's samples.
Result<void> refine(Piece& piece, const ErrorMetric& metric, Work& work);

/// The result of a fit.
struct FitOutcome {
  std::uint64_t removed = 0;  ///< vertices
  bool is_cut_short = false;  ///< by the time
};

/// Removes and moves vertices while every sample keeps what refinement aims at. Vertices on shared rows stay. Fails as
/// fit() does.
Result<FitOutcome> fit_piece(Piece& piece, FitOptions options);

inline constexpr const char* kTooManyTriangles =
    "the mesh would have more than 1,431 million triangles: allow a larger error";

/// Bytes a vertex of a piece that constraints and refinement use, its mesh included.
inline constexpr std::uint64_t kRefinementBytesPerVertex = 160;

}  // namespace scarp
