#include "pieces/passes.h"

#include <utility>

#include "base/reporter.h"
#include "metric/lattice_metric.h"
#include "refine/domain.h"
#include "refine/refinement.h"

namespace scarp::pieces {

namespace {

Result<void> insert_until_done(Piece& piece, const metric::ErrorMetric& metric, refine::Refinement& refinement,
                               Work& work) {
  const double first_error = refinement.worst_error();
  for (std::uint64_t step = 0; !refinement.done(); ++step) {
    if (refinement.is_full()) return fail(ErrorKind::kInput, kTooManyTriangles);
    if (step % 256 == 0 && piece.check) {
      const double error = refinement.worst_error();
      const double share = error_progress(first_error, error, metric.goal());
      SCARP_RETURN_IF_ERROR(piece.check(piece.tin.vertex_count(), share, error));
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
  if (auto domain = refine::build_domain(piece.samples, 0, Frame{})) {
    piece.tin = std::move(domain->tin);
  } else if (domain.error().kind == ErrorKind::kInput) {  // no cell is surface
    for (tin::Triangle t = 0; t < piece.tin.triangle_count(); ++t) piece.tin.set_outside(t, true);
  } else {
    return tl::unexpected(domain.error());
  }
  for (tin::HalfEdge h = 0; h < 3 * piece.tin.triangle_count(); ++h) {
    if (piece.tin.twin(h) == tin::kNone) piece.tin.release(h);
  }
  return {};
}

Result<void> insert_constraints(Piece& piece, const lines::ConstraintGraph& graph, const ConstraintGoals& goals,
                                Work& work) {
  SCARP_TRY(auto&& inserted, lines::ConstrainedMesh::insert(piece.samples, piece.tin, graph));
  piece.has_surface = inserted.has_surface();
  const metric::LatticeMetric metric(piece.samples, inserted.heights(), goals.threshold, piece.aims);
  refine::Refinement refinement(
      metric, piece.tin, Algorithm::kHeap, {},
      piece.is_refined ? refine::Refinement::Start::kClean : refine::Refinement::Start::kScan);
  // Refined triangles that no line touches satisfy the bound.
  if (piece.is_refined) refinement.scan(inserted.changed(), goals.threads);
  SCARP_RETURN_IF_ERROR(insert_until_done(piece, metric, refinement, work));
  if (goals.releases_starts) inserted.release_starts(piece.tin);
  piece.lattice = inserted.lattice(goals.threads);
  return {};
}

Result<void> refine(Piece& piece, const metric::ErrorMetric& metric, Work& work) {
  refine::Refinement refinement(metric, piece.tin);
  return insert_until_done(piece, metric, refinement, work);
}

Result<FitOutcome> fit_piece(Piece& piece, fit::FitOptions options) {
  options.free_sides.top = options.free_sides.top && !piece.has_above;
  options.free_sides.bottom = options.free_sides.bottom && !piece.has_below;
  options.bounds = piece.aims;
  SCARP_TRY(auto&& fitted, fit::fit(piece.samples, std::move(piece.tin), std::move(piece.lattice), options));
  piece.tin = std::move(fitted.tin);
  piece.lattice = std::move(fitted.lattice);
  return FitOutcome{fitted.counts.removed, fitted.is_cut_short};
}

}  // namespace scarp::pieces
