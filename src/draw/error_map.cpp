// The error map: signed errors in colours, with a scale.
#include <fmt/core.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <utility>

#include "draw/canvas.h"
#include "draw/font.h"
#include "draw/legend.h"
#include "scarp/picture.h"

namespace scarp {
namespace {

using draw::Colour;

// Blue, white, red: distinguishable with every common colour blindness, and in grey by brightness.
constexpr std::array<Colour, 7> kDiverging{Colour{5, 48, 97},     Colour{67, 147, 195},  Colour{171, 210, 229},
                                           Colour{250, 250, 250}, Colour{248, 186, 155}, Colour{214, 96, 77},
                                           Colour{120, 0, 32}};
constexpr Colour kNodataColour{150, 150, 150};
constexpr int kSmallMap = 500;

Colour colour_of(double error, double limit) {
  return draw::ramp(kDiverging, limit > 0 ? 0.5 + error / limit / 2 : 0.5);
}

/// Pixels for the picture's scale, its numbers and its title; none if the picture is too small.
struct Layout {
  Layout(int max_side, bool has_title)
      : size(max_side >= 1000 ? 2 : 1),
        below(max_side > 48 * size ? draw::text_height(size) + 15 * size : 0),
        above(has_title && max_side >= 200 ? draw::text_height(size) + 4 * size : 0),
        room(std::max(1, max_side - below - above)) {}
  int size, below, above, room;  ///< room: for the map's height
};

/// Draws a bar from −limit to +limit with numbers below; `top` is its first row.
void draw_scale(Picture& picture, int top, int size, double limit, const std::string& unit) {
  const int left = std::max(2, picture.width / 10), right = picture.width - 1 - left;
  const int bar = 7 * size;
  for (int x = left; x <= right; ++x) {
    const double t = right > left ? static_cast<double>(x - left) / (right - left) : 0.5;
    for (int y = 0; y < bar; ++y) {
      const bool is_frame = x == left || x == right || y == 0 || y == bar - 1;
      draw::set_pixel(picture, x, top + y, is_frame ? draw::kInk : draw::ramp(kDiverging, t));
    }
  }
  // Adds two numbers between the ends if there is room.
  const bool is_wide = right - left > 240 * size;
  for (int k = 0; k <= 4; ++k) {
    if ((k % 2 == 1 && !is_wide) || (limit <= 0 && k != 2)) continue;
    const double value = limit * (k - 2) / 2;
    const std::string text =
        (k == 2 ? "0" : fmt::format("{:+.3g}", value)) + (k == 4 && !unit.empty() ? " " + unit : "");
    const int x = left + (right - left) * k / 4, width = draw::text_width(text, size);
    for (int y = 0; y < 2 * size; ++y) draw::set_pixel(picture, x, top + bar + y, draw::kInk);
    draw::write_text(picture, std::clamp(x - width / 2, 0, std::max(0, picture.width - width)), top + bar + 3 * size,
                     size, text, draw::kInk);
  }
}

double aspect_of(const std::array<double, 2>& cell) {
  constexpr double kSteepest = 8;
  const double aspect = cell[0] / cell[1];
  return cell[0] > 0 && cell[1] > 0 && std::isfinite(aspect) ? std::clamp(aspect, 1 / kSteepest, kSteepest) : 1;
}

}  // namespace

/// Each pixel shows its largest error; a mean would hide errors.
ErrorMap::ErrorMap(int cols, int rows, ErrorMapOptions options)
    : cols_(cols), rows_(rows), options_(std::move(options)) {
  options_.max_side = std::max(options_.max_side, 1);
  const Layout layout(options_.max_side, !options_.title.empty());
  size_ = draw::map_size(cols, rows, aspect_of(options_.cell), {options_.max_side, layout.room}, kSmallMap);
  width_ = std::min(size_[0], cols);
  height_ = std::min(size_[1], rows);
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

Picture ErrorMap::draw() const {
  const double limit = options_.limit > 0 && std::isfinite(options_.limit) ? options_.limit : largest_;
  const Layout layout(options_.max_side, !options_.title.empty());
  const auto [width, height] = size_;
  Picture picture = draw::blank(width, layout.above + height + layout.below);
  for (int y = 0; y < height; ++y) {
    const auto row = static_cast<std::size_t>(static_cast<std::int64_t>(y) * height_ / height);
    for (int x = 0; x < width; ++x) {
      const float error = errors_[row * static_cast<std::size_t>(width_) +
                                  static_cast<std::size_t>(static_cast<std::int64_t>(x) * width_ / width)];
      draw::set_pixel(picture, x, layout.above + y,
                      std::isnan(error) ? kNodataColour : colour_of(static_cast<double>(error), limit));
    }
  }
  if (layout.above > 0)
    draw::write_text(picture, 4 * layout.size, 2 * layout.size, layout.size, options_.title, draw::kInk);
  if (layout.below > 0) draw_scale(picture, layout.above + height + 4 * layout.size, layout.size, limit, options_.unit);
  return picture;
}

Picture draw_error_map(std::span<const float> errors, int cols, int rows, const ErrorMapOptions& options) {
  if (cols < 1 || rows < 1 || errors.size() < static_cast<std::size_t>(cols) * static_cast<std::size_t>(rows))
    return {};
  ErrorMap map(cols, rows, options);
  for (int row = 0; row < rows; ++row)
    map.add(row, errors.subspan(static_cast<std::size_t>(row) * static_cast<std::size_t>(cols),
                                static_cast<std::size_t>(cols)));
  return map.draw();
}

}  // namespace scarp
