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
constexpr Colour kNodataColour{150, 150, 150};
constexpr Colour kMapInk{30, 30, 30};
constexpr int kSmallMap = 500;

Colour colour_of(double error, double limit) {
  return draw::ramp(kDiverging, limit > 0 ? 0.5 + error / limit / 2 : 0.5);
}

/// Pixels that the picture's scale and the numbers under it take; none where the picture is too low for them.
struct Layout {
  explicit Layout(int max_side)
      : size(max_side >= 600 ? 2 : 1), below(max_side > 48 * size ? 24 * size : 0), room(max_side - below) {}
  int size, below, room;  ///< the last one is for the map's height
};

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

/// Means would hide what the map is asked for.
ErrorMap::ErrorMap(int cols, int rows, int max_side) : cols_(cols), rows_(rows), max_side_(std::max(max_side, 1)) {
  const double scale =
      std::min({1.0, static_cast<double>(max_side_) / cols, static_cast<double>(Layout(max_side_).room) / rows});
  width_ = std::max(1, static_cast<int>(cols * scale));
  height_ = std::max(1, static_cast<int>(rows * scale));
  errors_.assign(static_cast<std::size_t>(width_) * static_cast<std::size_t>(height_),
                 std::numeric_limits<float>::quiet_NaN());
}

void ErrorMap::add(int row, std::span<const float> errors) {
  const auto y = static_cast<std::size_t>(static_cast<std::int64_t>(row) * height_ / rows_);
  for (int c = 0; c < cols_; ++c) {
    const auto x = static_cast<std::size_t>(static_cast<std::int64_t>(c) * width_ / cols_);
    const float error = errors[static_cast<std::size_t>(c)];
    float& held = errors_[y * static_cast<std::size_t>(width_) + x];
    if (std::isnan(held) || std::abs(error) > std::abs(held)) held = error;
    if (std::isfinite(error)) largest_ = std::max(largest_, std::abs(static_cast<double>(error)));
  }
}

Picture ErrorMap::draw(double limit) const {
  if (!(limit > 0) || !std::isfinite(limit)) limit = largest_;
  const Layout layout(max_side_);
  const int side = std::max(cols_, rows_);
  const int factor =
      std::max(1, std::min({max_side_ / width_, layout.room / height_, side < kSmallMap ? kSmallMap / side + 1 : 1}));
  Picture picture = draw::blank(width_ * factor, height_ * factor + layout.below);
  for (int y = 0; y < height_ * factor; ++y) {
    for (int x = 0; x < picture.width; ++x) {
      const float error = errors_[static_cast<std::size_t>(y / factor) * static_cast<std::size_t>(width_) +
                                  static_cast<std::size_t>(x / factor)];
      draw::set_pixel(picture, x, y, std::isnan(error) ? kNodataColour : colour_of(static_cast<double>(error), limit));
    }
  }
  if (layout.below > 0) draw_scale(picture, height_ * factor + 4 * layout.size, layout.size, limit);
  return picture;
}

Picture draw_error_map(std::span<const float> errors, int cols, int rows, double limit, int max_side) {
  if (cols < 1 || rows < 1 || errors.size() < static_cast<std::size_t>(cols) * static_cast<std::size_t>(rows))
    return {};
  ErrorMap map(cols, rows, max_side);
  for (int row = 0; row < rows; ++row)
    map.add(row, errors.subspan(static_cast<std::size_t>(row) * static_cast<std::size_t>(cols),
                                static_cast<std::size_t>(cols)));
  return map.draw(limit);
}

}  // namespace scarp
