#include "draw/grid_positions.h"

#include <cmath>
#include <limits>

namespace scarp::draw {
namespace {

struct Points {
  std::vector<double> x, y;
};

Points images(const Frame& frame, const GridPositions& at, double col_shift, double row_shift) {
  Points out;
  for (std::size_t i = 0; i < at.cols.size(); ++i) {
    const auto [x, y] = frame.apply_affine(at.cols[i] + col_shift, at.rows[i] + row_shift);
    out.x.push_back(x);
    out.y.push_back(y);
  }
  if (frame.transform) frame.transform->apply(out.x, out.y);
  return out;
}

}  // namespace

GridPositions find_grid_positions(const Frame& frame, int cols, int rows, const Mesh& mesh) {
  const std::size_t count = mesh.vertex_count();
  GridPositions at{std::vector<double>(count, cols / 2.0), std::vector<double>(count, rows / 2.0)};
  // One step of Newton's method solves an affine frame; other frames start from the middle of the grid.
  const int rounds = frame.is_affine() ? 1 : 6;
  for (int round = 0; round < rounds; ++round) {
    const double step = 0.5;
    const Points here = images(frame, at, 0, 0), right = images(frame, at, step, 0), down = images(frame, at, 0, step);
    double farthest = 0;
    for (std::size_t i = 0; i < count; ++i) {
      const double cx = (right.x[i] - here.x[i]) / step, cy = (right.y[i] - here.y[i]) / step;
      const double rx = (down.x[i] - here.x[i]) / step, ry = (down.y[i] - here.y[i]) / step;
      const double det = cx * ry - cy * rx;
      const double dx = (mesh.origin[0] - here.x[i]) + mesh.positions[3 * i];
      const double dy = (mesh.origin[1] - here.y[i]) + mesh.positions[3 * i + 1];
      const double move_col = (ry * dx - rx * dy) / det, move_row = (cx * dy - cy * dx) / det;
      at.cols[i] += move_col;
      at.rows[i] += move_row;
      if (!std::isfinite(at.cols[i] + at.rows[i])) {
        at.cols[i] = at.rows[i] = std::numeric_limits<double>::quiet_NaN();
        continue;
      }
      farthest = std::max(farthest, std::abs(move_col) + std::abs(move_row));
    }
    if (farthest < 0.01) break;
  }
  return at;
}

std::array<double, 2> step_lengths(const Frame& frame, int cols, int rows) {
  const GridPositions middle{{cols / 2.0}, {rows / 2.0}};
  const Points here = images(frame, middle, 0, 0), right = images(frame, middle, 1, 0),
               down = images(frame, middle, 0, 1);
  return {std::hypot(right.x[0] - here.x[0], right.y[0] - here.y[0]),
          std::hypot(down.x[0] - here.x[0], down.y[0] - here.y[0])};
}

}  // namespace scarp::draw
