// CPU time that a process has used so far.
#pragma once

#include <ctime>

namespace scarp {

/// CPU time of the process, all of its threads.
inline double core_seconds() {
  timespec now{};
  clock_gettime(CLOCK_PROCESS_CPUTIME_ID, &now);
  return static_cast<double>(now.tv_sec) + 1e-9 * static_cast<double>(now.tv_nsec);
}

}  // namespace scarp
