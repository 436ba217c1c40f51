// The ellipsoid: positions in space, and what clients ask of a tile there.
#pragma once

#include <array>
#include <cstdint>
#include <span>

#include "scarp/height_field.h"

namespace scarp {

using Space = std::array<double, 3>;

class Globe {
 public:
  explicit Globe(const Geodetic& geodetic);

  /// Earth-centred: x towards 0° E, z towards the north pole; degrees and metres above the ellipsoid.
  Space position(double longitude, double latitude, double height) const;
  /// Away from the ellipsoid there, of unit length.
  static Space up(double longitude, double latitude);
  /// Radii of curvature in metres: of the meridian, and the distance to the axis.
  struct Radii {
    double meridian = 0, parallel = 0;
  };
  Radii radii(double latitude) const;
  double semi_major() const { return a_; }
  /// Least radius of curvature anywhere: that of the meridian on the equator.
  double least_radius() const { return a_ * (1 - e2_); }

  /// A sphere that holds the points, its radius rounded up.
  struct Sphere {
    Space centre{};
    double radius = 0;
  };
  static Sphere sphere_around(std::span<const Space> points);
  /// The point along the way from the earth's centre through `centre`, in units of the axes, from which on a viewer
  /// who does not see it sees none of the points either (Ring's and CesiumJS's horizon culling). NaN where there is
  /// none, as for a hemisphere.
  Space horizon_point(const Space& centre, std::span<const Space> points) const;

 private:
  double a_, b_, e2_;
};

/// Octahedral, two bytes, of a vector of unit length.
std::array<std::uint8_t, 2> encode_octahedral(const Space& normal);
/// A vector of unit length.
Space decode_octahedral(const std::array<std::uint8_t, 2>& normal);

double dot(const Space& a, const Space& b);
Space scaled(const Space& a, double factor);
Space sum(const Space& a, const Space& b);
/// {0, 0, 1} for a vector without length.
Space normalized(const Space& a);

}  // namespace scarp
