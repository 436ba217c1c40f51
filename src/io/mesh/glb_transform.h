// The transform of a glTF node.
#pragma once

#include <array>
#include <cmath>
#include <cstddef>

namespace scarp::io {

/// Columns of a 3×3 matrix and a translation, in glTF's axes.
struct Transform {
  double linear[3][3] = {{1, 0, 0}, {0, 1, 0}, {0, 0, 1}};  // [column][row]
  double translation[3] = {0, 0, 0};

  std::array<double, 3> apply_linear(const double p[3]) const {
    std::array<double, 3> q;
    for (std::size_t r = 0; r < 3; ++r) q[r] = linear[0][r] * p[0] + linear[1][r] * p[1] + linear[2][r] * p[2];
    return q;
  }
  /// Transforms a unit normal by the inverse transpose, whose columns are cross products of the columns.
  std::array<double, 3> apply_normal(const double n[3]) const {
    std::array<double, 3> q{};
    for (std::size_t c = 0; c < 3; ++c) {
      const double* a = linear[(c + 1) % 3];
      const double* b = linear[(c + 2) % 3];
      for (std::size_t r = 0; r < 3; ++r)
        q[r] += n[c] * (a[(r + 1) % 3] * b[(r + 2) % 3] - a[(r + 2) % 3] * b[(r + 1) % 3]);
    }
    const double length = std::sqrt(q[0] * q[0] + q[1] * q[1] + q[2] * q[2]);
    if (!(length > 0)) return {0, 1, 0};
    for (double& component : q) component /= determinant() < 0 ? -length : length;
    return q;
  }
  bool is_translation() const {
    for (int c = 0; c < 3; ++c) {
      for (int r = 0; r < 3; ++r) {
        if (linear[c][r] != (c == r ? 1.0 : 0.0)) return false;
      }
    }
    return true;
  }
  double determinant() const {
    const auto& m = linear;
    return m[0][0] * (m[1][1] * m[2][2] - m[2][1] * m[1][2]) - m[1][0] * (m[0][1] * m[2][2] - m[2][1] * m[0][2]) +
           m[2][0] * (m[0][1] * m[1][2] - m[1][1] * m[0][2]);
  }
};

inline Transform operator*(const Transform& outer, const Transform& inner) {
  Transform product;
  for (int c = 0; c < 3; ++c) {
    const auto column = outer.apply_linear(inner.linear[c]);
    for (std::size_t r = 0; r < 3; ++r) product.linear[c][r] = column[r];
  }
  const auto moved = outer.apply_linear(inner.translation);
  for (std::size_t r = 0; r < 3; ++r) product.translation[r] = moved[r] + outer.translation[r];
  return product;
}

}  // namespace scarp::io
