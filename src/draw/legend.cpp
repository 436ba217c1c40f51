#include "draw/legend.h"

#include <fmt/core.h>

#include <algorithm>
#include <cmath>

#include "draw/font.h"

namespace scarp::draw {
namespace {

constexpr int kNarrow = 300;  // pixels: no legend below this width

int text_size(int width) { return width >= 1000 ? 2 : 1; }

void fill(Picture& picture, int x, int y, int width, int height, const Colour& colour) {
  for (int dy = 0; dy < height; ++dy) {
    for (int dx = 0; dx < width; ++dx) set_pixel(picture, x + dx, y + dy, colour);
  }
}

/// 1, 2 or 5 times a power of ten, at most `most`.
double round_length(double most) {
  const double power = std::pow(10.0, std::floor(std::log10(most)));
  return most >= 5 * power ? 5 * power : most >= 2 * power ? 2 * power : power;
}

/// Draws the bar, then its length. Returns x at their end.
int draw_scale_bar(Picture& picture, int x, int middle, int size, double metres) {
  const double length = round_length(metres * picture.width / 6);
  const int pixels = std::max(1, static_cast<int>(std::lround(length / metres))), end = 3 * size;
  fill(picture, x, middle - size / 2, pixels, size, kInk);
  fill(picture, x, middle - end, size, 2 * end, kInk);
  fill(picture, x + pixels - size, middle - end, size, 2 * end, kInk);
  const std::string text = length >= 1000 ? fmt::format("{:.10g} km", length / 1000) : fmt::format("{:.6g} m", length);
  x += pixels + 4 * size;
  write_text(picture, x, middle - text_height(size) / 2, size, text, kInk);
  return x + text_width(text, size);
}

/// Draws the tints between their lowest and highest heights, with a tick at sea level. Returns x at their end.
int draw_tints(Picture& picture, int x, int middle, int size, const Legend& legend) {
  const Tints& tints = legend.tints;
  const std::string low = fmt::format("{:.5g}", tints.lowest),
                    high = fmt::format("{:.5g}{}{}", tints.highest, legend.unit.empty() ? "" : " ", legend.unit);
  const int top = middle - text_height(size) / 2, pixels = std::max(40 * size, picture.width / 8), half = 4 * size;
  write_text(picture, x, top, size, low, kInk);
  x += text_width(low, size) + 4 * size;
  for (int k = 0; k < pixels; ++k)
    fill(picture, x + k, middle - half, 1, 2 * half,
         tints.at(tints.lowest + (tints.highest - tints.lowest) * k / std::max(1, pixels - 1)));
  if (tints.has_sea && tints.lowest < 0 && tints.highest > 0) {
    const int sea = x + static_cast<int>(std::lround(-tints.lowest / (tints.highest - tints.lowest) * (pixels - 1)));
    fill(picture, sea - size / 2, middle - half - 2 * size, size, 2 * half + 4 * size, kInk);
  }
  x += pixels + 4 * size;
  write_text(picture, x, top, size, high, kInk);
  return x + text_width(high, size);
}

}  // namespace

std::array<int, 2> map_size(int cols, int rows, double aspect, std::array<int, 2> room, int wanted) {
  const double wide = cols * std::max(1.0, aspect), high = rows * std::max(1.0, 1 / aspect),
               side = std::max(wide, high);
  const double fits = std::min(room[0] / wide, room[1] / high);
  const double scale = side < wanted ? std::min(std::floor(wanted / side) + 1, std::floor(fits)) : std::min(1.0, fits);
  const double used = scale >= 1 ? scale : std::min(1.0, fits);
  return {std::max(1, static_cast<int>(wide * used)), std::max(1, static_cast<int>(high * used))};
}

int legend_height(int width) { return width < kNarrow ? 0 : text_height(text_size(width)) + 8 * text_size(width); }

void draw_legend(Picture& picture, int top, const Legend& legend) {
  const int size = text_size(picture.width), gap = 14 * size, middle = top + legend_height(picture.width) / 2;
  int x = 4 * size;
  if (legend.metres > 0 && std::isfinite(legend.metres))
    x = draw_scale_bar(picture, x, middle, size, legend.metres) + gap;
  if (legend.tints.lowest < legend.tints.highest) x = draw_tints(picture, x, middle, size, legend) + gap;
  for (const Name& name : legend.names) {
    const int swatch = 14 * size, width = swatch + 4 * size + text_width(name.text, size);
    if (x + width > picture.width) return;
    fill(picture, x, middle - size, swatch, 2 * size, name.colour);
    write_text(picture, x + swatch + 4 * size, middle - text_height(size) / 2, size, name.text, kInk);
    x += width + gap;
  }
}

}  // namespace scarp::draw
