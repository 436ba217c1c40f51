// Normals of all samples as an image.
#include <algorithm>
#include <array>
#include <cmath>
#include <utility>
#include <vector>

#include "base/caught.h"
#include "pieces/normals.h"
#include "scarp/picture.h"

namespace scarp {
namespace {

/// The pixels of a sample along one axis: one or two, since samples are no larger than pixels.
struct Share {
  int pixel = 0;
  double here = 1;  ///< share of the first pixel; the next one has the rest
};

Share share_of(int sample, int samples, int pixels) {
  const std::int64_t begin = std::int64_t{sample} * pixels, end = begin + pixels;  // in units of a pixel / samples
  const std::int64_t pixel = begin / samples, border = (pixel + 1) * samples;
  if (end <= border) return {static_cast<int>(pixel), 1};
  return {static_cast<int>(pixel), static_cast<double>(border - begin) / pixels};
}

/// Sums of normals in a row of pixels.
using Sums = std::vector<std::array<double, 3>>;

void paint_row(const Sums& sums, std::vector<std::uint8_t>& rgb) {
  for (std::array<double, 3> n : sums) {
    const double length = std::sqrt(n[0] * n[0] + n[1] * n[1] + n[2] * n[2]);
    if (!(length > 0)) n = {0, 0, 1};
    for (const double component : n) {
      const double unit = length > 0 ? component / length : component;
      rgb.push_back(static_cast<std::uint8_t>(std::floor((unit + 1) / 2 * 255 + 0.5)));
    }
  }
}

class NormalMap {
 public:
  NormalMap(const HeightField& field, int width, int height)
      : field_(field), width_(width), sums_(static_cast<std::size_t>(width)), below_(sums_.size()) {
    picture.width = width;
    picture.height = height;
  }

  Picture picture;

  void add(const grid::RowRange& rows, int y) {
    const std::vector<float> normals = pieces::row_normals(rows, field_, y);
    const Share row = share_of(y, field_.rows, picture.height);
    for (; row_ < row.pixel; ++row_) finish_row();
    for (int x = 0; x < field_.cols; ++x) {
      const float* n = &normals[3 * static_cast<std::size_t>(x)];
      if (std::isnan(n[0])) continue;
      const Share col = share_of(x, field_.cols, width_);
      add_to(sums_, col, row.here, n);
      add_to(below_, col, 1 - row.here, n);
    }
  }

  void finish() {
    while (row_++ < picture.height) finish_row();
  }

 private:
  static void add_to(Sums& sums, const Share& col, double weight, const float* n) {
    if (weight <= 0) return;
    for (std::size_t k = 0; k < 3; ++k) {
      sums[static_cast<std::size_t>(col.pixel)][k] += weight * col.here * double{n[k]};
      if (col.here < 1) sums[static_cast<std::size_t>(col.pixel) + 1][k] += weight * (1 - col.here) * double{n[k]};
    }
  }

  void finish_row() {
    paint_row(sums_, picture.rgb);
    std::swap(sums_, below_);
    std::fill(below_.begin(), below_.end(), std::array<double, 3>{});
  }

  const HeightField& field_;
  int width_, row_ = 0;
  Sums sums_, below_;  // sums of the current and the next row of pixels
};

}  // namespace

Result<Picture> draw_normal_map(const HeightField& field, int side) try {
  if (field.frame.space) return fail(ErrorKind::kUsage, "a normal map is of a map: the field's frame is in space");
  if (side < 1) return fail(ErrorKind::kUsage, "a normal map has at least one pixel on its longer side");
  const int longer = std::max(field.cols, field.rows), most = std::min(side, longer);
  const auto pixels = [&](int samples) {
    return static_cast<int>(
        std::max<std::int64_t>(1, (2 * std::int64_t{samples} * most + longer) / (2 * std::int64_t{longer})));
  };
  NormalMap map(field, pixels(field.cols), pixels(field.rows));
  const auto swept = grid::sweep_rows(field, 1, [&](const grid::RowRange& rows) -> Result<void> {
    for (int y = rows.begin; y < rows.end; ++y) map.add(rows, y);
    return {};
  });
  SCARP_RETURN_IF_ERROR(swept);
  map.finish();
  return std::move(map.picture);
} catch (...) {
  return caught(ErrorKind::kInput, "draw the normal map");
}

}  // namespace scarp
