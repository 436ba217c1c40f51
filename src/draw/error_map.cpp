// The error map: signed errors in colours, with a scale.
#include <fmt/core.h>

#include <algorithm>
#include <cmath>
#include <limits>

#include "draw/canvas.h"
#include "scarp/picture.h"

namespace scarp {
namespace {

using draw::Colour;

// Blue, white, red: told apart with every common colour blindness, and in grey by darkness.
constexpr std::array<Colour, 7> kDiverging{Colour{5, 48, 97},     Colour{67, 147, 195},  Colour{171, 210, 229},
                                           Colour{250, 250, 250}, Colour{248, 186, 155}, Colour{214, 96, 77},
                                           Colour{120, 0, 32}};
constexpr Colour kVoidColour{150, 150, 150};
constexpr Colour kMapInk{30, 30, 30};
constexpr int kSmallMap = 500;

Colour colour_of(double error, double limit) {
  return draw::ramp(kDiverging, limit > 0 ? 0.5 + error / limit / 2 : 0.5);
}

/// In each pixel the error of the largest size: means would hide what the map is asked for. NaN where there is none.
std::vector<float> reduce(std::span<const float> errors, int cols, int rows, int width, int height) {
  std::vector<float> out(static_cast<std::size_t>(width) * static_cast<std::size_t>(height),
                         std::numeric_limits<float>::quiet_NaN());
  for (int r = 0; r < rows; ++r) {
    const auto y = static_cast<std::size_t>(static_cast<std::int64_t>(r) * height / rows);
    for (int c = 0; c < cols; ++c) {
      const auto x = static_cast<std::size_t>(static_cast<std::int64_t>(c) * width / cols);
      const float error =
          errors[static_cast<std::size_t>(r) * static_cast<std::size_t>(cols) + static_cast<std::size_t>(c)];
      float& held = out[y * static_cast<std::size_t>(width) + x];
      if (std::isnan(held) || std::abs(error) > std::abs(held)) held = error;
    }
  }
  return out;
}

/// A bar from −limit to +limit with numbers below; `top` is its first row.
void draw_scale(Picture& picture, int top, int size, double limit) {
  const int left = std::max(2, picture.width / 10), right = picture.width - 1 - left;
  const int bar = 7 * size;
  for (int x = left; x <= right; ++x) {
    const double t = right > left ? static_cast<double>(x - left) / (right - left) : 0.5;
    for (int y = 0; y < bar; ++y) {
      const bool is_frame = x == left || x == right || y == 0 || y == bar - 1;
      draw::set_pixel(picture, x, top + y, is_frame ? kMapInk : draw::ramp(kDiverging, t));
    }
  }
  // Two more numbers between where there is room for them.
  const int step = draw::character_step(size);
  const bool is_wide = right - left > 40 * step;
  for (int k = 0; k <= 4; ++k) {
    if ((k % 2 == 1 && !is_wide) || (limit <= 0 && k != 2)) continue;
    const double value = limit * (k - 2) / 2;
    const std::string text = k == 2 ? "0" : fmt::format("{:+.3g}", value);
    const int x = left + (right - left) * k / 4, width = static_cast<int>(text.size()) * step - size;
    for (int y = 0; y < 2 * size; ++y) draw::set_pixel(picture, x, top + bar + y, kMapInk);
    draw::write_number(picture, std::clamp(x - width / 2, 0, std::max(0, picture.width - width)), top + bar + 3 * size,
                       size, text, kMapInk);
  }
}

}  // namespace

Picture draw_error_map(std::span<const float> errors, int cols, int rows, double limit, int max_side) {
  if (cols < 1 || rows < 1 || errors.size() < static_cast<std::size_t>(cols) * static_cast<std::size_t>(rows))
    return {};
  if (!(limit > 0) || !std::isfinite(limit)) {
    limit = 0;
    for (const float error : errors) {
      if (std::isfinite(error)) limit = std::max(limit, std::abs(static_cast<double>(error)));
    }
  }
  max_side = std::max(max_side, 1);
  const int size = max_side >= 600 ? 2 : 1, below = 24 * size;
  const int room = max_side > 2 * below ? max_side - below : max_side;  // for the map's height
  const double scale = std::min({1.0, static_cast<double>(max_side) / cols, static_cast<double>(room) / rows});
  const int width = std::max(1, static_cast<int>(cols * scale)), height = std::max(1, static_cast<int>(rows * scale));
  const int side = std::max(cols, rows);
  const int factor =
      std::max(1, std::min({max_side / width, room / height, side < kSmallMap ? kSmallMap / side + 1 : 1}));

  const std::vector<float> reduced = reduce(errors, cols, rows, width, height);
  const bool has_scale = room < max_side;
  Picture picture = draw::blank(width * factor, height * factor + (has_scale ? below : 0));
  for (int y = 0; y < height * factor; ++y) {
    for (int x = 0; x < picture.width; ++x) {
      const float error = reduced[static_cast<std::size_t>(y / factor) * static_cast<std::size_t>(width) +
                                  static_cast<std::size_t>(x / factor)];
      draw::set_pixel(picture, x, y, std::isnan(error) ? kVoidColour : colour_of(static_cast<double>(error), limit));
    }
  }
  if (has_scale) draw_scale(picture, height * factor + 4 * size, size, limit);
  return picture;
}

}  // namespace scarp
