#include <gtest/gtest.h>
#include <rapidcheck.h>

#include <cmath>
#include <numbers>

#include "grid/local_frame.h"
#include "scarp/height_field.h"

namespace scarp {
namespace {

constexpr grid::Ellipsoid kWgs84{6378137, 298.257223563};
constexpr double kDegree = std::numbers::pi / 180;

bool is_float32(double v) { return static_cast<double>(static_cast<float>(v)) == v; }

/// A projection that is valid only in the right half plane.
class HalfPlane final : public PointTransform {
 public:
  bool apply(std::span<double> x, std::span<double> y) const override {
    bool all = true;
    for (std::size_t k = 0; k < x.size(); ++k) {
      if (x[k] < 0) x[k] = y[k] = std::nan("");
      all = all && !std::isnan(x[k]);
    }
    return all;
  }
};

TEST(Frame, GridFrameHasItsLastRowAtZero) {
  const Frame frame = grid_frame(5);
  EXPECT_EQ(frame.apply_affine(0, 4), (std::array<double, 2>{0, 0}));
  EXPECT_EQ(frame.apply_affine(3, 0), (std::array<double, 2>{3, 4}));
  EXPECT_EQ(frame_origin(frame, 7, 5), (std::array<double, 2>{3, 2}));
  EXPECT_TRUE(offsets_are_exact(frame, 7, 5));
  EXPECT_TRUE(frame.is_affine());
}

TEST(Frame, OriginOfAPointWithoutImageIsNaN) {
  Frame frame = grid_frame(4);
  frame.transform = std::make_shared<HalfPlane>();
  EXPECT_EQ(frame_origin(frame, 4, 4)[0], 2);
  frame.affine[0] = -100;
  EXPECT_TRUE(std::isnan(frame_origin(frame, 4, 4)[0]));
  EXPECT_TRUE(std::isnan(frame_origin(frame, 4, 4)[1]));
  EXPECT_FALSE(offsets_are_exact(frame, 4, 4)) << "a frame that is not affine is never exact";
}

TEST(Frame, ExactnessKnowsCellSizes) {
  Frame frame;
  frame.affine = {500000.5, 30, 0, 4100000.5, 0, -30};
  EXPECT_TRUE(offsets_are_exact(frame, 1000, 2000));
  frame.affine = {394268.6554537736, 0.25, 0, 3798272.8276283755, 0, -0.25};
  EXPECT_TRUE(offsets_are_exact(frame, 1000, 2000)) << "the constant terms play no part";
  frame.affine = {0, 0.1, 0, 0, 0, -1};
  EXPECT_FALSE(offsets_are_exact(frame, 10, 10));
  frame.affine = {0, 1, 0, 0, 0, -0.1};
  EXPECT_FALSE(offsets_are_exact(frame, 10, 10));
  frame.affine = {0, 1 + 0x1p-20, 0, 0, 0, -1};
  EXPECT_TRUE(offsets_are_exact(frame, 8, 8)) << "21 bits of cell and 3 of index";
  EXPECT_FALSE(offsets_are_exact(frame, 2000, 8)) << "21 bits of cell and 10 of index";
  frame.affine = {0, 1, 0x1p-24, 0, 0, -1};
  EXPECT_FALSE(offsets_are_exact(frame, 8, 8)) << "each term is a float32, their sum is not";
  frame.affine = {0, 0.5, 0.25, 0, 0.25, -0.5};
  EXPECT_TRUE(offsets_are_exact(frame, 1000, 1000));
  frame.affine = {0, std::nan(""), 0, 0, 0, -1};
  EXPECT_FALSE(offsets_are_exact(frame, 8, 8));
}

TEST(LocalFrame, MetresPerDegreeAreTheTextbooks) {
  // Lengths of a degree on WGS 84 from tables.
  const auto equator = grid::metres_per_radian(kWgs84, 0);
  EXPECT_NEAR(equator.east * kDegree, 111319.49, 0.01);
  EXPECT_NEAR(equator.north * kDegree, 110574.28, 0.01);
  const auto middle = grid::metres_per_radian(kWgs84, 45 * kDegree);
  EXPECT_NEAR(middle.east * kDegree, 78846.835, 0.01);
  EXPECT_NEAR(middle.north * kDegree, 111131.78, 0.01);
  const auto moon = grid::metres_per_radian({1737400, 0}, 60 * kDegree);
  EXPECT_NEAR(moon.north, 1737400, 1e-6);
  EXPECT_NEAR(moon.east, 1737400 * 0.5, 1e-6);
}

TEST(LocalFrame, EverySampleIsExactlyAFloat32) {
  EXPECT_TRUE(rc::check("offsets of a centred affine map are float32, and close to what was asked for", [] {
    const int cols = *rc::gen::inRange(2, 3000), rows = *rc::gen::inRange(2, 3000);
    const double cell_x = *rc::gen::inRange(1, 100000000) * 1e-5, cell_y = *rc::gen::inRange(1, 100000000) * 1e-5;
    const double turn = *rc::gen::element(0.0, 0.0, 0.3, 1.5, 3.0);
    const std::array<double, 4> linear{cell_x * std::cos(turn), cell_y * std::sin(turn), cell_x * std::sin(turn),
                                       -cell_y * std::cos(turn)};
    Frame frame;
    frame.affine = grid::centred_affine(linear, cols, rows);
    RC_ASSERT(frame_origin(frame, cols, rows) == (std::array<double, 2>{0, 0}));
    RC_ASSERT(offsets_are_exact(frame, cols, rows));
    for (int k = 0; k < 200; ++k) {
      const int col = *rc::gen::inRange(0, cols), row = *rc::gen::inRange(0, rows);
      const auto at = frame.apply_affine(col, row);
      RC_ASSERT(is_float32(at[0]) && is_float32(at[1]));
      const double x = linear[0] * (col - cols / 2) + linear[1] * (row - rows / 2);
      const double reach_x = std::abs(linear[0]) * cols + std::abs(linear[1]) * rows;
      RC_ASSERT(std::abs(at[0] - x) <= reach_x * (cols + rows) * 0x1p-24);
    }
  }));
}

TEST(LocalFrame, IsMadeOfDegreesAlone) {
  // One arc second at 36.5 degrees north, 3601 x 1801 samples.
  const double second = 1.0 / 3600;
  const auto frame = frame_of_degrees({-84, second, 0, 37, 0, -second}, 3601, 1801);
  ASSERT_TRUE(frame) << frame.error().message;
  EXPECT_EQ(frame->kind, Frame::Kind::kLocal);
  EXPECT_TRUE(frame->is_affine());
  EXPECT_EQ(frame->apply_affine(1800, 900), (std::array<double, 2>{0, 0}));
  EXPECT_TRUE(offsets_are_exact(*frame, 3601, 1801));
  const auto metres = metres_of_unit(37 - 900 * second);
  EXPECT_NEAR(frame->affine[1], metres[0] * second, 0.001 * metres[0] * second);
  EXPECT_NEAR(frame->affine[5], -metres[1] * second, 0.001 * metres[1] * second);
  EXPECT_NEAR(metres_of_unit(0)[0], 111319.49, 0.01);
  EXPECT_EQ(metres_of_unit(90), (std::array<double, 2>{0, 0}));

  for (const std::array<double, 6>& bad : {std::array<double, 6>{0, 1, 0, 90, 0, 0.001},
                                           {0, 1, 0, 0, 1, 0},
                                           {0, std::nan(""), 0, 0, 0, 1},
                                           {0, 1e-30, 0, 0, 0, 0}}) {
    const auto none = frame_of_degrees(bad, 10, 10);
    ASSERT_FALSE(none);
    EXPECT_EQ(none.error().kind, ErrorKind::kUsage);
  }
  EXPECT_FALSE(frame_of_degrees({0, 1, 0, 0, 0, 1}, 0, 10));
}

TEST(LocalFrame, KeepsCellsThatAreExactAlready) {
  EXPECT_EQ(grid::centred_affine({30, 0, 0, -30}, 1197, 643), (std::array<double, 6>{-17940, 30, 0, 9630, 0, -30}));
}

}  // namespace
}  // namespace scarp
