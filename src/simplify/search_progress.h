// The progress and work of all runs of a search, reported as one pass.
#pragma once

#include <string_view>

#include "base/reporter.h"
#include "scarp/run.h"
#include "scarp/simplify.h"

namespace scarp::run {

/// Reports the whole search as one pass. Each stage has a share of the remaining progress.
class SearchProgress {
 public:
  explicit SearchProgress(const ProgressCallback& callback) : callback_(callback), reporter_(callback) {}

  /// Begins a stage. False: cancelled.
  bool begin(double share) {
    begin_ = end_;
    end_ = begin_ + share * (1 - begin_);
    return reporter_.report("search", begin_, 0, 0);
  }
  ProgressCallback of_run(bool has_fit) {
    if (!callback_) return {};
    return [this, has_fit](const Progress& progress) {
      return reporter_.report("search", begin_ + share_of(progress, has_fit) * (end_ - begin_), progress.vertices,
                              progress.max_error);
    };
  }

 private:
  static double share_of(const Progress& progress, bool has_fit) {
    constexpr double kRefine = 0.1;
    if (progress.pass == "search") return progress.fraction;
    if (progress.pass == "refine") return has_fit ? kRefine * progress.fraction : progress.fraction;
    return progress.pass == "fit" ? kRefine + (1 - kRefine) * progress.fraction : 1;
  }

  const ProgressCallback& callback_;
  Reporter reporter_;
  double begin_ = 0, end_ = 0;
};

}  // namespace scarp::run
