#include "pieces/passes.h"

#include <utility>

#include "base/reporter.h"
#include "metric/lattice_judge.h"
#include "refine/domain.h"
#include "refine/refinement.h"

namespace scarp {

namespace {

Result<void> insert_until_done(Piece& piece, const Judge& judge, Refinement& refinement, Work& work) {
  const double first_error = refinement.worst_error();
  for (std::uint64_t step = 0; !refinement.done(); ++step) {
    if (refinement.is_full()) return fail(ErrorKind::kInput, kTooManyTriangles);
    if (step % 256 == 0 && piece.check) {
      const double error = refinement.worst_error();
      const double share = error_progress(first_error, error, judge.goal());
      if (auto fits = piece.check(piece.tin.vertex_count(), share, error); !fits) return fits;
    }
    refinement.insert_worst();
  }
  const Work done = refinement.work();
  work.samples_scanned += done.samples_scanned;
  work.triangles_scanned += done.triangles_scanned;
  work.passes += done.passes;
  piece.is_refined = true;
  return {};
}

}  // namespace

Result<void> seed(Piece& piece) {
  piece.is_refined = false;
  if (auto domain = build_domain(piece.samples, 0, Frame{})) {
    piece.tin = std::move(domain->tin);
  } else if (domain.error().kind == ErrorKind::kInput) {  // no cell is surface
    for (Triangle t = 0; t < piece.tin.triangle_count(); ++t) piece.tin.set_outside(t, true);
  } else {
    return tl::unexpected(domain.error());
  }
  for (HalfEdge h = 0; h < 3 * piece.tin.triangle_count(); ++h) {
    if (piece.tin.twin(h) == kNone) piece.tin.release(h);
  }
  return {};
}

Result<void> insert_constraints(Piece& piece, const ConstraintGraph& graph, const ConstraintGoals& goals, Work& work) {
  auto laid = ConstrainedMesh::lay(piece.samples, piece.tin, graph);
  if (!laid) return tl::unexpected(laid.error());
  piece.has_surface = laid->has_surface();
  const LatticeJudge judge(piece.samples, laid->heights(), goals.threshold, piece.aims);
  Refinement refinement(judge, piece.tin, Algorithm::kHeap, {},
                        piece.is_refined ? Refinement::Start::kClean : Refinement::Start::kScan);
  // What refinement left and no line touches keeps the bound.
  if (piece.is_refined) refinement.scan(laid->changed(), goals.threads);
  if (auto refined = insert_until_done(piece, judge, refinement, work); !refined) return refined;
  if (goals.releases_starts) laid->release_starts(piece.tin);
  piece.places = laid->places(goals.threads);
  return {};
}

Result<void> refine(Piece& piece, const Judge& judge, Work& work) {
  Refinement refinement(judge, piece.tin);
  return insert_until_done(piece, judge, refinement, work);
}

Result<FitOutcome> fit_piece(Piece& piece, FitOptions options) {
  options.free_sides.top = options.free_sides.top && !piece.has_above;
  options.free_sides.bottom = options.free_sides.bottom && !piece.has_below;
  options.bounds = piece.aims;
  auto fitted = fit(piece.samples, std::move(piece.tin), std::move(piece.places), options);
  if (!fitted) return tl::unexpected(fitted.error());
  piece.tin = std::move(fitted->tin);
  piece.places = std::move(fitted->places);
  return FitOutcome{fitted->counts.removed, fitted->is_cut_short};
}

}  // namespace scarp
