// Hillshade.
//
// Light comes from the picture's upper left (azimuth 315°, altitude 45°) for any orientation of the raster, since hills
// lit from below appear as holes. Slopes are true to the frame's cell size, then exaggerated until a steep place
// (steeper than 80 % of the samples) is clearly lit. So rasters in degrees and other arbitrary units can also be drawn.
#include "draw/relief.h"

#include <algorithm>
#include <cmath>

#include "draw/grid_positions.h"

namespace scarp::draw {
namespace {

/// From deep to shallow.
constexpr std::array<Colour, 3> kSeaTints{Colour{72, 110, 168}, Colour{126, 166, 206}, Colour{190, 217, 234}};
constexpr std::array<Colour, 4> kTints{Colour{176, 201, 170}, Colour{226, 222, 178}, Colour{222, 190, 148},
                                       Colour{232, 216, 206}};

/// Rise per ground unit to the right and upwards; central differences, one-sided next to nodata and borders.
std::vector<std::array<double, 2>> find_slopes(const Relief& relief, double step_x, double step_y) {
  std::vector<std::array<double, 2>> slopes(relief.z.size());
  const auto valid = [&](int x, int y) {
    return x >= 0 && y >= 0 && x < relief.width && y < relief.height && !std::isnan(relief.at(x, y));
  };
  const auto rise = [&](int x, int y, int dx, int dy) {
    const int x0 = valid(x - dx, y - dy) ? x - dx : x, y0 = valid(x - dx, y - dy) ? y - dy : y;
    const int x1 = valid(x + dx, y + dy) ? x + dx : x, y1 = valid(x + dx, y + dy) ? y + dy : y;
    const int steps = (x1 - x0) + (y1 - y0);
    return steps == 0 ? 0.0 : (relief.at(x1, y1) - relief.at(x0, y0)) / steps;
  };
  for (int y = 0; y < relief.height; ++y) {
    for (int x = 0; x < relief.width; ++x) {
      if (!valid(x, y)) continue;
      slopes[static_cast<std::size_t>(y) * static_cast<std::size_t>(relief.width) + static_cast<std::size_t>(x)] = {
          rise(x, y, 1, 0) / step_x, -rise(x, y, 0, 1) / step_y};
    }
  }
  return slopes;
}

double choose_exaggeration(const Relief& relief, const std::vector<std::array<double, 2>>& slopes, bool is_metric) {
  std::vector<double> steepness;
  for (std::size_t i = 0; i < slopes.size(); ++i) {
    if (!std::isnan(relief.z[i])) steepness.push_back(std::hypot(slopes[i][0], slopes[i][1]));
  }
  if (steepness.empty()) return 1;
  const auto rank = steepness.begin() + static_cast<std::ptrdiff_t>(steepness.size() * 4 / 5);
  std::nth_element(steepness.begin(), rank, steepness.end());
  if (!(*rank > 0) || !std::isfinite(*rank)) return 1;
  const double wanted = 0.7 / *rank;
  return is_metric ? std::clamp(wanted, 0.5, 10.0) : wanted;
}

std::vector<Colour> paint(const Relief& relief, const std::vector<std::array<double, 2>>& slopes, double exaggeration,
                          const Tints& tints) {
  std::vector<Colour> colours(relief.z.size(), Colour{255, 255, 255});
  for (std::size_t i = 0; i < colours.size(); ++i) {
    if (std::isnan(relief.z[i])) continue;
    const double gx = slopes[i][0] * exaggeration, gy = slopes[i][1] * exaggeration;
    const double light = std::max(0.0, (0.5 * gx - 0.5 * gy + std::sqrt(0.5)) / std::sqrt(1 + gx * gx + gy * gy));
    const Colour tint = tints.at(relief.z[i]);
    for (std::size_t k = 0; k < 3; ++k) colours[i][k] = std::min(250.0, tint[k] * (0.3 + 0.95 * light));
  }
  return colours;
}

Tints find_tints(const Relief& relief, bool has_sea) {
  Tints tints{HUGE_VAL, -HUGE_VAL, has_sea};
  for (const double z : relief.z) {
    if (std::isnan(z)) continue;
    tints.lowest = std::min(tints.lowest, z);
    tints.highest = std::max(tints.highest, z);
  }
  return tints;
}

}  // namespace

Colour Tints::at(double z) const {
  if (has_sea && z < 0) {
    // A shore slightly below zero is not drawn as deep sea.
    const double deepest = std::max(-lowest, highest / 10);
    return ramp(kSeaTints, 1 + z / deepest);
  }
  const double foot = has_sea && lowest < 0 ? 0 : lowest;
  return ramp(kTints, highest > foot ? (z - foot) / (highest - foot) : 0);
}

Ground ground_of(const Frame& frame, int cols, int rows) {
  Ground ground;
  const auto steps = step_lengths(frame, cols, rows);
  ground.step_x = steps[0];
  ground.step_y = steps[1];
  if (!(ground.step_x > 0) || !std::isfinite(ground.step_x) || !(ground.step_y > 0) || !std::isfinite(ground.step_y))
    ground.step_x = ground.step_y = 1;
  ground.is_metric = frame.kind == Frame::Kind::kLocal || frame.kind == Frame::Kind::kProjected;
  ground.has_sea = frame.kind != Frame::Kind::kGrid;
  return ground;
}

Shaded shade(const Relief& relief, const Ground& ground, int cols, int rows) {
  const auto slopes = find_slopes(relief, ground.step_x * cols / relief.width, ground.step_y * rows / relief.height);
  const Tints tints = find_tints(relief, ground.has_sea);
  return {paint(relief, slopes, choose_exaggeration(relief, slopes, ground.is_metric), tints), tints};
}

}  // namespace scarp::draw
