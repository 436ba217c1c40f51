// Text on a Picture, in the glyphs of "7x13" of the X Window System's miscellaneous fixed fonts, which are in the
// public domain. Each character has the columns in which it has ink, and one more.
#pragma once

#include <string_view>

#include "draw/canvas.h"

namespace scarp::draw {

/// Pixels from the top of the tallest character to the bottom of the lowest, for pixels of `size` x `size`.
constexpr int text_height(int size) { return 13 * size; }
int text_width(std::string_view text, int size);
/// The upper left corner is at (x, y); what lies outside is cut off. Characters beyond ASCII become '?'.
void write_text(Picture& picture, int x, int y, int size, std::string_view text, const Colour& ink);

}  // namespace scarp::draw
