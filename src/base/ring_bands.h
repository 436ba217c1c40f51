// Edges of polygon rings in bands of y, to find whether a place is inside and which edges are near. Uses doubles, for
// places on no lattice.
#pragma once

#include <algorithm>
#include <array>
#include <cstddef>
#include <limits>
#include <vector>

namespace scarp {

using Place = std::array<double, 2>;
using PlaceRing = std::vector<Place>;

/// Edges of rings, ring by ring, in bands of y.
class RingBands {
 public:
  struct Edge {
    Place from, to;
  };

  /// Each ring's last corner connects to its first.
  explicit RingBands(const std::vector<PlaceRing>& rings) {
    double low = std::numeric_limits<double>::infinity(), high = -low;
    for (const PlaceRing& ring : rings) {
      for (std::size_t k = 0; k < ring.size(); ++k) {
        edges_.push_back({ring[k], ring[(k + 1) % ring.size()]});
        low = std::min(low, ring[k][1]);
        high = std::max(high, ring[k][1]);
      }
    }
    south_ = low;
    bands_.resize(std::clamp<std::size_t>(edges_.size(), 1, 1 << 16));
    per_height_ = high > low ? static_cast<double>(bands_.size()) / (high - low) : 0;
    for (std::size_t e = 0; e < edges_.size(); ++e) {
      const auto [first, last] = std::minmax({band_of(edges_[e].from[1]), band_of(edges_[e].to[1])});
      for (std::size_t band = first; band <= last; ++band) bands_[band].push_back(e);
    }
  }

  const Edge& edge(std::size_t e) const { return edges_[e]; }

  /// True if the place is inside by the even-odd rule, or on an edge.
  bool holds(double x, double y) const {
    bool is_inside = false;
    for (const std::size_t e : bands_[band_of(y)]) {
      const auto& [from, to] = edges_[e];
      const double side = (to[0] - from[0]) * (y - from[1]) - (to[1] - from[1]) * (x - from[0]);
      const bool is_between = (from[1] > y) != (to[1] > y);
      if (side == 0 && std::min(from[0], to[0]) <= x && x <= std::max(from[0], to[0]) &&
          std::min(from[1], to[1]) <= y && y <= std::max(from[1], to[1]))
        return true;
      if (is_between && (side > 0) == (to[1] > from[1])) is_inside = !is_inside;
    }
    return is_inside;
  }

  /// Calls visit(edge) once for each edge in the bands that a segment meets.
  template <class Visit>
  void each_near(double y_from, double y_to, const Visit& visit) const {
    std::vector<std::size_t> near;
    const auto [first, last] = std::minmax({band_of(y_from), band_of(y_to)});
    for (std::size_t band = first; band <= last; ++band)
      near.insert(near.end(), bands_[band].begin(), bands_[band].end());
    std::sort(near.begin(), near.end());
    near.erase(std::unique(near.begin(), near.end()), near.end());
    for (const std::size_t e : near) visit(e);
  }

 private:
  std::size_t band_of(double y) const {
    const double band = (y - south_) * per_height_;
    return band > 0 ? std::min(static_cast<std::size_t>(band), bands_.size() - 1) : 0;
  }

  std::vector<Edge> edges_;
  std::vector<std::vector<std::size_t>> bands_;
  double south_ = 0, per_height_ = 0;
};

}  // namespace scarp
