// The points of blocks that a run uses, and the proof at all others.
#pragma once

#include <cstddef>
#include <cstdint>
#include <functional>
#include <optional>
#include <span>
#include <utility>
#include <vector>

#include "grid/snapped_points.h"
#include "scarp/mesh.h"
#include "scarp/point_blocks.h"
#include "scarp/points.h"
#include "scarp/result.h"
#include "simplify/wider_proof.h"

namespace scarp::run {

class WorkingSet final : public WiderProof {
 public:
  /// Both arguments must outlive this.
  WorkingSet(const PointBlocks& blocks, const PointOptions& options);

  /// Finds the extent. Afterwards, the set has the points with the least and largest coordinates and heights.
  Result<void> find_extent();
  /// Finds the lattice. Afterwards, the set has every k-th point and the corners of the hull.
  Result<void> start(grid::PointSteps steps);
  /// Adds the highest and the lowest of k neighbours above a mesh.
  Result<void> add_extremes(const Mesh& mesh);
  std::uint64_t total() const override { return blocks_.size(); }
  Result<bool> judge(const Mesh& mesh, double bound, Measurement& result) override;
  Result<void> check_memory(std::uint64_t vertices) const override;
  /// True if points have joined the set since the last call.
  bool take_growth() { return std::exchange(has_grown_, false); }

  const PointSet& points() const { return points_; }
  const grid::SnappedPoints& snapped() const { return snapped_; }
  /// Heights of points as vertices.
  const std::vector<double>& heights() const { return heights_; }
  PointSet take_points() { return std::move(points_); }

 private:
  Result<void> visit(const std::function<Result<void>(const PointSet&)>& visit) const;
  Result<void> snap();
  void add(const PointSet& block, std::size_t point);
  double coverage_tolerance() const;
  std::size_t group_size() const;  // k

  const PointBlocks& blocks_;
  const PointOptions& options_;
  bool has_grown_ = false;
  grid::LatticeFinder finder_;
  std::optional<grid::FoundLattice> lattice_;
  PointSet points_;
  grid::SnappedPoints snapped_;
  std::vector<double> heights_;
};

}  // namespace scarp::run
