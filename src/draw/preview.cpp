// The preview: hillshade, tinted by height, under the mesh.
#include <algorithm>
#include <cmath>
#include <limits>

#include "draw/canvas.h"
#include "draw/grid_positions.h"
#include "draw/relief.h"
#include "grid/bands.h"
#include "grid/samples.h"
#include "scarp/picture.h"

namespace scarp {
namespace {

using draw::Colour;
using draw::Relief;

constexpr Colour kFrameInk{24, 28, 48};
constexpr int kSmallPreview = 700;  // rasters below this many samples a side are enlarged

/// Means of the samples that fall into each pixel; nodata where more than half of them are.
Result<Relief> reduce(const HeightField& field, int width, int height) {
  Relief relief{width, height, {}};
  const std::size_t size = static_cast<std::size_t>(width) * static_cast<std::size_t>(height);
  relief.z.assign(size, 0);
  std::vector<std::uint32_t> valid(size, 0), all(size, 0);
  const auto add_row = [&](int r, const float* row) {
    const auto y = static_cast<std::size_t>(static_cast<std::int64_t>(r) * height / field.rows);
    for (int c = 0; c < field.cols; ++c) {
      const std::size_t i = y * static_cast<std::size_t>(width) +
                            static_cast<std::size_t>(static_cast<std::int64_t>(c) * width / field.cols);
      ++all[i];
      if (std::isnan(row[c])) continue;
      ++valid[i];
      relief.z[i] += static_cast<double>(row[c]);
    }
  };
  const auto swept = sweep_rows(field, 0, [&](const RowRange& rows) -> Result<void> {
    for (int r = rows.begin; r < rows.end; ++r) add_row(r, rows.row(r));
    return {};
  });
  if (!swept) return tl::unexpected(swept.error());
  for (std::size_t i = 0; i < size; ++i) {
    relief.z[i] =
        2 * valid[i] < all[i] || valid[i] == 0 ? std::numeric_limits<double>::quiet_NaN() : relief.z[i] / valid[i];
  }
  return relief;
}

/// Enlarges by an integer factor, bilinear between valid pixels; a pixel is nodata where its nearest one is.
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
  lines.blend_into(picture, kFrameInk);
}

}  // namespace

Result<Picture> draw_preview(const HeightField& field, const Mesh& mesh, int max_side) {
  if (auto sound = check_size(field); !sound) return tl::unexpected(sound.error());
  max_side = std::max(max_side, 1);
  const int side = std::max(field.cols, field.rows);
  const double scale = std::min(1.0, static_cast<double>(max_side) / side);
  const int width = std::max(1, static_cast<int>(field.cols * scale)),
            height = std::max(1, static_cast<int>(field.rows * scale));
  const int factor =
      side >= kSmallPreview ? 1 : std::max(1, std::min(max_side / side, 3 * kSmallPreview / (2 * side) + 1));

  const Result<Relief> relief = reduce(field, width, height);
  if (!relief) return tl::unexpected(relief.error());
  Picture picture = enlarge(*relief, draw::shade(*relief, field.frame, field.cols, field.rows), factor);
  draw_mesh(field, mesh, picture);
  return picture;
}

}  // namespace scarp
