// Heights by pixel, and how light falls on them.
#pragma once

#include <cstddef>
#include <vector>

#include "draw/canvas.h"
#include "scarp/frame.h"

namespace scarp::draw {

/// Heights by pixel, NaN = nodata.
struct Relief {
  int width = 0, height = 0;
  std::vector<double> z;
  double at(int x, int y) const {
    return z[static_cast<std::size_t>(y) * static_cast<std::size_t>(width) + static_cast<std::size_t>(x)];
  }
};

/// Hillshade by pixel, tinted by height, white where nodata. The relief shows all of a grid of cols × rows samples in
/// `frame`, whose cells make slopes true.
std::vector<Colour> shade(const Relief& relief, const Frame& frame, int cols, int rows);

}  // namespace scarp::draw
