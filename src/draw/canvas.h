// Colours and lines on a Picture.
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <vector>

#include "scarp/io.h"

namespace scarp::draw {

/// Red, green, blue, 0 … 255.
using Colour = std::array<double, 3>;

/// The colour at `t` (0 … 1, clamped) of a ramp with equally spaced stops.
template <std::size_t N>
Colour ramp(const std::array<Colour, N>& stops, double t) {
  const double at = (t > 0 ? (t < 1 ? t : 1) : 0) * (N - 1);
  const auto i = at < N - 2 ? static_cast<std::size_t>(at) : N - 2;
  Colour out{};
  for (std::size_t k = 0; k < 3; ++k)
    out[k] = stops[i][k] + (at - static_cast<double>(i)) * (stops[i + 1][k] - stops[i][k]);
  return out;
}

Picture blank(int width, int height);
void set_pixel(Picture& picture, int x, int y, const Colour& colour);

/// The cover of each pixel by lines, 0 … 1. Each pixel stores its darkest line, so drawing a line twice changes
/// nothing.
class LineLayer {
 public:
  LineLayer(int width, int height)
      : width_(width), height_(height), cover_(static_cast<std::size_t>(width) * static_cast<std::size_t>(height)) {}
  /// Adds an anti-aliased line of the given width and darkness (0 … 1). Coordinates are in pixels; (0, 0) is the first
  /// pixel's centre.
  void add_line(double x0, double y0, double x1, double y1, double line_width, double darkness);
  void blend_into(Picture& picture, const Colour& ink) const;

 private:
  int width_, height_;
  std::vector<float> cover_;
};

}  // namespace scarp::draw
