// The preview: hillshade, tinted by height, under the mesh.
#include <algorithm>
#include <cmath>
#include <limits>

#include "draw/canvas.h"
#include "draw/grid_positions.h"
#include "draw/legend.h"
#include "draw/relief.h"
#include "grid/bands.h"
#include "grid/samples.h"
#include "scarp/picture.h"

namespace scarp {
namespace {

using draw::Colour;
using draw::Relief;

constexpr Colour kFrameInk{24, 28, 48};
constexpr int kWantedPreview = 1050;  // pixels of the longer side after enlargement of smaller rasters

/// The mean of the samples in each pixel; nodata if more than half of the samples are nodata.
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
  const auto swept = grid::sweep_rows(field, 0, [&](const grid::RowRange& rows) -> Result<void> {
    for (int r = rows.begin; r < rows.end; ++r) add_row(r, rows.row(r));
    return {};
  });
  SCARP_RETURN_IF_ERROR(swept);
  for (std::size_t i = 0; i < size; ++i) {
    relief.z[i] =
        2 * valid[i] < all[i] || valid[i] == 0 ? std::numeric_limits<double>::quiet_NaN() : relief.z[i] / valid[i];
  }
  return relief;
}

/// Enlarges bilinearly between valid pixels; a pixel is nodata if its nearest one is.
void enlarge(const Relief& relief, const std::vector<Colour>& colours, int width, int height, Picture& picture) {
  const double per_x = static_cast<double>(relief.width) / width, per_y = static_cast<double>(relief.height) / height;
  const auto nearest = [](int at, int from, int to) {
    return static_cast<int>(static_cast<std::int64_t>(at) * to / from);
  };
  for (int y = 0; y < height; ++y) {
    for (int x = 0; x < width; ++x) {
      if (std::isnan(relief.at(nearest(x, width, relief.width), nearest(y, height, relief.height)))) continue;
      const double u = (x + 0.5) * per_x - 0.5, v = (y + 0.5) * per_y - 0.5;
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
}

/// The positions of samples on the map.
struct MapPlace {
  double per_col, per_row;
  double x(double col) const { return (col + 0.5) * per_col - 0.5; }
  double y(double row) const { return (row + 0.5) * per_row - 0.5; }
};

/// Draws the sides of the triangles that face up. Sides of small triangles fade, and vanish at a few pixels, since they
/// would cover the picture in grey.
void draw_mesh(const HeightField& field, const Mesh& mesh, const MapPlace& place, int height, Picture& picture) {
  const draw::GridPositions at = draw::find_grid_positions(field.frame, field.cols, field.rows, mesh);
  draw::LineLayer lines(picture.width, height);
  for (std::size_t t = 0; t < mesh.triangle_count(); ++t) {
    std::array<double, 3> x{}, y{}, east{}, north{};
    for (std::size_t k = 0; k < 3; ++k) {
      const std::size_t v = mesh.triangles[3 * t + k];
      if (v >= mesh.vertex_count()) return;
      x[k] = place.x(at.cols[v]);
      y[k] = place.y(at.rows[v]);
      east[k] = mesh.positions[3 * v];
      north[k] = mesh.positions[3 * v + 1];
    }
    if ((east[1] - east[0]) * (north[2] - north[0]) - (north[1] - north[0]) * (east[2] - east[0]) <= 0) continue;
    const double size = std::sqrt(std::abs((x[1] - x[0]) * (y[2] - y[0]) - (y[1] - y[0]) * (x[2] - x[0])));
    constexpr double kGone = 3, kFull = 16;  // pixels
    const double darkness = 0.62 * std::clamp((size - kGone) / (kFull - kGone), 0.0, 1.0);
    if (darkness <= 0) continue;
    for (std::size_t k = 0; k < 3; ++k) {
      const std::size_t next = (k + 1) % 3;
      lines.add_line(x[k], y[k], x[next], y[next], 0.9, darkness);
    }
  }
  lines.blend_into(picture, kFrameInk);
}

struct MarkStyle {
  MarkKind kind;
  Colour colour;
  const char* name;
};

// In drawing order. The colours are distinguishable with every common colour blindness.
constexpr MarkStyle kMarkStyles[] = {
    {MarkKind::kLake, {0, 114, 178}, "lakes"},         {MarkKind::kRidge, {204, 90, 0}, "ridges and valleys"},
    {MarkKind::kWater, {0, 114, 178}, "rivers"},       {MarkKind::kWall, {120, 20, 60}, "walls"},
    {MarkKind::kBreakline, {200, 0, 0}, "breaklines"}, {MarkKind::kCutline, {130, 0, 160}, "cutline"}};

void fill_lakes(const std::vector<Mark>& marks, const MapPlace& place, int height, const Colour& colour,
                Picture& picture) {
  constexpr double kTint = 0.55;
  std::vector<double> crossings;
  for (int y = 0; y < height; ++y) {
    crossings.clear();
    for (const Mark& mark : marks) {
      for (std::size_t k = 0; mark.kind == MarkKind::kLake && k + 1 < mark.points.size(); ++k) {
        const double y0 = place.y(mark.points[k][1]), y1 = place.y(mark.points[k + 1][1]);
        if ((y0 <= y) == (y1 <= y)) continue;
        const double x0 = place.x(mark.points[k][0]), x1 = place.x(mark.points[k + 1][0]);
        crossings.push_back(x0 + (y - y0) / (y1 - y0) * (x1 - x0));
      }
    }
    std::sort(crossings.begin(), crossings.end());
    for (std::size_t k = 0; k + 1 < crossings.size(); k += 2) {
      const int first = std::max(0, static_cast<int>(std::ceil(crossings[k])));
      const int last = std::min(picture.width - 1, static_cast<int>(std::floor(crossings[k + 1])));
      for (int x = first; x <= last; ++x) {
        std::uint8_t* const rgb =
            &picture.rgb[3 * (static_cast<std::size_t>(y) * static_cast<std::size_t>(picture.width) +
                              static_cast<std::size_t>(x))];
        for (std::size_t c = 0; c < 3; ++c)
          rgb[c] = static_cast<std::uint8_t>(rgb[c] + (colour[c] - rgb[c]) * kTint + 0.5);
      }
    }
  }
}

/// Returns the names of the kinds present.
std::vector<draw::Name> draw_marks(const std::vector<Mark>& marks, const MapPlace& place, int height,
                                   Picture& picture) {
  std::vector<draw::Name> names;
  const double line_width = picture.width >= 1000 ? 2.4 : 1.4;
  for (const MarkStyle& style : kMarkStyles) {
    draw::LineLayer lines(picture.width, height);
    bool has_any = false;
    for (const Mark& mark : marks) {
      if (mark.kind != style.kind) continue;
      has_any = true;
      for (std::size_t k = 0; k + 1 < mark.points.size(); ++k)
        lines.add_line(place.x(mark.points[k][0]), place.y(mark.points[k][1]), place.x(mark.points[k + 1][0]),
                       place.y(mark.points[k + 1][1]), line_width, 0.9);
    }
    if (!has_any) continue;
    if (style.kind == MarkKind::kLake) fill_lakes(marks, place, height, style.colour, picture);
    lines.blend_into(picture, style.colour);
    names.push_back({style.colour, style.name});
  }
  return names;
}

}  // namespace

Result<Picture> draw_preview(const HeightField& field, const Mesh& mesh, const PreviewOptions& options) {
  SCARP_RETURN_IF_ERROR(grid::check_size(field));
  if (field.frame.space) return fail(ErrorKind::kUsage, "a preview shows a map: the field's frame is in space");
  const int side = std::max(options.max_side, 1);
  draw::Ground ground = draw::ground_of(field.frame, field.cols, field.rows);
  const bool has_metres =
      options.cell[0] > 0 && options.cell[1] > 0 && std::isfinite(options.cell[0] / options.cell[1]);
  if (has_metres) {
    ground.step_x = options.cell[0];
    ground.step_y = options.cell[1];
  }
  constexpr double kSteepest = 8;  // cells of another shape are not drawn to scale
  const double aspect = std::clamp(ground.step_x / ground.step_y, 1 / kSteepest, kSteepest);
  const int below = draw::legend_height(side);
  const auto [width, height] = draw::map_size(field.cols, field.rows, aspect, {side, side - below}, kWantedPreview);

  SCARP_TRY(const Relief& relief, reduce(field, std::min(width, field.cols), std::min(height, field.rows)));
  const draw::Shaded shaded = draw::shade(relief, ground, field.cols, field.rows);
  Picture picture = draw::blank(width, height + draw::legend_height(width));
  enlarge(relief, shaded.colours, width, height, picture);
  const MapPlace place{static_cast<double>(width) / field.cols, static_cast<double>(height) / field.rows};
  draw_mesh(field, mesh, place, height, picture);
  draw::Legend legend{has_metres ? ground.step_x * field.cols / width : 0, shaded.tints, options.unit,
                      draw_marks(options.marks, place, height, picture)};
  if (picture.height > height) draw::draw_legend(picture, height, legend);
  return picture;
}

}  // namespace scarp
