// Channels as colours, and comparison of pictures.
#include <algorithm>
#include <array>
#include <cmath>
#include <limits>

#include "draw/canvas.h"
#include "scarp/picture.h"

namespace scarp {
namespace {

/// Maps an image's values to red, green and blue.
class Paint {
 public:
  explicit Paint(const OwnedChannels& channels) : is_color_(channels.bands.size() == 3) {
    if (channels.is_8bit) return;
    double least = HUGE_VAL, most = -HUGE_VAL;
    for (std::size_t k = 0; k < (is_color_ ? 3u : 1u) && k < channels.bands.size(); ++k) {
      for (const float value : channels.bands[k]) {
        if (!std::isfinite(value)) continue;
        least = std::min(least, double{value});
        most = std::max(most, double{value});
      }
    }
    least_ = least <= most ? least : 0;
    scale_ = least < most ? 255 / (most - least) : 0;
  }

  /// Colour of one sample or vertex; `value(k)` is channel k. White without values.
  template <class Value>
  std::array<std::uint8_t, 3> operator()(Value value) const {
    std::array<std::uint8_t, 3> rgb{255, 255, 255};
    std::array<double, 3> parts{};
    for (std::size_t k = 0; k < 3; ++k) {
      const float raw = value(is_color_ ? k : std::size_t{0});
      if (!std::isfinite(raw)) return rgb;
      parts[k] = (double{raw} - least_) * scale_;
    }
    for (std::size_t k = 0; k < 3; ++k) rgb[k] = static_cast<std::uint8_t>(std::clamp(parts[k] + 0.5, 0.0, 255.0));
    return rgb;
  }

 private:
  bool is_color_;
  double least_ = 0, scale_ = 1;
};

}  // namespace

Picture draw_channels(const OwnedChannels& channels) {
  if (channels.bands.empty() || channels.cols < 1 || channels.rows < 1) return {};
  const Paint paint(channels);
  Picture picture{channels.cols, channels.rows, {}};
  const std::size_t count = channels.bands.front().size();
  picture.rgb.reserve(3 * count);
  for (std::size_t i = 0; i < count; ++i) {
    const auto rgb = paint([&](std::size_t k) { return channels.bands[k][i]; });
    picture.rgb.insert(picture.rgb.end(), rgb.begin(), rgb.end());
  }
  return picture;
}

void color_by_channels(Mesh& mesh, const OwnedChannels& channels) {
  const auto width = static_cast<std::size_t>(mesh.channel_count);
  const std::size_t count = mesh.vertex_count();
  mesh.colors.clear();
  if (channels.bands.empty() || width < channels.bands.size() || mesh.channels.size() != width * count) return;
  const Paint paint(channels);
  mesh.colors.reserve(3 * count);
  for (std::size_t v = 0; v < count; ++v) {
    const auto rgb = paint([&](std::size_t k) { return mesh.channels[width * v + k]; });
    mesh.colors.insert(mesh.colors.end(), rgb.begin(), rgb.end());
  }
}

double find_psnr(const Picture& a, const Picture& b) {
  std::uint64_t squares = 0;
  const std::size_t count = std::min(a.rgb.size(), b.rgb.size());
  for (std::size_t i = 0; i < count; ++i) {
    const int difference = a.rgb[i] - b.rgb[i];
    squares += static_cast<std::uint64_t>(difference * difference);
  }
  if (squares == 0) return std::numeric_limits<double>::infinity();
  return 10 * std::log10(255.0 * 255.0 * static_cast<double>(count) / static_cast<double>(squares));
}

Picture place_side_by_side(std::span<const Picture> pictures, int gap) {
  if (pictures.empty()) return {};
  int width = 0, height = 0;
  for (const Picture& picture : pictures) {
    width += picture.width + (width > 0 ? std::max(gap, 0) : 0);
    height = std::max(height, picture.height);
  }
  Picture all = draw::blank(width, height);
  int left = 0;
  for (const Picture& picture : pictures) {
    if (left > 0) left += std::max(gap, 0);
    const std::size_t line = 3 * static_cast<std::size_t>(picture.width);
    for (int y = 0; y < picture.height; ++y) {
      const std::size_t to =
          3 * (static_cast<std::size_t>(y) * static_cast<std::size_t>(width) + static_cast<std::size_t>(left));
      std::copy_n(picture.rgb.begin() + static_cast<std::ptrdiff_t>(line * static_cast<std::size_t>(y)), line,
                  all.rgb.begin() + static_cast<std::ptrdiff_t>(to));
    }
    left += picture.width;
  }
  return all;
}

}  // namespace scarp
