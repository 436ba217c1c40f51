#include "base/reporter.h"

#include <algorithm>

namespace scarp {

double error_progress(double first, double now, double goal) {
  return goal > 0 && first > goal ? goal * goal / (now * now) : 0;
}

bool Reporter::report(std::string_view pass, double fraction, std::uint64_t vertices, double error) {
  last_ = Clock::now();
  fraction_ = std::max(fraction_, std::min(fraction, 1.0));
  return !callback_ || callback_({pass, fraction_, vertices, error});
}

ProgressCallback part_of(const ProgressCallback& whole, double begin, double share) {
  if (!whole) return {};
  return [&whole, begin, share](Progress progress) {
    progress.fraction = std::min(1.0, begin + share * progress.fraction);
    return whole(progress);
  };
}

}  // namespace scarp
