// Progress of a pass, reported to a callback.
#pragma once

#include <cstdint>
#include <string_view>

#include "base/clock.h"
#include "scarp/run.h"

namespace scarp {

/// The finished share of the work when the error has fallen from `first` to `now`. The error is roughly inversely
/// proportional to the square root of the vertices, so the share is a ratio of squares. 0 for a goal of 0.
double error_progress(double first, double now, double goal);

/// Reports progress at most ten times a second. report() returns false once the callback has asked to stop.
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

/// A callback for a part of the work of `whole`, which starts at `begin` and is `share` of the work. Borrows `whole`;
/// empty if `whole` is empty.
ProgressCallback part_of(const ProgressCallback& whole, double begin, double share);

}  // namespace scarp
