#include "pieces/row_refinement.h"

#include <utility>

#include "refine/domain.h"

namespace scarp {

Result<void> start_row(TileRow& row) {
  if (auto domain = build_domain(row.samples, 0, Frame{})) {
    row.tin = std::move(domain->tin);
  } else if (domain.error().kind == ErrorKind::kInput) {  // no cell is surface
    for (Triangle t = 0; t < row.tin.triangle_count(); ++t) row.tin.set_outside(t, true);
  } else {
    return tl::unexpected(domain.error());
  }
  for (HalfEdge h = 0; h < 3 * row.tin.triangle_count(); ++h) {
    if (row.tin.twin(h) == kNone) row.tin.release(h);
  }
  return {};
}

Result<void> refine_row(const TileRow& row, Refinement& refinement, Work& work) {
  for (std::uint64_t step = 0; !refinement.done(); ++step) {
    if (refinement.is_full())
      return fail(ErrorKind::kInput, "the mesh would have more than 1,431 million triangles: allow a larger error");
    if (step % 256 == 0) {
      if (auto fits = row.check(row.tin.vertex_count()); !fits) return fits;
    }
    refinement.insert_worst();
  }
  const Work done = refinement.work();
  work.samples_scanned += done.samples_scanned;
  work.triangles_scanned += done.triangles_scanned;
  work.passes += done.passes;
  return {};
}

}  // namespace scarp
