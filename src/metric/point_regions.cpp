// Regions of interest around scattered points: tolerances at places outside a grid.
#include <algorithm>
#include <cmath>
#include <limits>
#include <map>
#include <utility>
#include <vector>

#include "base/ring_bands.h"
#include "metric/bound_rule.h"
#include "scarp/points.h"

namespace scarp {

namespace {

constexpr double kFar = std::numeric_limits<double>::infinity();

struct PlaceBox {
  Place low{kFar, kFar}, high{-kFar, -kFar};

  void include(const Place& p) {
    for (std::size_t k = 0; k < 2; ++k) {
      low[k] = std::min(low[k], p[k]);
      high[k] = std::max(high[k], p[k]);
    }
  }
};

double distance_to(const RingBands::Edge& edge, double x, double y) {
  const double ex = edge.to[0] - edge.from[0], ey = edge.to[1] - edge.from[1];
  const double square = ex * ex + ey * ey;
  const double along = square > 0 ? ((x - edge.from[0]) * ex + (y - edge.from[1]) * ey) / square : 0;
  const double t = std::clamp(along, 0.0, 1.0);
  return std::hypot(x - edge.from[0] - t * ex, y - edge.from[1] - t * ey);
}

/// A polygon with its holes, or a line as a ring in both directions.
class RegionPart {
 public:
  RegionPart(std::vector<PlaceRing> rings, std::size_t region, double reach)
      : bands_(rings), region_(region), reach_(reach) {
    for (const PlaceRing& ring : rings) {
      for (const Place& p : ring) box_.include(p);
    }
    box_.include({box_.low[0] - reach, box_.low[1] - reach});
    box_.include({box_.high[0] + reach, box_.high[1] + reach});
  }

  std::size_t region() const { return region_; }
  const PlaceBox& box() const { return box_; }

  /// The distance, 0 inside; infinity unless it is below `most` or at most the reach.
  double distance(double x, double y, double most) const {
    if (x < box_.low[0] || x > box_.high[0] || y < box_.low[1] || y > box_.high[1]) return kFar;
    const double beside_x = std::max({0.0, box_.low[0] + reach_ - x, x - (box_.high[0] - reach_)});
    const double beside_y = std::max({0.0, box_.low[1] + reach_ - y, y - (box_.high[1] - reach_)});
    if (std::hypot(beside_x, beside_y) > most) return kFar;
    if (bands_.holds(x, y)) return 0;
    double nearest = kFar;
    if (reach_ > 0)
      bands_.each_near(y - most, y + most,
                       [&](std::size_t e) { nearest = std::min(nearest, distance_to(bands_.edge(e), x, y)); });
    return nearest <= most ? nearest : kFar;
  }

 private:
  RingBands bands_;
  PlaceBox box_;
  std::size_t region_;
  double reach_;
};

std::vector<RegionPart> parts_of(std::span<const Region> regions, double reach) {
  std::vector<RegionPart> parts;
  for (std::size_t k = 0; k < regions.size(); ++k) {
    std::map<std::uint32_t, std::vector<PlaceRing>> polygons;
    for (const Line& line : regions[k].lines) {
      PlaceRing ring;
      for (const auto& p : line.points) ring.push_back({p[0], p[1]});
      if (line.is_ring()) {
        ring.pop_back();
        polygons[line.polygon].push_back(std::move(ring));
        continue;
      }
      for (std::size_t i = line.points.size() - 1; i-- > 1;) ring.push_back(ring[i]);
      parts.emplace_back(std::vector<PlaceRing>{std::move(ring)}, k, reach);
    }
    for (auto& [polygon, rings] : polygons) parts.emplace_back(std::move(rings), k, reach);
  }
  return parts;
}

/// Cells of a grid over the points, with the parts that may reach into each.
class PartGrid {
 public:
  PartGrid(const std::vector<RegionPart>& parts, const PointSet& points) {
    for (std::size_t i = 0; i < points.size(); ++i) extent_.include({points.x[i], points.y[i]});
    cells_.resize(std::size_t{kSide} * kSide);
    for (std::size_t part = 0; part < parts.size(); ++part) {
      const PlaceBox& box = parts[part].box();
      for (std::size_t row = cell(1, box.low[1]); row <= cell(1, box.high[1]); ++row) {
        for (std::size_t col = cell(0, box.low[0]); col <= cell(0, box.high[0]); ++col)
          cells_[row * kSide + col].push_back(part);
      }
    }
  }
  const std::vector<std::size_t>& at(double x, double y) const { return cells_[cell(1, y) * kSide + cell(0, x)]; }

 private:
  static constexpr std::size_t kSide = 64;

  std::size_t cell(std::size_t axis, double value) const {
    const double size = extent_.high[axis] - extent_.low[axis];
    const double share = size > 0 ? (value - extent_.low[axis]) / size : 0;
    return static_cast<std::size_t>(std::clamp(share * kSide, 0.0, kSide - 1.0));
  }

  PlaceBox extent_;
  std::vector<std::vector<std::size_t>> cells_;
};

}  // namespace

std::vector<float> region_tolerances(std::span<const Region> regions, const PointSet& points, double falloff,
                                     double beyond, std::vector<bool>* found) {
  const std::vector<RegionPart> parts = parts_of(regions, falloff);
  const PartGrid grid(parts, points);
  if (found != nullptr) found->assign(regions.size(), false);
  std::vector<float> tolerances(points.size(), metric::round_down_to_float(beyond));
  for (std::size_t i = 0; i < points.size(); ++i) {
    for (const std::size_t part : grid.at(points.x[i], points.y[i])) {
      const std::size_t region = parts[part].region();
      const double own = regions[region].tolerance, now = double{tolerances[i]};
      if (!(own < beyond) || (own >= now && (found == nullptr || (*found)[region]))) continue;
      // From farther away, a region lowers no tolerance; a region that has lowered none also counts as found.
      const bool is_counted = found == nullptr || (*found)[region];
      const double most = is_counted && falloff > 0 ? falloff * (now - own) / (beyond - own) * (1 + 1e-12) : falloff;
      const double away = parts[part].distance(points.x[i], points.y[i], std::min(most, falloff));
      if (away == kFar) continue;
      const double share = falloff > 0 ? std::min(1.0, away / falloff) : 0;
      tolerances[i] =
          std::min(tolerances[i], metric::round_down_to_float(share == 0 ? own : own + (beyond - own) * share));
      if (found != nullptr && share < 1) (*found)[region] = true;
    }
  }
  return tolerances;
}

}  // namespace scarp
