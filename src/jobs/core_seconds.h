// CPU time used so far by all threads of the process.
#pragma once

#include <ctime>

namespace scarp::jobs {

inline double core_seconds() {
  timespec now{};
  clock_gettime(CLOCK_PROCESS_CPUTIME_ID, &now);
  return static_cast<double>(now.tv_sec) + 1e-9 * static_cast<double>(now.tv_nsec);
}

}  // namespace scarp::jobs
