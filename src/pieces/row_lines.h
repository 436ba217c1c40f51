// Lines where rows of tiles are finished one after the other.
//
//     row above, done ──────┬───────    a line is cut at the shared row of samples: the vertex there is the line's
//     row at hand       line│           alone, so both rows know it. Where it leaves a chord of the shared border,
//     ──────────────────────┴───────    samples on that split it, by the border's own rule; neither row adds more.
//     rows below, not read yet
//
// Lines that are laid before the surface is refined, walls and ridges, would come too late behind tiles. Rows that such
// a graph touches are made whole: lines first, then refinement of the row as one. A border that lines meet has then no
// vertices of tiles, only those of lines and what these leave to be split; both its rows are made whole, and know that.
#pragma once

#include <cstdint>
#include <span>
#include <vector>

#include "lines/constraints.h"
#include "pieces/border_chain.h"
#include "pieces/row_bounds.h"
#include "pieces/row_cut.h"
#include "pieces/tiled.h"
#include "scarp/result.h"
#include "scarp/strategy.h"

namespace scarp {

class RowLines {
 public:
  /// `graph`: of the whole raster, its edges cut at the shared rows of tiles of `side`. Stays alive. `releases_starts`:
  /// edges that are but a start are given free when they have been laid, with their vertices; on shared rows fitting
  /// leaves these all the same.
  RowLines(const ConstraintGraph& graph, std::int32_t side, bool releases_starts);

  /// Of rows of samples: lines are laid there before the surface is refined.
  bool makes_whole(std::int32_t first, std::int32_t rows) const;
  /// The row's mesh with its part of the lines as chains of constrained edges, at kLatticeSteps; samples that they put
  /// beyond their bounds are inserted around them. Vertices on rows that are shared are the same for both that share
  /// them. Fails as ConstrainedMesh::lay(), with kInput for too many triangles and as row.check does; with kInput
  /// after the last row if a cut has left nothing of any. `bounds`: of the row's samples, none above the threshold,
  /// and none afterwards for those on shared rows, whose edges are for good then; empty: it holds for all. REQUIRES:
  /// each sample lies within the threshold of the row's mesh, or the row is to be made whole.
  Result<FinishedRow> lay(TileRow row, double threshold, std::span<float> bounds = {});

  const Work& work() const { return work_; }

 private:
  bool has_points(std::int32_t top, std::int32_t bottom) const;
  ConstraintGraph part_of(const TileRow& row) const;
  /// What is asked of a row.
  struct Bounds {
    double threshold = 0;
    std::span<float> own;  // by sample; empty: the threshold holds for all
    LineBound of(const TileRow& row, std::int32_t y) const {
      return own.empty() ? LineBound(threshold) : LineBound(along(own, row, y));
    }
  };
  void split_shared(const TileRow& row, bool is_top, const Bounds& bounds, ConstraintGraph& part) const;
  Result<void> start(TileRow& row, const Bounds& bounds, ConstraintGraph& part) const;
  Result<void> start_border(const TileRow& row, bool is_top, const Bounds& bounds, ConstraintGraph& part) const;

  const ConstraintGraph& graph_;
  std::int32_t side_;
  bool releases_starts_;
  std::vector<std::uint32_t> points_;  // of the graph, from the top down
  std::vector<std::uint32_t> edges_;   // by their upper ends
  RowCut cut_;
  bool has_surface_ = false;  // any row so far, behind the cut
  Work work_;
};

}  // namespace scarp
