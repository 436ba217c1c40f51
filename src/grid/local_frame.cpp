// The local metric frame.
//
// Problem: a geographic raster has x and y in degrees and z in metres, which no 3-D model can mix. A map projection is
// not affine on the grid: plane triangles over the grid would not be plane in the model, and float32 rounding of
// projected positions would move vertices off their samples.
//
// Idea: replace degrees by metres with two constants, those of the ellipsoid at the centre sample's latitude φ:
//
//   M = a (1 − e²) / (1 − e² sin²φ)^{3/2}    meridian radius of curvature:        one radian of latitude  = M
//   N = a / (1 − e² sin²φ)^{1/2}             prime-vertical radius of curvature:  one radian of longitude = N cos φ
//
// with a the semi-major axis and e² = f (2 − f). The map stays affine, so the bound on the grid also holds in the
// model. Its scale is true along the centre's parallel and meridian; elsewhere east–west lengths are wrong by the
// factor cos φ_centre / cos φ. The cell sizes are then rounded so that integer multiples of them are exact float32
// values: a vertex in a file with float32 offsets lies exactly on its sample.
//
// Source of the formulas: Snyder, Map Projections: A Working Manual (USGS Professional Paper 1395), equations 4-18
// and 4-20.
#include "grid/local_frame.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "scarp/height_field.h"

namespace scarp {
namespace {

constexpr double kLargestInteger = 0x1p24;  // every integer up to here is a float32

/// Rounds p and q to multiples of a power of two: the smallest power for which |p|·reach_p + |q|·reach_q is at most
/// 2^24 times that power.
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

grid::MetresPerRadian grid::metres_per_radian(const Ellipsoid& ellipsoid, double latitude) {
  const double flattening = ellipsoid.inverse_flattening > 0 ? 1 / ellipsoid.inverse_flattening : 0;
  const double eccentricity2 = flattening * (2 - flattening);
  const double sine = std::sin(latitude);
  const double w2 = 1 - eccentricity2 * sine * sine;
  const double prime_vertical = ellipsoid.semi_major / std::sqrt(w2);
  const double meridian = ellipsoid.semi_major * (1 - eccentricity2) / (w2 * std::sqrt(w2));
  return {prime_vertical * std::cos(latitude), meridian};
}

std::array<double, 6> grid::centred_affine(const std::array<double, 4>& linear, int cols, int rows) {
  auto [x_col, x_row, y_col, y_row] = linear;
  const double reach_col = centre_reach(cols), reach_row = centre_reach(rows);
  round_pair(x_col, x_row, reach_col, reach_row);
  round_pair(y_col, y_row, reach_col, reach_row);
  const double col = cols / 2, row = rows / 2;
  return {-(x_col * col + x_row * row), x_col, x_row, -(y_col * col + y_row * row), y_col, y_row};
}

bool grid::is_degenerate(const std::array<double, 6>& affine) {
  const double determinant = affine[1] * affine[5] - affine[2] * affine[4];
  return determinant == 0 || !std::isfinite(determinant) || !std::isfinite(affine[0]) || !std::isfinite(affine[3]);
}

Result<Frame> grid::local_frame(const std::array<double, 6>& samples, const MetresPerUnit& metres, int cols, int rows,
                                const std::string& crs) {
  const auto& a = samples;
  const double col = cols / 2, row = rows / 2;
  const double x = a[0] + a[1] * col + a[2] * row, y = a[3] + a[4] * col + a[5] * row;
  constexpr double kFlat = 1e-3;  // smallest usable cos φ, close to the poles
  if (!(metres.north > 0) || !(metres.east > kFlat * metres.north)) {
    return fail(ErrorKind::kUsage,
                fmt::format("its centre lies at {:.9g}, {:.9g}, at or beyond a pole, where no local frame exists; "
                            "choose a polar CRS such as EPSG:3413 or EPSG:3031",
                            x, y));
  }
  Frame frame;
  frame.kind = Frame::Kind::kLocal;
  frame.affine =
      centred_affine({a[1] * metres.east, a[2] * metres.east, a[4] * metres.north, a[5] * metres.north}, cols, rows);
  if (is_degenerate(frame.affine)) {
    return fail(ErrorKind::kUsage, "its cells are too unequal for a local frame in float32; choose the frame 'source'");
  }
  frame.unit_in_metres = crs.empty() ? 0 : 1;
  const char* const unit = crs.empty() ? "" : " m";
  frame.description = fmt::format("local {} east and north of {:.9g}, {:.9g} ({}), {:.6g}{} x {:.6g}{} a cell",
                                  crs.empty() ? "units" : "metres", x, y, crs.empty() ? "no CRS" : crs,
                                  std::hypot(frame.affine[1], frame.affine[4]), unit,
                                  std::hypot(frame.affine[2], frame.affine[5]), unit);
  return frame;
}

Result<Frame> grid::cell_frame(double cell, int cols, int rows) {
  Frame frame;
  frame.kind = Frame::Kind::kLocal;
  // The width is rounded for the longer side, so that cells stay square.
  const int side = std::max(cols, rows);
  const double width = centred_affine({cell, 0, 0, -cell}, side, side)[1], reach = cell * side;
  frame.affine = centred_affine({width, 0, 0, -width}, cols, rows);
  if (!(cell > 0) || is_degenerate(frame.affine) || !(reach < 1e30)) {
    return fail(ErrorKind::kUsage,
                fmt::format("a cell size of {} makes no frame: give a positive width that float32 can hold", cell));
  }
  frame.description = fmt::format("local units around the raster's centre, {:.6g} a cell", frame.affine[1]);
  return frame;
}

std::array<double, 2> metres_of_unit(double latitude, const Geodetic& geodetic) {
  const double radians = latitude * geodetic.radians_per_unit;
  if (!(std::abs(radians) < std::acos(0.0))) return {};
  const auto metres = grid::metres_per_radian({geodetic.semi_major, geodetic.inverse_flattening}, radians);
  return {metres.east * geodetic.radians_per_unit, metres.north * geodetic.radians_per_unit};
}

Result<Frame> frame_of_degrees(const std::array<double, 6>& affine, int cols, int rows, const Geodetic& geodetic) {
  if (cols < 1 || rows < 1) return fail(ErrorKind::kUsage, "a frame needs at least one column and one row");
  if (grid::is_degenerate(affine))
    return fail(ErrorKind::kUsage, "the affine map takes the samples to a line, or to infinity");
  const auto [east, north] = metres_of_unit(affine[3] + affine[4] * (cols / 2) + affine[5] * (rows / 2), geodetic);
  auto frame = grid::local_frame(affine, {east, north}, cols, rows, "degrees");
  if (!frame) return fail(frame.error().kind, "a raster in degrees: " + frame.error().message);
  return frame;
}

}  // namespace scarp
