// Durations of the program's work.
#pragma once

#include <chrono>

namespace scarp::cli {

using Clock = std::chrono::steady_clock;

inline double seconds_since(Clock::time_point start) {
  return std::chrono::duration<double>(Clock::now() - start).count();
}

}  // namespace scarp::cli
