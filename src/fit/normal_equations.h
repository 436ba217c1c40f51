// The Gauss–Newton system of a vertex step (vertex_step.h).
#pragma once

#include <array>
#include <cmath>
#include <cstddef>

#include "fit/triangle_error.h"

namespace scarp::fit {

/// Σ A u uᵀ d = −Σ B u for d = (z, x, y).
class NormalEquations {
 public:
  using Row = std::array<double, 3>;

  void add(const TriangleError::Pull& pull, const Row& u) {
    for (std::size_t i = 0; i < 3; ++i) {
      right_[i] -= pull.push * u[i];
      for (std::size_t j = 0; j < 3; ++j) left_[i][j] += pull.stiffness * u[i] * u[j];
    }
  }
  /// Keeps the system solvable where the samples do not determine a direction.
  void damp() {
    constexpr double kPlaces = 1e-3, kHeights = 1e-4;
    const double damping = kPlaces * (left_[1][1] + left_[2][2]);
    left_[0][0] *= 1 + kHeights;
    left_[1][1] += damping;
    left_[2][2] += damping;
  }
  void fix(std::size_t k) {
    for (std::size_t i = 0; i < 3; ++i) left_[k][i] = left_[i][k] = 0;
    left_[k][k] = 1;
    right_[k] = 0;
  }
  /// By Cramer's rule; zeros if there is no solution.
  Row solve() const {
    const double det = determinant(left_);
    if (!(std::abs(det) > 0)) return {};
    Row solution;
    for (std::size_t k = 0; k < 3; ++k) {
      auto replaced = left_;
      for (std::size_t i = 0; i < 3; ++i) replaced[i][k] = right_[i];
      solution[k] = determinant(replaced) / det;
    }
    return solution;
  }

 private:
  using Matrix = std::array<Row, 3>;
  static double determinant(const Matrix& m) {
    return m[0][0] * (m[1][1] * m[2][2] - m[1][2] * m[2][1]) - m[0][1] * (m[1][0] * m[2][2] - m[1][2] * m[2][0]) +
           m[0][2] * (m[1][0] * m[2][1] - m[1][1] * m[2][0]);
  }

  Matrix left_{};
  Row right_{};
};

}  // namespace scarp::fit
