// Refinement of one piece until a goal is reached: by the seeds, the samples that importance asks for, and those that a
// proof names.
#pragma once

#include <cstdint>
#include <limits>
#include <optional>
#include <span>
#include <vector>

#include "base/reporter.h"
#include "grid/raster.h"
#include "metric/criterion.h"
#include "pieces/budget.h"
#include "pieces/piece.h"
#include "pieces/recipe.h"
#include "refine/domain.h"
#include "refine/refinement.h"
#include "scarp/measure.h"
#include "scarp/simplify.h"

namespace scarp {

/// Owns the piece, all of the raster, and what is known of its samples while they are inserted.
class GoalRefinement {
 public:
  /// `border`: the vertices of a locked border (locked_border.h); EMPTY: none. All outlive it.
  GoalRefinement(const Recipe& recipe, const Raster& raster, const Criterion& criterion, std::span<const Point> border,
                 Reporter& reporter);

  /// The piece is the domain with its seeds: the border and the points that the features name. Fails as build_domain().
  Result<void> start(Simplified& result);
  /// The piece is a mesh of the domain that others made.
  void start_with(DomainMesh domain);
  /// Inserts from the seeds on, by the strategy. Fails if not even the seeds fit into a budget, with kInput for too
  /// many triangles, with kCancelled, and where the memory is too small.
  Result<void> run(Simplified& result);
  /// Inserts the samples missing from a mesh of other passes, worst first. Fails as run().
  Result<void> run_on(Simplified& result);
  /// Inserts the samples that break the bound in the judge's eyes, as far as the budgets allow, and refines on. Returns
  /// false if that cannot help. Fails as run().
  Result<bool> mend(std::vector<Offender> offenders, Simplified& result);

  /// Gives back what is known of the samples: other passes may change the piece.
  void forget() { refinement_.reset(); }
  /// Gives back the piece too.
  void release();
  bool has_piece() const { return piece_.has_value(); }
  Piece& piece() { return *piece_; }
  const Piece& piece() const { return *piece_; }

  /// Every sample of the rectangle is a height.
  bool is_whole() const { return is_whole_; }
  /// Corners of the rectangle that are no vertex of the domain.
  std::uint32_t unused() const { return unused_; }
  std::uint64_t vertices() const { return piece_->tin.vertex_count() - unused_; }
  /// No pass has a reason to touch a locked border; this is the proof that none did.
  Result<void> check_border() const;

 private:
  void take(DomainMesh domain);
  void note_sides();
  /// Samples outside the domain cannot become vertices.
  void insert_points();
  void insert_seed(Point p);
  MeshSize size() const { return {vertices(), refinement_->triangle_count()}; }
  std::optional<StopReason> exceeded(std::uint32_t gain) const { return budget_.exceeded(size(), gain); }
  std::optional<StopReason> reached() const;
  /// Every way of refinement is steps of one or more insertions, with a check of goals, progress and the best prefix
  /// after each.
  Result<void> refine(StopReason& stop);
  /// Returns the budget that stopped it. REQUIRES: !reached().
  std::optional<StopReason> take_step();
  std::optional<StopReason> insert_batch();
  std::optional<StopReason> insert_ranked();
  double fraction(double first_error) const;
  /// True where the best prefix is searched for.
  bool in_last_stretch() const;
  /// Max error is not monotone: a budget may stop on a spike. GoalRefinement is deterministic, so an earlier mesh is
  /// had by inserting the same points again, without reading a sample.
  void take_best_prefix();
  void finish_edges(Simplified& result);

  const Recipe& recipe_;
  const Raster& raster_;
  const Request& options_;
  const Criterion& criterion_;
  std::span<const Point> border_;
  Reporter& reporter_;
  Budget budget_;
  std::vector<Point> on_sides_;  // there when refinement begins, where a border is locked
  std::optional<Piece> piece_;
  bool is_whole_ = true;
  std::uint32_t unused_ = 0;
  std::size_t seeds_ = 0;
  std::optional<Refinement> refinement_;
  std::optional<std::vector<Point>> ranking_;
  std::size_t ranked_ = 0;
  Prefix best_{0, std::numeric_limits<double>::infinity()};
};

}  // namespace scarp
