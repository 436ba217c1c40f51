// Heights by pixel, and hillshade.
#pragma once

#include <cstddef>
#include <vector>

#include "draw/canvas.h"
#include "scarp/height_field.h"

namespace scarp::draw {

/// Heights by pixel, NaN = nodata.
struct Relief {
  int width = 0, height = 0;
  std::vector<double> z;
  double at(int x, int y) const {
    return z[static_cast<std::size_t>(y) * static_cast<std::size_t>(width) + static_cast<std::size_t>(x)];
  }
};

/// Colours of heights; blue below sea level, if sea level is known.
struct Tints {
  double lowest = 0, highest = 0;
  bool has_sea = false;
  Colour at(double z) const;
};

/// Scale and reference of a grid of samples.
struct Ground {
  double step_x = 1, step_y = 1;  ///< size of a cell
  bool is_metric = false;         ///< cells have the unit of the heights
  bool has_sea = false;           ///< heights are relative to sea level
};
Ground ground_of(const Frame& frame, int cols, int rows);

struct Shaded {
  std::vector<Colour> colours;  ///< by pixel of the relief; white for nodata
  Tints tints;
};

/// Hillshade, tinted by height. The relief shows a whole grid of cols × rows samples; their cell size determines true
/// slopes.
Shaded shade(const Relief& relief, const Ground& ground, int cols, int rows);

}  // namespace scarp::draw
