// The preview: hillshade, tinted by height, under the mesh.
//
// Light comes from the picture's upper left (azimuth 315°, altitude 45°), whichever way the raster's rows run: lit from
// below, hills look like holes. Slopes are true to the frame's cell size and then exaggerated until a steep place (the
// slope that 80 % of the samples stay below) is clearly lit; that also makes degrees and other units without meaning
// drawable.
#include <algorithm>
#include <cmath>
#include <limits>

#include "draw/canvas.h"
#include "draw/grid_positions.h"
#include "scarp/picture.h"

namespace scarp {
namespace {

using draw::Colour;

constexpr std::array<Colour, 4> kTints{Colour{176, 201, 170}, Colour{226, 222, 178}, Colour{222, 190, 148},
                                       Colour{232, 216, 206}};
constexpr Colour kInk{24, 28, 48};
constexpr int kSmall = 700;  // rasters below this many samples a side are enlarged

/// Heights by pixel, NaN = void.
struct Relief {
  int width = 0, height = 0;
  std::vector<double> z;
  double at(int x, int y) const {
    return z[static_cast<std::size_t>(y) * static_cast<std::size_t>(width) + static_cast<std::size_t>(x)];
  }
};

/// Means of the samples that fall into each pixel; void where more than half of them are.
Relief reduce(const HeightField& field, int width, int height) {
  Relief relief{width, height, {}};
  const std::size_t size = static_cast<std::size_t>(width) * static_cast<std::size_t>(height);
  relief.z.assign(size, 0);
  std::vector<std::uint32_t> valid(size, 0), all(size, 0);
  for (int r = 0; r < field.rows; ++r) {
    const auto y = static_cast<std::size_t>(static_cast<std::int64_t>(r) * height / field.rows);
    const float* row = field.samples + static_cast<std::size_t>(r) * static_cast<std::size_t>(field.cols);
    for (int c = 0; c < field.cols; ++c) {
      const std::size_t i = y * static_cast<std::size_t>(width) +
                            static_cast<std::size_t>(static_cast<std::int64_t>(c) * width / field.cols);
      ++all[i];
      if (!std::isfinite(row[c]) || (field.nodata && row[c] == *field.nodata)) continue;
      ++valid[i];
      relief.z[i] += static_cast<double>(row[c]);
    }
  }
  for (std::size_t i = 0; i < size; ++i) {
    relief.z[i] =
        2 * valid[i] < all[i] || valid[i] == 0 ? std::numeric_limits<double>::quiet_NaN() : relief.z[i] / valid[i];
  }
  return relief;
}

/// Rise per unit of ground to the right and up the picture; central differences, one-sided beside voids and borders.
std::vector<std::array<double, 2>> find_slopes(const Relief& relief, double step_x, double step_y) {
  std::vector<std::array<double, 2>> slopes(relief.z.size());
  const auto valid = [&](int x, int y) {
    return x >= 0 && y >= 0 && x < relief.width && y < relief.height && !std::isnan(relief.at(x, y));
  };
  const auto rise = [&](int x, int y, int dx, int dy) {
    const int x0 = valid(x - dx, y - dy) ? x - dx : x, y0 = valid(x - dx, y - dy) ? y - dy : y;
    const int x1 = valid(x + dx, y + dy) ? x + dx : x, y1 = valid(x + dx, y + dy) ? y + dy : y;
    const int steps = (x1 - x0) + (y1 - y0);
    return steps == 0 ? 0.0 : (relief.at(x1, y1) - relief.at(x0, y0)) / steps;
  };
  for (int y = 0; y < relief.height; ++y) {
    for (int x = 0; x < relief.width; ++x) {
      if (!valid(x, y)) continue;
      slopes[static_cast<std::size_t>(y) * static_cast<std::size_t>(relief.width) + static_cast<std::size_t>(x)] = {
          rise(x, y, 1, 0) / step_x, -rise(x, y, 0, 1) / step_y};
    }
  }
  return slopes;
}

double choose_exaggeration(const Relief& relief, const std::vector<std::array<double, 2>>& slopes, bool is_metric) {
  std::vector<double> steepness;
  for (std::size_t i = 0; i < slopes.size(); ++i) {
    if (!std::isnan(relief.z[i])) steepness.push_back(std::hypot(slopes[i][0], slopes[i][1]));
  }
  if (steepness.empty()) return 1;
  const auto rank = steepness.begin() + static_cast<std::ptrdiff_t>(steepness.size() * 4 / 5);
  std::nth_element(steepness.begin(), rank, steepness.end());
  if (!(*rank > 0) || !std::isfinite(*rank)) return 1;
  const double wanted = 0.7 / *rank;
  return is_metric ? std::clamp(wanted, 0.5, 10.0) : wanted;
}

/// Colours by pixel of the relief.
std::vector<Colour> shade(const Relief& relief, const std::vector<std::array<double, 2>>& slopes, double exaggeration) {
  double lowest = HUGE_VAL, highest = -HUGE_VAL;
  for (const double z : relief.z) {
    if (std::isnan(z)) continue;
    lowest = std::min(lowest, z);
    highest = std::max(highest, z);
  }
  const double per_range = highest > lowest ? 1 / (highest - lowest) : 0;
  std::vector<Colour> colours(relief.z.size(), Colour{255, 255, 255});
  for (std::size_t i = 0; i < colours.size(); ++i) {
    if (std::isnan(relief.z[i])) continue;
    const double gx = slopes[i][0] * exaggeration, gy = slopes[i][1] * exaggeration;
    const double light = std::max(0.0, (0.5 * gx - 0.5 * gy + std::sqrt(0.5)) / std::sqrt(1 + gx * gx + gy * gy));
    const Colour tint = draw::ramp(kTints, (relief.z[i] - lowest) * per_range);
    for (std::size_t k = 0; k < 3; ++k) colours[i][k] = std::min(250.0, tint[k] * (0.3 + 0.95 * light));
  }
  return colours;
}

/// Enlarges by an integer factor, bilinear between valid pixels; a pixel is void where its nearest one is.
Picture enlarge(const Relief& relief, const std::vector<Colour>& colours, int factor) {
  Picture picture = draw::blank(relief.width * factor, relief.height * factor);
  for (int y = 0; y < picture.height; ++y) {
    for (int x = 0; x < picture.width; ++x) {
      if (std::isnan(relief.at(x / factor, y / factor))) continue;
      const double u = (x + 0.5) / factor - 0.5, v = (y + 0.5) / factor - 0.5;
      const int x0 = static_cast<int>(std::floor(u)), y0 = static_cast<int>(std::floor(v));
      Colour sum{};
      double total = 0;
      for (int dy = 0; dy < 2; ++dy) {
        for (int dx = 0; dx < 2; ++dx) {
          const int px = std::clamp(x0 + dx, 0, relief.width - 1), py = std::clamp(y0 + dy, 0, relief.height - 1);
          if (std::isnan(relief.at(px, py))) continue;
          const double weight = (dx ? u - x0 : 1 - (u - x0)) * (dy ? v - y0 : 1 - (v - y0));
          const Colour& colour = colours[static_cast<std::size_t>(py) * static_cast<std::size_t>(relief.width) +
                                         static_cast<std::size_t>(px)];
          for (std::size_t k = 0; k < 3; ++k) sum[k] += weight * colour[k];
          total += weight;
        }
      }
      for (double& part : sum) part /= total;
      draw::set_pixel(picture, x, y, sum);
    }
  }
  return picture;
}

/// Draws the sides of the triangles that face up; those of small triangles lighter, so that dense places stay readable.
void draw_mesh(const HeightField& field, const Mesh& mesh, Picture& picture) {
  const draw::GridPositions at = draw::find_grid_positions(field.frame, field.cols, field.rows, mesh);
  const double scale_x = static_cast<double>(picture.width) / field.cols,
               scale_y = static_cast<double>(picture.height) / field.rows;
  draw::LineLayer lines(picture.width, picture.height);
  for (std::size_t t = 0; t < mesh.triangle_count(); ++t) {
    std::array<double, 3> x{}, y{}, east{}, north{};
    for (std::size_t k = 0; k < 3; ++k) {
      const std::size_t v = mesh.triangles[3 * t + k];
      if (v >= mesh.vertex_count()) return;
      x[k] = (at.cols[v] + 0.5) * scale_x - 0.5;
      y[k] = (at.rows[v] + 0.5) * scale_y - 0.5;
      east[k] = mesh.positions[3 * v];
      north[k] = mesh.positions[3 * v + 1];
    }
    if ((east[1] - east[0]) * (north[2] - north[0]) - (north[1] - north[0]) * (east[2] - east[0]) <= 0) continue;
    const double size = std::sqrt(std::abs((x[1] - x[0]) * (y[2] - y[0]) - (y[1] - y[0]) * (x[2] - x[0])));
    // Triangles of three pixels and less would blacken the picture.
    const double darkness = 0.62 * std::clamp((size - 0.5) / 11, 0.12, 1.0);
    for (std::size_t k = 0; k < 3; ++k) {
      const std::size_t next = (k + 1) % 3;
      lines.add_line(x[k], y[k], x[next], y[next], 0.9, darkness);
    }
  }
  lines.blend_into(picture, kInk);
}

}  // namespace

Picture draw_preview(const HeightField& field, const Mesh& mesh, int max_side) {
  if (field.cols < 1 || field.rows < 1 || field.samples == nullptr) return {};
  max_side = std::max(max_side, 1);
  const int side = std::max(field.cols, field.rows);
  const double scale = std::min(1.0, static_cast<double>(max_side) / side);
  const int width = std::max(1, static_cast<int>(field.cols * scale)),
            height = std::max(1, static_cast<int>(field.rows * scale));
  const int factor = side >= kSmall ? 1 : std::max(1, std::min(max_side / side, 3 * kSmall / (2 * side) + 1));

  const Relief relief = reduce(field, width, height);
  auto [step_x, step_y] = draw::step_lengths(field.frame, field.cols, field.rows);
  if (!(step_x > 0) || !std::isfinite(step_x) || !(step_y > 0) || !std::isfinite(step_y)) step_x = step_y = 1;
  const auto slopes = find_slopes(relief, step_x * field.cols / width, step_y * field.rows / height);
  const bool is_metric = field.frame.kind == Frame::Kind::kLocal || field.frame.kind == Frame::Kind::kProjected;
  Picture picture = enlarge(relief, shade(relief, slopes, choose_exaggeration(relief, slopes, is_metric)), factor);
  draw_mesh(field, mesh, picture);
  return picture;
}

}  // namespace scarp
