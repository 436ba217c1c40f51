// The ellipsoid: positions in space, and data for tile headers.
#pragma once

#include <array>
#include <cstdint>
#include <span>

#include "scarp/height_field.h"

namespace scarp::globe {

using Space = std::array<double, 3>;

class Globe {
 public:
  explicit Globe(const Geodetic& geodetic);

  /// Converts degrees and metres above the ellipsoid to earth-centred metres: x towards 0° E, z towards the north pole.
  Space position(double longitude, double latitude, double height) const;
  /// The unit normal of the ellipsoid, outwards.
  static Space up(double longitude, double latitude);
  /// Radii in metres: the meridian's curvature, and the distance to the axis.
  struct Radii {
    double meridian = 0, parallel = 0;
  };
  Radii radii(double latitude) const;
  double semi_major() const { return a_; }
  /// The smallest radius of curvature anywhere: the meridian's at the equator.
  double least_radius() const { return a_ * (1 - e2_); }

  /// A sphere around the points; its radius is rounded up.
  struct Sphere {
    Space centre{};
    double radius = 0;
  };
  static Sphere sphere_around(std::span<const Space> points);
  /// The horizon occlusion point (Ring's and CesiumJS's horizon culling): on the ray from the earth's centre through
  /// `centre`, in units of the axes. A viewer who cannot see it, or a point farther out, sees none of the points. NaN
  /// if none exists, as for a hemisphere.
  Space horizon_point(const Space& centre, std::span<const Space> points) const;

 private:
  double a_, b_, e2_;
};

/// Octahedral encoding of a unit vector in two bytes.
std::array<std::uint8_t, 2> encode_octahedral(const Space& normal);
Space decode_octahedral(const std::array<std::uint8_t, 2>& normal);

double dot(const Space& a, const Space& b);
Space scaled(const Space& a, double factor);
Space sum(const Space& a, const Space& b);
/// The unit vector along `a`; {0, 0, 1} for a null vector.
Space normalized(const Space& a);

}  // namespace scarp::globe
