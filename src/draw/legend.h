// The legend below a map: a scale bar, tints with their heights, and lines with their names.
#pragma once

#include <array>
#include <string>
#include <vector>

#include "draw/canvas.h"
#include "draw/relief.h"

namespace scarp::draw {

inline constexpr Colour kInk{30, 30, 30};

/// Size in pixels of a map of cols × rows samples on paper. The longer side is at most `room` pixels. Small rasters are
/// enlarged by an integer factor to about `wanted` pixels. Cells are `aspect` times as wide as high.
std::array<int, 2> map_size(int cols, int rows, double aspect, std::array<int, 2> room, int wanted);

struct Name {
  Colour colour;
  std::string text;
};

struct Legend {
  double metres = 0;  ///< width of a pixel; 0: no scale bar
  Tints tints;
  std::string unit;
  std::vector<Name> names;
};

/// Height of the legend in pixels; 0 where the picture is too small for one.
int legend_height(int width);
/// Draws into the rows from `top` on. Omits items at the right that do not fit.
void draw_legend(Picture& picture, int top, const Legend& legend);

}  // namespace scarp::draw
