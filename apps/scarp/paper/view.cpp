#include "paper/view.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <vector>

#include "scarp/frame.h"

namespace scarp::paper {
namespace {

using Vector = std::array<double, 3>;

constexpr int kFine = 3;  ///< rows and columns of drawing in a pixel
constexpr int kMargin = 6;
constexpr double kGround = 235, kInk = 20, kInkCover = 0.8, kAmbient = 0.24;  ///< greys
constexpr Vector kToLight{-0.64, 0.24, 0.729931503635786};                    ///< right, away and up

Vector subtract(const Vector& a, const Vector& b) { return {a[0] - b[0], a[1] - b[1], a[2] - b[2]}; }
double dot(const Vector& a, const Vector& b) { return a[0] * b[0] + a[1] * b[1] + a[2] * b[2]; }
Vector cross(const Vector& a, const Vector& b) {
  return {a[1] * b[2] - a[2] * b[1], a[2] * b[0] - a[0] * b[2], a[0] * b[1] - a[1] * b[0]};
}

double sample_of(const OwnedHeightField& field, int col, int row) {
  return field
      .samples[static_cast<std::size_t>(row) * static_cast<std::size_t>(field.cols) + static_cast<std::size_t>(col)];
}

/// From a position to the drawing: right, down, and how far away.
class Camera {
 public:
  Camera(const OwnedHeightField& field, const View& view) : view_(view) {
    const auto first = field.frame.apply_affine(0, 0), last = field.frame.apply_affine(field.cols - 1, field.rows - 1);
    const double longer = std::max(std::abs(last[0] - first[0]), std::abs(last[1] - first[1]));
    const double relief = field.info.max - field.info.min;
    z_scale_ = relief > 0 ? view.relief * longer / relief : 1;
    Vector low{1e300, 1e300, 0}, high{-1e300, -1e300, 0};
    for (int row = 0; row < field.rows; ++row) {
      for (int col = 0; col < field.cols; ++col) {
        const auto [x, y] = field.frame.apply_affine(col, row);
        const Vector at = turn(scale({x, y, sample_of(field, col, row)}));
        for (std::size_t k = 0; k < 2; ++k) {
          low[k] = std::min(low[k], at[k]);
          high[k] = std::max(high[k], at[k]);
        }
      }
    }
    factor_ = kFine * (view.width - 2 * kMargin) / (high[0] - low[0]);
    shift_ = {kFine * kMargin - factor_ * low[0], kFine * kMargin - factor_ * low[1]};
    width_ = kFine * view.width;
    height_ = kFine * (static_cast<int>(std::ceil(factor_ * (high[1] - low[1]) / kFine)) + 2 * kMargin);
  }

  int width() const { return width_; }
  int height() const { return height_; }
  /// Equal lengths in all directions.
  Vector scale(const Vector& p) const { return {p[0], p[1], p[2] * z_scale_}; }
  /// How bright a face with that normal is, 0 to 1.
  double light(const Vector& normal) const {
    const auto [c, s] = view_.turn;
    const Vector turned{c * normal[0] - s * normal[1], s * normal[0] + c * normal[1], normal[2]};
    return kAmbient + (1 - kAmbient) * std::max(0.0, dot(turned, kToLight) / std::sqrt(dot(normal, normal)));
  }
  Vector project(const Vector& scaled) const {
    const Vector at = turn(scaled);
    return {factor_ * at[0] + shift_[0], factor_ * at[1] + shift_[1], at[2]};
  }

 private:
  Vector turn(const Vector& p) const {
    const auto [c, s] = view_.turn;
    const auto [forward, up] = view_.up;
    const double right = c * p[0] - s * p[1], away = s * p[0] + c * p[1];
    return {right, -(up * away + forward * p[2]), forward * away - up * p[2]};
  }

  View view_;
  double z_scale_ = 1, factor_ = 1;
  std::array<double, 2> shift_{};
  int width_ = 0, height_ = 0;
};

class Drawing {
 public:
  Drawing(int width, int height)
      : width_(width),
        height_(height),
        depths_(static_cast<std::size_t>(width) * static_cast<std::size_t>(height),
                std::numeric_limits<double>::infinity()),
        greys_(depths_.size(), 255) {}

  void add_triangle(const std::array<Vector, 3>& p, double grey, double line_width) {
    const double area = part(p[0], p[1], p[2][0], p[2][1]);
    if (!(area < 0)) return;  // seen from behind: rows go down
    std::array<double, 3> lengths{};
    for (std::size_t k = 0; k < 3; ++k) {
      const Vector &a = p[(k + 1) % 3], &b = p[(k + 2) % 3];
      lengths[k] = std::sqrt((b[0] - a[0]) * (b[0] - a[0]) + (b[1] - a[1]) * (b[1] - a[1]));
    }
    const auto [left, right] = std::minmax({p[0][0], p[1][0], p[2][0]});
    const auto [top, bottom] = std::minmax({p[0][1], p[1][1], p[2][1]});
    const int x0 = std::max(0, static_cast<int>(std::ceil(left))),
              x1 = std::min(width_ - 1, static_cast<int>(std::floor(right)));
    const int y0 = std::max(0, static_cast<int>(std::ceil(top))),
              y1 = std::min(height_ - 1, static_cast<int>(std::floor(bottom)));
    for (int y = y0; y <= y1; ++y) {
      for (int x = x0; x <= x1; ++x) {
        std::array<double, 3> parts{};
        for (std::size_t k = 0; k < 3; ++k) parts[k] = part(p[(k + 1) % 3], p[(k + 2) % 3], x, y);
        if (parts[0] > 0 || parts[1] > 0 || parts[2] > 0) continue;
        const double depth = (parts[0] * p[0][2] + parts[1] * p[1][2] + parts[2] * p[2][2]) / area;
        const std::size_t at =
            static_cast<std::size_t>(y) * static_cast<std::size_t>(width_) + static_cast<std::size_t>(x);
        if (!(depth < depths_[at])) continue;
        depths_[at] = depth;
        bool on_line = false;
        for (std::size_t k = 0; k < 3; ++k) on_line = on_line || -parts[k] < line_width / 2 * lengths[k];
        greys_[at] = on_line ? grey + kInkCover * (kInk - grey) : grey;
      }
    }
  }

  Picture reduce() const {
    Picture picture{width_ / kFine, height_ / kFine, {}};
    for (int y = 0; y < picture.height; ++y) {
      for (int x = 0; x < picture.width; ++x) {
        double sum = 0;
        for (int j = 0; j < kFine; ++j) {
          for (int i = 0; i < kFine; ++i)
            sum += greys_[static_cast<std::size_t>(kFine * y + j) * static_cast<std::size_t>(width_) +
                          static_cast<std::size_t>(kFine * x + i)];
        }
        picture.rgb.insert(picture.rgb.end(), 3, static_cast<std::uint8_t>(sum / (kFine * kFine) + 0.5));
      }
    }
    return picture;
  }

 private:
  static double part(const Vector& a, const Vector& b, double x, double y) {
    return (b[0] - a[0]) * (y - a[1]) - (b[1] - a[1]) * (x - a[0]);
  }

  int width_, height_;
  std::vector<double> depths_;
  std::vector<double> greys_;
};

}  // namespace

Picture draw_view(const OwnedHeightField& field, const Mesh& mesh, const View& view) {
  const Camera camera(field, view);
  Drawing drawing(camera.width(), camera.height());
  for (std::size_t t = 0; t < mesh.triangle_count(); ++t) {
    std::array<Vector, 3> scaled, projected;
    for (std::size_t k = 0; k < 3; ++k) {
      scaled[k] = camera.scale(mesh.vertex(mesh.triangles[3 * t + k]));
      projected[k] = camera.project(scaled[k]);
    }
    const Vector normal = cross(subtract(scaled[1], scaled[0]), subtract(scaled[2], scaled[0]));
    drawing.add_triangle(projected, kGround * camera.light(normal), kFine * view.line_width);
  }
  return drawing.reduce();
}

Mesh make_full_mesh(const OwnedHeightField& field) {
  Mesh mesh;
  const auto cols = static_cast<std::uint32_t>(field.cols), rows = static_cast<std::uint32_t>(field.rows);
  for (std::uint32_t row = 0; row < rows; ++row) {
    for (std::uint32_t col = 0; col < cols; ++col) {
      const auto at = field.frame.apply_affine(col, row);
      mesh.positions.insert(mesh.positions.end(), {at[0], at[1], field.samples[std::size_t{row} * cols + col]});
      if (row == 0 || col == 0) continue;
      const std::uint32_t d = row * cols + col, c = d - 1, b = d - cols, a = b - 1;
      mesh.triangles.insert(mesh.triangles.end(), {a, c, b, b, c, d});
    }
  }
  return mesh;
}

}  // namespace scarp::paper
