#include "grid/line_positions.h"

#include <fmt/format.h>

#include "grid/affine_map.h"

namespace scarp::grid {

Result<void> check_line_positions(const std::string& name, std::span<const std::array<double, 3>> points,
                                  const std::array<double, 6>& affine) {
  const MapToSamples to_samples(affine);
  for (const auto& point : points) {
    if (can_be_placed(to_samples.position(point[0], point[1]))) continue;
    return fail(ErrorKind::kInput,
                fmt::format("{} has a vertex at {:.9g}, {:.9g}, too far away to be placed", name, point[0], point[1]));
  }
  return {};
}

}  // namespace scarp::grid
