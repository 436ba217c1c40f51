// Height fields and meshes for the judge's tests.
#pragma once

#include <cmath>
#include <limits>
#include <random>
#include <vector>

#include "scarp/height_field.h"
#include "scarp/mesh.h"

namespace scarp::testing {

struct Terrain {
  std::vector<float> samples;
  int cols = 0, rows = 0;
  Frame frame;

  HeightField view() const { return {samples.data(), cols, rows, std::nullopt, frame, 0}; }
  float& at(int col, int row) { return samples[static_cast<std::size_t>(row * cols + col)]; }
};

inline Terrain wavy_terrain(int cols, int rows) {
  Terrain terrain{{}, cols, rows, grid_frame(rows)};
  for (int r = 0; r < rows; ++r) {
    for (int c = 0; c < cols; ++c) {
      terrain.samples.push_back(static_cast<float>(10 * std::sin(c * 0.7) * std::cos(r * 0.5) + 0.3 * c - 0.2 * r));
    }
  }
  return terrain;
}

inline Terrain random_terrain(int cols, int rows, double nodata_share, std::mt19937& random) {
  Terrain terrain{{}, cols, rows, grid_frame(rows)};
  std::uniform_real_distribution<double> unit(0, 1);
  for (int i = 0; i < cols * rows; ++i) {
    terrain.samples.push_back(unit(random) < nodata_share ? std::numeric_limits<float>::quiet_NaN()
                                                          : static_cast<float>(unit(random) * 100));
  }
  return terrain;
}

/// A vertex at a grid position of the terrain's frame, with a height.
inline void add_vertex(Mesh& mesh, const Frame& frame, double col, double row, double height) {
  const auto [x, y] = frame.apply_affine(col, row);
  mesh.positions.insert(mesh.positions.end(), {x - mesh.origin[0], y - mesh.origin[1], height - mesh.origin[2]});
}

/// All grid cells of side `step`, two triangles each, counter-clockwise from above. REQUIRES: cols − 1 and rows − 1 are
/// multiples of step; no nodata at vertices.
inline Mesh grid_mesh(const Terrain& terrain, int step) {
  Mesh mesh;
  const int nc = (terrain.cols - 1) / step + 1, nr = (terrain.rows - 1) / step + 1;
  for (int j = 0; j < nr; ++j) {
    for (int i = 0; i < nc; ++i) {
      add_vertex(mesh, terrain.frame, i * step, j * step,
                 terrain.samples[static_cast<std::size_t>(j * step * terrain.cols + i * step)]);
    }
  }
  const bool flip = terrain.frame.determinant() > 0;
  for (int j = 0; j + 1 < nr; ++j) {
    for (int i = 0; i + 1 < nc; ++i) {
      const auto a = static_cast<std::uint32_t>(j * nc + i), b = a + 1, c = a + static_cast<std::uint32_t>(nc),
                 d = c + 1;
      if (flip) {
        mesh.triangles.insert(mesh.triangles.end(), {a, b, c, b, d, c});
      } else {
        mesh.triangles.insert(mesh.triangles.end(), {a, c, b, b, c, d});
      }
    }
  }
  return mesh;
}

/// The frame's affine map as a transform without information about grids.
class AffineTransform : public PointTransform {
 public:
  explicit AffineTransform(const std::array<double, 6>& affine) : affine_(affine) {}
  bool apply(std::span<double> x, std::span<double> y) const override {
    for (std::size_t i = 0; i < x.size(); ++i) {
      const double c = x[i], r = y[i];
      x[i] = affine_[0] + affine_[1] * c + affine_[2] * r;
      y[i] = affine_[3] + affine_[4] * c + affine_[5] * r;
    }
    return true;
  }

 private:
  std::array<double, 6> affine_;
};

/// The same frame, disguised as one that is not affine.
inline Frame dress_up(const Frame& frame) {
  Frame dressed = frame;
  dressed.affine = {0, 1, 0, 0, 0, 1};
  dressed.transform = std::make_shared<AffineTransform>(frame.affine);
  return dressed;
}

}  // namespace scarp::testing
