// Text on a Picture, with the glyphs of "7x13" from the X Window System's miscellaneous fixed fonts, which are in the
// public domain. Each character is one column wider than its ink.
#pragma once

#include <string_view>

#include "draw/canvas.h"

namespace scarp::draw {

/// Pixels from the top of the tallest character to the bottom of the lowest; each dot is `size` x `size` pixels.
constexpr int text_height(int size) { return 13 * size; }
int text_width(std::string_view text, int size);
/// The upper left corner is at (x, y); text outside the picture is clipped. Characters beyond ASCII become '?'.
void write_text(Picture& picture, int x, int y, int size, std::string_view text, const Colour& ink);

}  // namespace scarp::draw
