#pragma once

#include <optional>

namespace scarp::cli {

/// Seconds that are left of a pass which has run for `seconds`; none before it can be estimated.
inline std::optional<double> find_seconds_left(double seconds, double fraction) {
  if (!(fraction > 0.01) || !(seconds > 0.5)) return {};
  return seconds * (1 - fraction) / fraction;
}

}  // namespace scarp::cli
