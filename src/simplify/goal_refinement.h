// Refinement of one piece until a goal is reached: inserts the seeds, the samples that importance selects, and those
// that a proof names.
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

namespace scarp::run {

/// Owns the piece, which covers the raster, and during insertion the errors of its samples.
class GoalRefinement {
 public:
  /// `border`: the vertices of a locked border (locked_border.h); EMPTY: none. All arguments must outlive this object.
  GoalRefinement(const pieces::Recipe& recipe, const grid::Raster& raster, const metric::Criterion& criterion,
                 std::span<const Point> border, Reporter& reporter);

  /// Makes the piece from the domain and its seeds: the border and the points of the features. Fails like
  /// build_domain().
  Result<void> start(Simplified& result);
  /// Makes the piece from an existing mesh of the domain.
  void start_with(refine::DomainMesh domain);
  /// Inserts samples from the seeds on, by the strategy. Fails if even the seeds exceed a budget, if there are too many
  /// triangles (kInput) or too little memory, and if cancelled (kCancelled).
  Result<void> run(Simplified& result);
  /// Inserts the samples that a mesh of other passes lacks, worst first. Fails like run().
  Result<void> run_on(Simplified& result);
  /// Inserts the samples that break the bound according to the judge, within the budgets, and continues refinement.
  /// Returns false if that cannot help. Fails like run().
  Result<bool> mend(std::vector<Offender> offenders, Simplified& result);

  /// Releases the data of the samples, so that other passes may change the piece.
  void forget() { refinement_.reset(); }
  /// Also releases the piece.
  void release();
  bool has_piece() const { return piece_.has_value(); }
  pieces::Piece& piece() { return *piece_; }
  const pieces::Piece& piece() const { return *piece_; }

  /// True if every sample of the rectangle is a height.
  bool is_whole() const { return is_whole_; }
  /// Number of corners of the rectangle that are not vertices of the domain.
  std::uint32_t unused() const { return unused_; }
  std::uint64_t vertices() const { return piece_->tin.vertex_count() - unused_; }
  /// Proves that no pass has changed a locked border.
  Result<void> check_border() const;

 private:
  void take(refine::DomainMesh domain);
  void note_sides();
  /// Inserts the points of the features, except those outside the domain.
  void insert_points();
  void insert_seed(Point p);
  pieces::MeshSize size() const { return {vertices(), refinement_->triangle_count()}; }
  std::optional<StopReason> exceeded(std::uint32_t gain) const { return budget_.exceeded(size(), gain); }
  std::optional<StopReason> reached() const;
  /// Refines in steps of one or more insertions, with a check of goals, progress and the best prefix after each.
  Result<void> refine(StopReason& stop);
  /// Returns the budget that stopped the step. REQUIRES: !reached().
  std::optional<StopReason> take_step();
  std::optional<StopReason> insert_batch();
  std::optional<StopReason> insert_ranked();
  double fraction(double first_error) const;
  /// True while the best prefix is searched for.
  bool in_last_stretch() const;
  /// The max error is not monotone, so a budget may stop insertion at a peak. GoalRefinement is deterministic, so
  /// inserting the first points again restores an earlier mesh without reading a sample.
  void take_best_prefix();
  void finish_edges(Simplified& result);

  const pieces::Recipe& recipe_;
  const grid::Raster& raster_;
  const metric::Request& options_;
  const metric::Criterion& criterion_;
  std::span<const Point> border_;
  Reporter& reporter_;
  pieces::Budget budget_;
  std::vector<Point> on_sides_;  // vertices of a locked border when refinement begins
  std::optional<pieces::Piece> piece_;
  bool is_whole_ = true;
  std::uint32_t unused_ = 0;
  std::size_t seeds_ = 0;
  std::optional<refine::Refinement> refinement_;
  std::optional<std::vector<Point>> ranking_;
  std::size_t ranked_ = 0;
  pieces::Prefix best_{0, std::numeric_limits<double>::infinity()};
};

}  // namespace scarp::run
