#pragma once

#include <optional>

namespace scarp::cli {

/// Seconds left for a pass that has run for `seconds`; nothing before an estimate is possible.
inline std::optional<double> find_seconds_left(double seconds, double fraction) {
  if (!(fraction > 0.01) || !(seconds > 0.5)) return {};
  return seconds * (1 - fraction) / fraction;
}

}  // namespace scarp::cli
