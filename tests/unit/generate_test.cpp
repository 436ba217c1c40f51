// Synthetic fields: their shapes, their bounds, and the same bytes on every machine.
#include "grid/generate.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <cstring>
#include <utility>

#include "scarp/simplify.h"

namespace scarp {
namespace {

OwnedHeightField make(grid::FieldStyle style, int cols = 256, int rows = 256, std::uint64_t seed = 0) {
  auto field = grid::generate_field(style, cols, rows, seed);
  EXPECT_TRUE(field);
  return field ? std::move(*field) : OwnedHeightField{};
}

float at(const OwnedHeightField& field, int x, int y) {
  return field
      .samples[static_cast<std::size_t>(y) * static_cast<std::size_t>(field.cols) + static_cast<std::size_t>(x)];
}

/// FNV-1a over the bits of the samples.
std::uint64_t checksum(const OwnedHeightField& field) {
  std::uint64_t h = 0xcbf29ce484222325u;
  for (const float z : field.samples) {
    std::uint32_t bits;
    std::memcpy(&bits, &z, sizeof bits);
    for (int k = 0; k < 4; ++k) h = (h ^ (bits >> (8 * k) & 255)) * 0x100000001b3u;
  }
  return h;
}

constexpr grid::FieldStyle kWhole[] = {grid::FieldStyle::kCliff,
                                       grid::FieldStyle::kStep,
                                       grid::FieldStyle::kSharpStep,
                                       grid::FieldStyle::kDiagonalStep,
                                       grid::FieldStyle::kSharpDiagonalStep,
                                       grid::FieldStyle::kParabola,
                                       grid::FieldStyle::kParaboloid,
                                       grid::FieldStyle::kScaledParaboloid,
                                       grid::FieldStyle::kPyramid,
                                       grid::FieldStyle::kDiagonalPyramid};

TEST(Generate, FindsStylesByNameAndLetter) {
  const auto& names = grid::field_style_names();
  for (std::size_t k = 0; k < names.size(); ++k)
    EXPECT_EQ(grid::find_field_style(names[k]), static_cast<grid::FieldStyle>(k)) << names[k];
  EXPECT_EQ(grid::find_field_style("X"), grid::FieldStyle::kSharpStep);
  EXPECT_EQ(grid::find_field_style("x"), grid::FieldStyle::kStep);
  EXPECT_EQ(grid::find_field_style("P"), grid::FieldStyle::kScaledParaboloid);
  for (const char* unknown : {"", "z", "hills", "xx", "Cliff"})
    EXPECT_FALSE(grid::find_field_style(unknown)) << unknown;
  EXPECT_FALSE(grid::find_field_style(std::string(1, '\0')));
}

TEST(Generate, HeightsAreWholeAndNotNegative) {
  for (const grid::FieldStyle style : kWhole) {
    const OwnedHeightField field = make(style, 97, 131);
    for (const float z : field.samples) {
      ASSERT_GE(z, 0) << field.info.path;
      ASSERT_EQ(z, std::floor(z)) << field.info.path;
    }
    EXPECT_EQ(field.info.valid, 97u * 131u);
    EXPECT_EQ(height_range(field).max, field.info.max);
  }
}

TEST(Generate, StepsAreTheTangentThatTheyClaim) {
  for (const auto& [style, parts] : {std::pair{grid::FieldStyle::kStep, 8.0}, {grid::FieldStyle::kSharpStep, 64.0}}) {
    const OwnedHeightField field = make(style, 300, 3);
    for (int x = 0; x < 300; ++x) {
      const double s = static_cast<double>(static_cast<float>((x - 150) / (300 / parts)));
      const double exact = 1000 * (1 + std::tanh(s));
      EXPECT_LE(at(field, x, 1), exact + 1e-9);
      EXPECT_GT(at(field, x, 1), exact - 1 - 1e-9);
      EXPECT_EQ(at(field, x, 0), at(field, x, 2));
    }
    EXPECT_EQ(at(field, 150, 0), 1000);
  }
  const OwnedHeightField diagonal = make(grid::FieldStyle::kDiagonalStep, 64, 64);
  for (int k = 0; k < 64; ++k) EXPECT_EQ(at(diagonal, k, 63 - k), at(diagonal, 0, 63));
}

TEST(Generate, RoundShapesAreSymmetric) {
  for (const grid::FieldStyle style : {grid::FieldStyle::kParaboloid, grid::FieldStyle::kScaledParaboloid}) {
    const OwnedHeightField field = make(style, 101, 101);
    for (int y = 0; y < 101; ++y) {
      for (int x = 0; x < 101; ++x) {
        ASSERT_EQ(at(field, x, y), at(field, 100 - x, y));
        ASSERT_EQ(at(field, x, y), at(field, y, x));
      }
    }
    EXPECT_EQ(field.info.min, 0);
  }
  EXPECT_EQ(make(grid::FieldStyle::kParaboloid).info.max, 32768);
  EXPECT_EQ(make(grid::FieldStyle::kScaledParaboloid).info.max, 32767);
}

TEST(Generate, FractalsAreTheirSeeds) {
  const OwnedHeightField field = make(grid::FieldStyle::kFractal, 120, 90, 7);
  EXPECT_EQ(field.info.min, 0);
  EXPECT_EQ(field.info.max, 1000);
  EXPECT_EQ(field.samples, make(grid::FieldStyle::kFractal, 120, 90, 7).samples);
  EXPECT_NE(field.samples, make(grid::FieldStyle::kFractal, 120, 90, 8).samples);
  EXPECT_EQ(make(grid::FieldStyle::kCliff, 9, 9, 1).samples, make(grid::FieldStyle::kCliff, 9, 9, 2).samples);
  const OwnedHeightField smallest = make(grid::FieldStyle::kFractal, 2, 2, 3);
  for (const float z : smallest.samples) EXPECT_TRUE(std::isfinite(z));
}

TEST(Generate, SmoothFieldsBendLittle) {
  const int side = 256;
  const OwnedHeightField field = make(grid::FieldStyle::kSmooth, side, side, 7);
  EXPECT_EQ(field.info.min, 0);
  EXPECT_EQ(field.info.max, 1000);
  EXPECT_NE(field.samples, make(grid::FieldStyle::kSmooth, side, side, 8).samples);
  const auto at = [&](int x, int y) { return field.samples[static_cast<std::size_t>(y * side + x)]; };
  float bend = 0;
  for (int y = 1; y < side - 1; ++y) {
    for (int x = 1; x < side - 1; ++x) {
      bend = std::max(bend, std::abs(at(x - 1, y) - 2 * at(x, y) + at(x + 1, y)));
      bend = std::max(bend, std::abs(at(x, y - 1) - 2 * at(x, y) + at(x, y + 1)));
    }
  }
  EXPECT_GT(bend, 1);
  EXPECT_LT(bend, 20);  // 64 waves in phase would have a curvature of (2π 8 / 256)² of the half relief, 19
}

TEST(Generate, RefusesSizesThatCannotBe) {
  for (const auto& [cols, rows] : {std::pair{1, 10}, {10, 1}, {0, 0}, {-5, 8}, {65537, 2}, {65536, 65536}}) {
    const auto field = grid::generate_field(grid::FieldStyle::kCliff, cols, rows);
    ASSERT_FALSE(field) << cols << " x " << rows;
    EXPECT_EQ(field.error().kind, ErrorKind::kUsage);
  }
}

/// These values were computed once on x86-64; other machines and compilers must agree.
TEST(Generate, AreTheSameOnEveryMachine) {
  const std::uint64_t expected[] = {0x07236e676c5752e5u, 0x7a4a2cde17981db5u, 0x153178116f503a65u, 0xdc2607a9a18ca2e0u,
                                    0xe6de102790d4bbbdu, 0xafa32ac9357cab95u, 0x6f19763335c95155u, 0x21337109063ce584u,
                                    0x6fd129f7fa35f9fbu, 0x553c4ef794f735c1u, 0x7e63706db34d38a9u, 0xd5bada3e5a7b5b0au};
  for (std::size_t k = 0; k < grid::field_style_names().size(); ++k)
    EXPECT_EQ(checksum(make(static_cast<grid::FieldStyle>(k), 256, 200, 42)), expected[k])
        << grid::field_style_names()[k];
}

/// Max errors that Scape's Delaunay reached on genstm's fields of 256 x 256 with 200 vertices. The many ties of such
/// regular fields determine the rest.
TEST(Generate, FieldsAreGenstms) {
  const std::pair<grid::FieldStyle, double> reached[] = {
      {grid::FieldStyle::kParabola, 2.34},         {grid::FieldStyle::kStep, 14.4},
      {grid::FieldStyle::kSharpStep, 81.4},        {grid::FieldStyle::kDiagonalStep, 41.4},
      {grid::FieldStyle::kSharpDiagonalStep, 163}, {grid::FieldStyle::kCliff, 967},
      {grid::FieldStyle::kParaboloid, 256}};
  for (const auto& [style, scape] : reached) {
    const OwnedHeightField field = make(style);
    auto refiner = Refiner::create(field);
    ASSERT_TRUE(refiner);
    while (refiner->vertex_count() < 200 && refiner->insert_worst()) {
    }
    EXPECT_LE(refiner->max_error(), 1.2 * scape) << field.info.path;
    EXPECT_GE(refiner->max_error(), 0.6 * scape) << field.info.path;
  }
  for (const grid::FieldStyle style : {grid::FieldStyle::kPyramid, grid::FieldStyle::kDiagonalPyramid}) {
    const OwnedHeightField field = make(style);
    auto refiner = Refiner::create(field);
    ASSERT_TRUE(refiner);
    while (refiner->insert_worst()) {
    }
    EXPECT_EQ(refiner->max_error(), 0);
    EXPECT_LE(refiner->vertex_count(), 9u) << field.info.path;
  }
}

}  // namespace
}  // namespace scarp
