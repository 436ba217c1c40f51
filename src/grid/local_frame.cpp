// The local metric frame.
//
// Problem: a geographic raster has x and y in degrees and z in metres, which no 3-D model can mix. A true map
// projection is not affine in the grid, so a triangle's plane over the grid would no longer be a plane in the model,
// and rounding of projected positions to float32 would move vertices off their samples.
//
// Idea: replace degrees by metres with two constants, those of the ellipsoid at the centre sample's latitude φ:
//
//   M = a (1 − e²) / (1 − e² sin²φ)^{3/2}    meridian radius of curvature:        one radian of latitude  = M
//   N = a / (1 − e² sin²φ)^{1/2}             prime-vertical radius of curvature:  one radian of longitude = N cos φ
//
// with a the semi-major axis and e² = f (2 − f). The map stays affine, so the promise made on the grid is the promise
// in the model. Its scale is true along the centre's parallel and meridian; elsewhere east–west lengths are off by cos
// φ_centre / cos φ. The cell sizes are then rounded so that integer multiples of them are exact float32 values: a
// vertex in a file with float32 offsets lies exactly on its sample.
//
// Source of the formulas: Snyder, Map Projections: A Working Manual (USGS Professional Paper 1395), equations 4-18
// and 4-20.
#include "grid/local_frame.h"

#include <cmath>

namespace scarp {
namespace {

constexpr double kLargestInteger = 0x1p24;  // every integer up to here is a float32

/// Rounds p and q to multiples of the smallest power of two for which |p|·reach_p + |q|·reach_q stays within 2^24 of
/// it.
void round_pair(double& p, double& q, double reach_p, double reach_q) {
  const double span = std::abs(p) * reach_p + std::abs(q) * reach_q;
  if (span == 0 || !std::isfinite(span)) return;
  for (int exponent = std::ilogb(span) - 24;; ++exponent) {
    const double unit = std::ldexp(1.0, exponent);
    const double rounded_p = std::nearbyint(p / unit), rounded_q = std::nearbyint(q / unit);
    if (std::abs(rounded_p) * reach_p + std::abs(rounded_q) * reach_q <= kLargestInteger) {
      p = rounded_p * unit;
      q = rounded_q * unit;
      return;
    }
  }
}

}  // namespace

MetresPerRadian metres_per_radian(const Ellipsoid& ellipsoid, double latitude) {
  const double flattening = ellipsoid.inverse_flattening > 0 ? 1 / ellipsoid.inverse_flattening : 0;
  const double eccentricity2 = flattening * (2 - flattening);
  const double sine = std::sin(latitude);
  const double w2 = 1 - eccentricity2 * sine * sine;
  const double prime_vertical = ellipsoid.semi_major / std::sqrt(w2);
  const double meridian = ellipsoid.semi_major * (1 - eccentricity2) / (w2 * std::sqrt(w2));
  return {prime_vertical * std::cos(latitude), meridian};
}

std::array<double, 6> centred_affine(const std::array<double, 4>& linear, int cols, int rows) {
  auto [x_col, x_row, y_col, y_row] = linear;
  const double reach_col = centre_reach(cols), reach_row = centre_reach(rows);
  round_pair(x_col, x_row, reach_col, reach_row);
  round_pair(y_col, y_row, reach_col, reach_row);
  const double col = cols / 2, row = rows / 2;
  return {-(x_col * col + x_row * row), x_col, x_row, -(y_col * col + y_row * row), y_col, y_row};
}

}  // namespace scarp
