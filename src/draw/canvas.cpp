#include "draw/canvas.h"

#include <algorithm>
#include <cmath>

namespace scarp::draw {
Picture blank(int width, int height) {
  const std::size_t bytes = static_cast<std::size_t>(width) * static_cast<std::size_t>(height) * 3;
  return {width, height, std::vector<std::uint8_t>(bytes, 255)};
}

void set_pixel(Picture& picture, int x, int y, const Colour& colour) {
  if (x < 0 || y < 0 || x >= picture.width || y >= picture.height) return;
  const std::size_t at =
      3 * (static_cast<std::size_t>(y) * static_cast<std::size_t>(picture.width) + static_cast<std::size_t>(x));
  for (std::size_t k = 0; k < 3; ++k) {
    picture.rgb[at + k] = static_cast<std::uint8_t>(std::clamp(colour[k] + 0.5, 0.0, 255.0));
  }
}

void LineLayer::add_line(double x0, double y0, double x1, double y1, double line_width, double darkness) {
  if (!std::isfinite(x0 + y0 + x1 + y1)) return;
  const bool is_steep = std::abs(y1 - y0) > std::abs(x1 - x0);
  if (is_steep) {
    std::swap(x0, y0);
    std::swap(x1, y1);
  }
  if (x0 > x1) {
    std::swap(x0, x1);
    std::swap(y0, y1);
  }
  const double length = x1 - x0;
  const double slope = length > 0 ? (y1 - y0) / length : 0;
  const double across = 1 / std::sqrt(1 + slope * slope);  // perpendicular distance per pixel
  const double reach = (line_width / 2 + 0.5) / across;
  const int end_x = (is_steep ? height_ : width_) - 1, end_y = (is_steep ? width_ : height_) - 1;
  const int first = static_cast<int>(std::clamp(std::floor(x0 + 0.5), 0.0, end_x + 1.0));
  const int last = static_cast<int>(std::clamp(std::floor(x1 + 0.5), -1.0, static_cast<double>(end_x)));
  for (int x = first; x <= last; ++x) {
    const double y = y0 + slope * (std::clamp(static_cast<double>(x), x0, x1) - x0);
    const int low = static_cast<int>(std::clamp(std::ceil(y - reach), 0.0, end_y + 1.0));
    const int high = static_cast<int>(std::clamp(std::floor(y + reach), -1.0, static_cast<double>(end_y)));
    for (int v = low; v <= high; ++v) {
      const double covered = std::clamp(line_width / 2 + 0.5 - std::abs(v - y) * across, 0.0, 1.0);
      const int px = is_steep ? v : x, py = is_steep ? x : v;
      float& cover =
          cover_[static_cast<std::size_t>(py) * static_cast<std::size_t>(width_) + static_cast<std::size_t>(px)];
      cover = std::max(cover, static_cast<float>(covered * darkness));
    }
  }
}

void LineLayer::blend_into(Picture& picture, const Colour& ink) const {
  for (std::size_t i = 0; i < cover_.size(); ++i) {
    for (std::size_t k = 0; k < 3; ++k) {
      const double under = picture.rgb[3 * i + k];
      picture.rgb[3 * i + k] =
          static_cast<std::uint8_t>(under + (ink[k] - under) * static_cast<double>(cover_[i]) + 0.5);
    }
  }
}

}  // namespace scarp::draw
