// Random and synthetic rasters for laws and oracles.
#pragma once

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <limits>
#include <random>
#include <vector>

#include "grid/raster.h"
#include "scarp/height_field.h"

namespace scarp::testing {

struct Field {
  std::int32_t cols = 0, rows = 0;
  std::vector<float> samples;
  grid::Raster raster() const { return {samples.data(), cols, rows}; }
  HeightField view() const { return {samples.data(), cols, rows, std::nullopt, grid_frame(rows), 0}; }
};

enum class Relief { kTies, kFlat, kCliff, kReal, kRidges };

/// Heights with the difficulties of real rasters: few distinct values (ties), plateaus, cliffs, arbitrary floats. A
/// share of `nodata_share` of the samples is NaN, in blobs.
inline Field random_field(std::uint32_t seed, std::int32_t cols, std::int32_t rows, Relief relief,
                          double nodata_share = 0) {
  std::mt19937 random(seed);
  const auto uniform = [&] { return static_cast<double>(random()) / 4294967296.0; };
  Field field{cols, rows, std::vector<float>(static_cast<std::size_t>(cols) * static_cast<std::size_t>(rows))};
  for (std::int32_t y = 0; y < rows; ++y) {
    for (std::int32_t x = 0; x < cols; ++x) {
      float& z =
          field.samples[static_cast<std::size_t>(y) * static_cast<std::size_t>(cols) + static_cast<std::size_t>(x)];
      switch (relief) {
        case Relief::kTies:
          z = static_cast<float>(random() % 4);
          break;
        case Relief::kFlat:
          z = random() % 12 == 0 ? 5.0f : 2.0f;
          break;
        case Relief::kCliff:
          z = x * 3 > y * 2 + 4 ? 1000.0f : static_cast<float>(random() % 3);
          break;
        case Relief::kReal:
          z = static_cast<float>(uniform() * 100 - 50);
          break;
        case Relief::kRidges:
          z = static_cast<float>(40 * std::abs(std::sin(0.31 * x + 0.17 * y)) + 25 * std::cos(0.11 * x * y / 7.0) +
                                 uniform());
          break;
      }
    }
  }
  if (nodata_share > 0) {
    const auto blobs = static_cast<int>(1 + nodata_share * cols * rows / 6);
    for (int blob = 0; blob < blobs; ++blob) {
      const auto bx = static_cast<std::int32_t>(random() % static_cast<std::uint32_t>(cols));
      const auto by = static_cast<std::int32_t>(random() % static_cast<std::uint32_t>(rows));
      const auto w = static_cast<std::int32_t>(1 + random() % 3), h = static_cast<std::int32_t>(1 + random() % 3);
      for (std::int32_t y = by; y < std::min(by + h, rows); ++y) {
        for (std::int32_t x = bx; x < std::min(bx + w, cols); ++x)
          field.samples[static_cast<std::size_t>(y) * static_cast<std::size_t>(cols) + static_cast<std::size_t>(x)] =
              std::numeric_limits<float>::quiet_NaN();
      }
    }
  }
  return field;
}

/// Swaps columns and rows.
inline Field transposed(const Field& field) {
  Field turned{field.rows, field.cols, {}};
  for (int y = 0; y < field.cols; ++y)
    for (int x = 0; x < field.rows; ++x) turned.samples.push_back(field.raster().at({y, x}));
  return turned;
}

inline constexpr Relief kReliefs[] = {Relief::kTies, Relief::kFlat, Relief::kCliff, Relief::kReal, Relief::kRidges};

}  // namespace scarp::testing
