// The goals of a mesh.
#pragma once

#include <cstdint>
#include <optional>

#pragma GCC visibility push(default)

namespace scarp {

/// The quantity that a budget minimises.
enum class Objective {
  kMax,  ///< the max error
  kRms,  ///< the root of the mean square error (with channels: of the norm, as the max error is), while the max error
         ///< stays within max_error or, without one, within what fast effort reaches. With a budget and more than fast
         ///< effort only; see simplify().
};

/// How a sample's errors in heights and channels are combined into one.
enum class Norm {
  kSum,      ///< L1
  kSquares,  ///< L2
  kMax,      ///< L∞
};

/// At least one goal; the first that is reached ends the run.
struct Goals {
  /// Vertical error bound in z units, at least 0: |mesh − sample| <= max_error at every valid sample. 0 reproduces
  /// every sample. DEFAULT: none.
  std::optional<double> max_error = std::nullopt;
  /// Upper bounds. If one of them ends the run, the result is the mesh with the smallest max error among those with at
  /// least 95 % of the budget (max error is not monotone in the number of points); with more than fast effort what the
  /// search for an error has found (see "Budgets" at simplify()). DEFAULT: none.
  std::optional<std::uint64_t> max_triangles = std::nullopt;
  std::optional<std::uint64_t> max_vertices = std::nullopt;
  /// kRms fails with kUsage without a budget. DEFAULT: kMax.
  Objective objective = Objective::kMax;
  /// Over heights and channels, where the field has channels. DEFAULT: L1, as in the 1995 paper.
  Norm norm = Norm::kSum;
};

/// The goal that ended the run.
enum class StopReason { kMaxError, kMaxTriangles, kMaxVertices, kExact };

}  // namespace scarp

#pragma GCC visibility pop
