// Laws of height datums: the built-in geoid equals PROJ's, and a grid's surface equals the textbook's.
#include <gtest/gtest.h>
#include <rapidcheck/gtest.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <utility>
#include <vector>

#include "io/globe_place.h"
#include "scarp/tile.h"

namespace scarp::geoid_laws_test {
namespace {

constexpr float kNone = std::numeric_limits<float>::quiet_NaN();

double height_at(const HeightZero& zero, double longitude, double latitude) {
  double height = 0;
  zero.find({&longitude, 1}, {&latitude, 1}, {&height, 1});
  return height;
}

/// PROJ's interpolation of its own EGM96 grid; null if the grid is not on this machine.
std::shared_ptr<const HeightZero> proj_egm96() {
  RasterInfo info;
  info.crs = "EPSG:4326";
  info.is_geographic = info.has_georeference = true;
  info.geotransform = {0, 1, 0, 10, 0, -1};
  info.vertical = "the heights of PROJ's grid";
  info.crs_with_heights = "+proj=longlat +datum=WGS84 +geoidgrids=egm96_15.gtx +vunits=m +no_defs +type=crs";
  const auto globe = io::place_on_globe(info, 10, 10, Datum(), "raster");
  return globe ? globe->zero : nullptr;
}

double any_degrees(int low, int high) { return *rc::gen::inRange(low * 100000, high * 100000 + 1) / 1e5; }

}  // namespace

TEST(Egm96, HasTheHeightsThatEverybodyKnows) {
  const auto geoid = egm96();
  EXPECT_NEAR(height_at(*geoid, 0, 90), 13.61, 0.005);
  EXPECT_NEAR(height_at(*geoid, 123, -90), -29.53, 0.005);
  // NGA's test points of EGM96, computed with all 360 degrees of the model; 15 minutes of arc smooth them.
  EXPECT_NEAR(height_at(*geoid, 269.7791550, 38.6281550), -31.628, 0.1);
  EXPECT_NEAR(height_at(*geoid, 305.0211140, -14.6212170), -2.969, 0.1);
  EXPECT_NEAR(height_at(*geoid, 102.4487290, 46.8743190), -43.575, 0.1);
  EXPECT_NEAR(height_at(*geoid, 133.8747120, -23.6174460), 15.871, 0.1);
  EXPECT_NEAR(height_at(*geoid, 359.9995000, 38.6254730), 50.066, 0.1);
  EXPECT_NEAR(height_at(*geoid, 0.0023000, -0.4667440), 17.329, 0.1);
  EXPECT_TRUE(std::isnan(height_at(*geoid, 0, 90.2)));
}

RC_GTEST_PROP(egm96_law, is_what_proj_makes_of_its_grid_to_6_mm, ()) {
  static const auto theirs = proj_egm96();
  if (theirs == nullptr) RC_DISCARD("PROJ has no grid of EGM96 here");
  double longitude = any_degrees(-180, 180), latitude = any_degrees(-90, 90);
  switch (*rc::gen::inRange(0, 6)) {
    case 0:
      latitude = *rc::gen::element(-90.0, 90.0, -89.9, 89.9);
      break;
    case 1:
      longitude = *rc::gen::element(-180.0, 180.0, 179.9, -179.99, 179.75, 0.0);
      break;
    default:
      break;
  }
  const double ours = height_at(*egm96(), longitude, latitude);
  const double other = height_at(*theirs, longitude, latitude);
  RC_ASSERT(std::abs(ours - other) < 0.006);
  // A further turn gives the same place.
  RC_ASSERT(std::abs(ours - height_at(*egm96(), longitude + 360, latitude)) < 1e-9);
}

RC_GTEST_PROP(grid_zero_law, is_bilinear_between_its_nodes, ()) {
  const int cols = *rc::gen::inRange(2, 9), rows = *rc::gen::inRange(2, 9);
  const double west = any_degrees(-180, 180), north = any_degrees(0, 80), cell = 360.0 / *rc::gen::inRange(cols, 60);
  ZeroGrid grid{cols, rows, {}, {{west, cell, 0, north, 0, -cell}}};
  for (int k = 0; k < cols * rows; ++k)
    grid.heights.push_back(*rc::gen::inRange(0, 12) == 0 ? kNone : static_cast<float>(any_degrees(-100, 100)));
  const std::vector<float> nodes = grid.heights;
  const bool goes_round = std::abs(cols * cell - 360) < 1e-6;
  const auto made = make_grid_zero(std::move(grid));
  RC_ASSERT(made.has_value());
  const double col = any_degrees(0, cols) - 0.5, row = any_degrees(0, rows) - 0.5;
  const double found = height_at(**made, west + col * cell, north - row * cell);
  // The textbook: all four nodes, except those with weight 0.
  const double at_col = goes_round ? col : std::clamp(col, 0.0, cols - 1.0), at_row = std::clamp(row, 0.0, rows - 1.0);
  double height = 0;
  for (const int down : {0, 1}) {
    for (const int across : {0, 1}) {
      const double x = std::floor(at_col) + across, y = std::floor(at_row) + down;
      const double weight = (1 - std::abs(at_col - x)) * (1 - std::abs(at_row - y));
      if (weight < 1e-7) continue;
      const int wrapped = (static_cast<int>(x) % cols + cols) % cols;
      height += weight * double{nodes[static_cast<std::size_t>(static_cast<int>(y) * cols + wrapped)]};
    }
  }
  // On the line of a node, rounding may require adjacent nodes.
  if (std::isnan(height) || std::isnan(found)) {
    const bool is_on_line =
        std::abs(at_col - std::round(at_col)) < 1e-6 || std::abs(at_row - std::round(at_row)) < 1e-6;
    RC_ASSERT(is_on_line || (std::isnan(height) && std::isnan(found)));
    return;
  }
  RC_ASSERT(std::abs(found - height) < 1e-4);
}

TEST(GridZero, RefusesWhatIsNoGrid) {
  EXPECT_FALSE(make_grid_zero({1, 2, {0, 0}, {}}));
  EXPECT_FALSE(make_grid_zero({2, 2, {0, 0, 0}, {}}));
  const auto line = make_grid_zero({2, 2, {0, 0, 0, 0}, {{0, 1, 1, 0, 1, 1}}});
  ASSERT_FALSE(line);
  EXPECT_NE(line.error().message.find("line"), std::string::npos);
}

}  // namespace scarp::geoid_laws_test
