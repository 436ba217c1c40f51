// Goals, budgets and progress of a run: what rasters and scattered points have in common.
#pragma once

#include <chrono>
#include <cstdint>
#include <optional>
#include <string>
#include <string_view>

#include "refine/memory_budget.h"
#include "scarp/progress.h"
#include "scarp/result.h"
#include "scarp/simplify.h"

namespace scarp {

using Clock = std::chrono::steady_clock;

inline double seconds_since(Clock::time_point start) {
  return std::chrono::duration<double>(Clock::now() - start).count();
}

/// Fails unless there is a goal (tolerances count where they are allowed) and max_error is a number of at least 0.
Result<void> check_goals(const SimplifyOptions& options, bool may_have_tolerance);

/// Bytes a vertex: what a run takes most of, in the proof, while the mesh is written, or where it is fitted as a whole.
MemoryBudget memory_budget(const HeightField& field, const SimplifyOptions& options);

struct MeshSize {
  std::uint64_t vertices = 0, triangles = 0;
};

/// The budgets of the options, which stay alive.
class Budget {
 public:
  explicit Budget(const SimplifyOptions& options) : options_(options) {}

  /// Fails if not even the smallest mesh fits: "N vertices are too few: CULPRIT M; allow moreADVICE".
  Result<void> check(const MeshSize& least, const std::string& culprit, const std::string& advice) const;
  /// The budget that one more vertex with `gain` more triangles would break.
  std::optional<StopReason> exceeded(const MeshSize& size, std::uint32_t gain) const;
  /// The last 5 % of what is allowed: where the best prefix is looked for.
  bool in_last_stretch(const MeshSize& size) const;
  /// The larger share of what is allowed; 0 without budgets.
  double used(const MeshSize& size) const;

 private:
  const SimplifyOptions& options_;
};

/// How much of the work is done when the error has come from `first` to `now`. The error falls about as the square root
/// of the vertices grows, so work done is a ratio of squares. 0 for a goal of 0.
double error_progress(double first, double now, double goal);

/// Reports progress at most ten times a second; false once the callback has said so.
class Reporter {
 public:
  explicit Reporter(const ProgressCallback& callback) : callback_(callback) {}
  bool due() const { return callback_ && seconds_since(last_) > 0.1; }
  bool report(std::string_view pass, double fraction, std::uint64_t vertices, double error);

 private:
  const ProgressCallback& callback_;
  Clock::time_point last_ = Clock::now();
  double fraction_ = 0;
};

/// A mesh on the way, as the number of vertices that the triangulation then had.
struct Prefix {
  std::size_t vertices = 0;
  double error = 0;
};

}  // namespace scarp
