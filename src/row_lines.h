// Lines where rows of tiles are finished one after the other.
//
//     row above, done ──────┬───────    a line is cut at the shared row of samples: the vertex there is the line's
//     row at hand       line│           alone, so both rows know it. Where it leaves a chord of the shared border,
//     ──────────────────────┴───────    samples on that split it, by the border's own rule; neither row adds more.
//     rows below, not read yet
#pragma once

#include <cstdint>
#include <functional>
#include <span>
#include <vector>

#include "refine/constraints.h"
#include "refine/tiled.h"
#include "row_cut.h"
#include "scarp/result.h"
#include "scarp/strategy.h"

namespace scarp {

class RowLines {
 public:
  /// `graph`: of the whole raster, its edges cut at the shared rows. Stays alive.
  explicit RowLines(const ConstraintGraph& graph);

  /// The row's mesh with its part of the lines as chains of constrained edges, at kLatticeSteps; samples that they put
  /// beyond `threshold` are inserted around them. Vertices on rows that are shared are the same for both that share
  /// them. Fails as ConstrainedMesh::lay(), with kInput for too many triangles and with kCancelled where `goes_on` says
  /// no; with kInput after the last row if a cut has left nothing of any. REQUIRES: each sample lies within the
  /// threshold of the row's mesh.
  Result<FinishedRow> lay(TileRow row, double threshold, const std::function<bool(std::uint64_t vertices)>& goes_on);

  const Work& work() const { return work_; }

 private:
  ConstraintGraph part_of(const TileRow& row, double threshold) const;
  void split_shared(const TileRow& row, bool is_top, double threshold, ConstraintGraph& part) const;

  const ConstraintGraph& graph_;
  std::vector<std::uint32_t> points_;  // of the graph, from the top down
  std::vector<std::uint32_t> edges_;   // by their upper ends
  RowCut cut_;
  bool has_surface_ = false;  // any row so far, behind the cut
  Work work_;
};

/// Bytes a vertex of a row that lay() takes beside its mesh.
inline constexpr std::uint64_t kRowLineBytesPerVertex = 160;

}  // namespace scarp
