// Arbitrary lines over arbitrary rasters.
#pragma once

#include <rapidcheck.h>

#include <cmath>
#include <limits>
#include <random>

#include "laws/fields.h"
#include "scarp/lines.h"

namespace scarp::testing {

/// Arbitrary walks in the raster and beyond, some with heights near the raster's.
inline LineConstraints any_lines(const Field& field) {
  std::mt19937 random(*rc::gen::arbitrary<std::uint32_t>());
  const auto between = [&](double low, double high) {
    return low + (high - low) * (static_cast<double>(random()) / 4294967296.0);
  };
  LineConstraints constraints;
  constraints.affine = grid_frame(field.rows).affine;
  constraints.conflict = *rc::gen::element(LineConflict::kFirst, LineConflict::kMean, LineConflict::kHighest);
  const int count = *rc::gen::inRange(1, 6);
  const bool is_on_samples = *rc::gen::arbitrary<bool>();
  for (int k = 0; k < count; ++k) {
    Line line;
    line.name = "line";
    const bool is_hard = random() % 3 == 0;
    for (auto n = 2 + random() % 5; n > 0; --n) {
      const double reach = random() % 8 == 0 ? 100 : 0.5;
      double x = between(-reach, field.cols + reach), y = between(-reach, field.rows + reach);
      if (is_on_samples) x = std::round(x), y = std::round(y);
      line.points.push_back({x, y, is_hard ? between(-20, 60) : std::numeric_limits<double>::quiet_NaN()});
    }
    constraints.lines.push_back(line);
  }
  return constraints;
}

}  // namespace scarp::testing
