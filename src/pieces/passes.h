// The passes that turn a piece's samples into a mesh that satisfies the bound with few vertices:
//
//     seed → insert constraints → refine → fit
//
// Each pass prepares the piece for the next one. The recipe of a run decides which passes run, and with which goals.
#pragma once

#include <cstdint>

#include "fit/fit.h"
#include "lines/constraints.h"
#include "metric/error_metric.h"
#include "pieces/piece.h"
#include "scarp/result.h"
#include "scarp/run.h"

namespace scarp::pieces {

/// Seeds the mesh of a piece with neighbours: its domain, with only the outline's vertices. Without surface cells, all
/// triangles are outside. Edges along shared rows are not constrained, since the domain ends there only if the
/// neighbour has no surface.
Result<void> seed(Piece& piece);

/// How constraints are inserted.
struct ConstraintGoals {
  double threshold = 0;          ///< threshold of errors, if the piece has no aims
  bool releases_starts = false;  ///< releases edges that serve only as a start, with their vertices, at the end
  int threads = 1;
};

/// Inserts the edges of the graph, in the piece's coordinates, as chains of constrained edges. Then refines the
/// triangles that break the bound: around the edges if the piece is already refined, else everywhere. Afterwards, the
/// lattice has kLatticeSteps. Adds to `work`. Fails if ConstrainedMesh::insert() or piece.check fails, and with kInput
/// for too many triangles.
Result<void> insert_constraints(Piece& piece, const lines::ConstraintGraph& graph, const ConstraintGoals& goals,
                                Work& work);

/// Inserts the samples that break their bound, worst first, and adds to `work`. Fails with kInput for too many
/// triangles, and if piece.check fails. REQUIRES: `metric` measures the piece's samples.
Result<void> refine(Piece& piece, const metric::ErrorMetric& metric, Work& work);

/// The result of a fit.
struct FitOutcome {
  std::uint64_t removed = 0;  ///< vertices
  bool is_cut_short = false;  ///< the time limit ended it
};

/// Removes and moves vertices while every sample satisfies the aim of refinement. Vertices on shared rows are fixed.
/// Fails if fit() fails.
Result<FitOutcome> fit_piece(Piece& piece, fit::FitOptions options);

inline constexpr const char* kTooManyTriangles =
    "the mesh would have more than 1,431 million triangles: allow a larger error";

/// Bytes per vertex for constraints and refinement of a piece, including its mesh.
inline constexpr std::uint64_t kRefinementBytesPerVertex = 160;

}  // namespace scarp::pieces
