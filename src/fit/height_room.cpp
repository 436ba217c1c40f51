#include "fit/height_room.h"

#include <algorithm>

namespace scarp::fit {

std::optional<double> rise_in(const TriangleError::Room& room, double wish, double scale) {
  constexpr double kMargin = 1e-4;
  if (!room.is_open()) return std::nullopt;
  const double lowest = room.lowest, highest = room.highest;
  const double margin = std::min(kMargin * scale, 0.5 * (highest - lowest));
  return std::clamp(wish, lowest + margin, highest - margin);
}

}  // namespace scarp::fit
