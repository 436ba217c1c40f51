// A trial vertex and the ring of corners around it: shapes of its triangles, and its best height.
#pragma once

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <limits>

#include "fit/height_room.h"
#include "fit/height_step.h"
#include "fit/rules.h"
#include "fit/triangle_error.h"
#include "geom/scan_plane.h"

namespace scarp::fit {

/// CornerAt: corner(i) for 0 <= i <= triangles; triangle i lies between the place, corner(i) and corner(i + 1).
template <typename CornerAt>
class Fan {
 public:
  struct Raised {
    FitCorner place;
    double least = 0;      ///< the least energy of any height
    double energy = 0;     ///< at the chosen height; infinite if the height is too large to scan
    bool in_room = false;  ///< every triangle is within the bound (height_room.h)
  };

  Fan(std::size_t triangles, CornerAt corner) : triangles_(triangles), corner_(corner) {}

  /// True if all triangles are positive, and no shape is below the floor.
  bool fits(const FitCorner& place, const ShapeRule& rule, const TriangleShape& floor) const {
    for (std::size_t i = 0; i < triangles_; ++i) {
      if (area2(place, corner_(i), corner_(i + 1)) <= 0) return false;
      if (rule.is_on() && !rule.shape(place, corner_(i), corner_(i + 1)).keeps(floor)) return false;
    }
    return true;
  }

  /// The height of least energy within the rules' limits. If `seeks_room(energy)` is true and there is a room
  /// (height_room.h): the nearest height in it. place.z is the initial height.
  template <typename SeeksRoom>
  Raised raise(const TriangleError& error, const MoveRules& rules, FitCorner place, SeeksRoom seeks_room) const {
    TriangleError::Moments moments{};
    for (std::size_t i = 0; i < triangles_; ++i) error.add_moments(place, corner_(i), corner_(i + 1), moments);
    const auto rise_to = [&](float height) { return (double{height} - double{place.z}) / error.unit(); };
    const double lowest = rise_to(rules.lowest), highest = rise_to(rules.highest);
    const double scale = error.has_bounds() ? scale_of_rises(moments) : 1;
    const HeightStep best = error.power() == ErrorRule::Power::kTwo ? best_even_height(moments, lowest, highest)
                                                                    : best_height(moments, lowest, highest, scale);
    Raised raised{place, best.energy, best.energy};
    double rise = best.rise;
    if (seeks_room(best.energy)) {
      TriangleError::Room room{static_cast<float>(lowest), static_cast<float>(highest)};
      for (std::size_t i = 0; i < triangles_ && room.is_open(); ++i)
        error.narrow(place, corner_(i), corner_(i + 1), room);
      if (const auto within = rise_in(room, rise, scale)) {
        rise = *within;
        raised.energy = energy_after(moments, rise);
        raised.in_room = true;
      }
    }
    const auto height = static_cast<float>(double{place.z} + rise * error.unit());
    raised.place.z = std::clamp(height, rules.lowest, rules.highest);
    if (!(std::abs(raised.place.z) <= geom::kMaxScanHeight)) raised.energy = std::numeric_limits<double>::infinity();
    return raised;
  }

 private:
  std::size_t triangles_;
  CornerAt corner_;
};

}  // namespace scarp::fit
