// The local metric frame: metres around the centre sample, exact in float32.
#pragma once

#include <array>
#include <string>

#include "scarp/height_field.h"
#include "scarp/result.h"

namespace scarp::grid {

struct Ellipsoid {
  double semi_major = 0;          ///< metres
  double inverse_flattening = 0;  ///< 0 = a sphere
};

/// Ground metres per radian of longitude (east) and of latitude (north).
struct MetresPerRadian {
  double east = 0, north = 0;
};

/// REQUIRES: |latitude| < π/2 (radians, geodetic).
MetresPerRadian metres_per_radian(const Ellipsoid& ellipsoid, double latitude);

/// Largest |index − size / 2| over the indices 0 … size − 1.
constexpr int centre_reach(int size) { return size / 2; }

/// The affine map with the linear part {x per col, x per row, y per col, y per row}, moved so that sample
/// (cols / 2, rows / 2) is at exactly (0, 0). Its four coefficients are rounded to multiples of a power of two, large
/// enough that every sample's x and y are exactly float32. For an axis-aligned map, the rounding changes the cell size
/// by less than reach / 2^23 (0.03 % for 5,000 samples from the centre to the border).
std::array<double, 6> centred_affine(const std::array<double, 4>& linear, int cols, int rows);

/// Metres per unit of x and of y.
struct MetresPerUnit {
  double east = 0, north = 0;  ///< 0: unknown, or at a pole
};
/// The local frame of samples. `samples` maps samples to x and y of the CRS named by `crs`. Without a CRS, the unit of
/// x and y does not change. Fails with kUsage at a pole and for cells too unequal for float32; the message begins with
/// "its".
Result<Frame> local_frame(const std::array<double, 6>& samples, const MetresPerUnit& metres, int cols, int rows,
                          const std::string& crs);

/// The local frame of square cells if only their width is known. Fails with kUsage if the width is not positive or is
/// beyond float32.
Result<Frame> cell_frame(double cell, int cols, int rows);

/// True if the affine map sends all samples to a line, or any to infinity.
bool is_degenerate(const std::array<double, 6>& affine);

}  // namespace scarp::grid
