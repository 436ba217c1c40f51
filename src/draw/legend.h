// The legend below a map: a scale bar, tints with their heights, lines with their names.
#pragma once

#include <array>
#include <string>
#include <vector>

#include "draw/canvas.h"
#include "draw/relief.h"

namespace scarp::draw {

inline constexpr Colour kInk{30, 30, 30};

/// Width and height of a map of cols × rows samples on paper: the longer side is at most `room` pixels, and small
/// rasters are enlarged by a whole factor to some `wanted` pixels. Cells are `aspect` times as wide as they are high.
std::array<int, 2> map_size(int cols, int rows, double aspect, std::array<int, 2> room, int wanted);

struct Name {
  Colour colour;
  std::string text;
};

struct Legend {
  double metres = 0;  ///< width of a pixel; 0: no scale bar
  Tints tints;
  std::string unit;         ///< unit of heights
  std::vector<Name> names;  ///< names of lines
};

/// Pixels of the legend's height; 0 where the picture is too small for one.
int legend_height(int width);
/// Draws into the rows from `top` on. Items that do not fit are omitted, from the right.
void draw_legend(Picture& picture, int top, const Legend& legend);

}  // namespace scarp::draw
