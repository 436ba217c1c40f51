// Budgets of vertices and triangles, for rasters and scattered points alike.
#pragma once

#include <cstdint>
#include <optional>
#include <string>

#include "scarp/options.h"
#include "scarp/result.h"

namespace scarp::pieces {

struct MeshSize {
  std::uint64_t vertices = 0, triangles = 0;
};

class Budget {
 public:
  Budget(std::optional<std::uint64_t> max_triangles, std::optional<std::uint64_t> max_vertices)
      : max_triangles_(max_triangles), max_vertices_(max_vertices) {}
  explicit Budget(const SimplifyOptions& options) : Budget(options.goals.max_triangles, options.goals.max_vertices) {}

  /// Fails if not even the smallest mesh fits: "N vertices are too few: CULPRIT M; allow moreADVICE".
  Result<void> check(const MeshSize& least, const std::string& culprit, const std::string& advice) const;
  /// The budget, if any, that one more vertex with `gain` more triangles would exceed.
  std::optional<StopReason> exceeded(const MeshSize& size, std::uint32_t gain) const;
  /// True in the last 5 % of the budget, in which the prefix with the smallest error is searched for.
  bool in_last_stretch(const MeshSize& size) const;
  /// The larger used share of the two budgets; 0 without budgets.
  double used(const MeshSize& size) const;
  /// The budget of which more is used.
  StopReason tighter(const MeshSize& size) const;
  /// The largest mesh within the budgets.
  MeshSize most() const;

 private:
  std::optional<std::uint64_t> max_triangles_, max_vertices_;
};

/// An intermediate mesh, identified by its number of vertices.
struct Prefix {
  std::size_t vertices = 0;
  double error = 0;
};

}  // namespace scarp::pieces
