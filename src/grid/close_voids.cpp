// Closes voids by an outline tolerance.
//
// The domain may grow by the tolerance from all sides. So a void that lies entirely within that distance of its outline
// may become surface, which removes its outline. A single missing sample would cost six triangles, and ragged voids are
// usually surrounded by many tiny voids.
//
// Every point of a void is near its outline if each quarter of its cells lies within the tolerance of one edge. A
// square's farthest point from an edge is a corner, so corners suffice. The test fails needlessly only if a quarter
// needs two edges to cover it.
#include <algorithm>
#include <array>
#include <utility>

#include "grid/outline.h"

namespace scarp::grid {

namespace {

/// Steps per sample: corners of quarters are even, their centres odd.
constexpr std::int32_t kSteps = 4, kHalf = kSteps / 2, kQuarter = kSteps / 4;

struct Edge {
  Point a, b;
};

bool is_near(const Edge& edge, Point p, double reach) {
  const std::int64_t dx = edge.b.x - edge.a.x, dy = edge.b.y - edge.a.y;
  const std::int64_t px = p.x - edge.a.x, py = p.y - edge.a.y, qx = p.x - edge.b.x, qy = p.y - edge.b.y;
  const auto keeps = [&](std::int64_t square) { return static_cast<double>(square) <= reach * reach; };
  const std::int64_t along = px * dx + py * dy, length2 = dx * dx + dy * dy;
  if (along <= 0) return keeps(px * px + py * py);
  if (along >= length2) return keeps(qx * qx + qy * qy);
  const auto across = static_cast<double>(px * dy - py * dx);
  return across * across <= reach * reach * static_cast<double>(length2);
}

/// A polygon around nodata.
class Void {
 public:
  Void(const Raster& raster, const std::vector<Point>& polygon) : raster_(raster), low_(polygon[0]), high_(polygon[0]) {
    for (const Point p : polygon) {
      low_ = {std::min(low_.x, p.x), std::min(low_.y, p.y)};
      high_ = {std::max(high_.x, p.x), std::max(high_.y, p.y)};
    }
    if (!fits()) return;
    const auto place = [&](Point p) { return Point{(p.x - low_.x) * kSteps, (p.y - low_.y) * kSteps}; };
    for (std::size_t i = 0; i < polygon.size(); ++i)
      edges_.push_back({place(polygon[i]), place(polygon[i + 1 == polygon.size() ? 0 : i + 1])});
  }

  bool closes(double tolerance) {
    const double reach = tolerance * kSteps;
    for (std::int32_t y = 0; fits() && y < (high_.y - low_.y) * kSteps; y += kHalf) {
      find_edges(y, reach);
      for (std::size_t i = 0; i + 1 < crossings_.size(); i += 2) {
        // Centres between the two crossings, including those on the outline.
        for (std::int32_t x = crossings_[i] / kHalf * kHalf; x + kQuarter <= crossings_[i + 1]; x += kHalf) {
          if (holds_a_height({x, y}) || !is_quarter_near({x, y}, reach)) return false;
        }
      }
    }
    return fits();
  }

 private:
  bool fits() const {
    constexpr std::int32_t kMost = kMaxCoordinate / kSteps;
    return high_.x - low_.x <= kMost && high_.y - low_.y <= kMost;
  }

  /// Finds edges near the row of quarters, and their crossings with its middle. Outlines follow rows, columns and
  /// diagonals.
  void find_edges(std::int32_t y, double reach) {
    near_.clear();
    crossings_.clear();
    const std::int32_t middle = y + kQuarter;
    for (const Edge& edge : edges_) {
      const auto [low, high] = std::minmax(edge.a.y, edge.b.y);
      if (low <= y + kHalf + reach && high >= y - reach) near_.push_back(edge);
      if ((edge.a.y > middle) == (edge.b.y > middle)) continue;
      const std::int32_t slope = edge.a.x == edge.b.x ? 0 : (edge.b.x > edge.a.x) == (edge.b.y > edge.a.y) ? 1 : -1;
      crossings_.push_back(edge.a.x + slope * (middle - edge.a.y));
    }
    std::sort(crossings_.begin(), crossings_.end());
  }

  /// True if the sample at the quarter's corner is a height and is not on the outline.
  bool holds_a_height(Point quarter) const {
    const auto nearest = [](std::int32_t at) { return (at + kQuarter + kHalf) / kSteps; };
    const Point sample{nearest(quarter.x), nearest(quarter.y)}, p{sample.x * kSteps, sample.y * kSteps};
    return raster_.is_valid({low_.x + sample.x, low_.y + sample.y}) &&
           std::none_of(near_.begin(), near_.end(), [&](const Edge& edge) { return is_near(edge, p, 0); });
  }

  bool is_quarter_near(Point low, double reach) const {
    const std::array<Point, 4> corners{
        low, {low.x + kHalf, low.y}, {low.x, low.y + kHalf}, {low.x + kHalf, low.y + kHalf}};
    return std::any_of(near_.begin(), near_.end(), [&](const Edge& edge) {
      return std::all_of(corners.begin(), corners.end(), [&](Point p) { return is_near(edge, p, reach); });
    });
  }

  const Raster& raster_;
  Point low_, high_;  // box of its corners, in samples
  std::vector<Edge> edges_, near_;
  std::vector<std::int32_t> crossings_;
};

bool is_void(const std::vector<Point>& polygon) {
  std::int64_t twice_area = 0;
  for (std::size_t i = 1; i + 1 < polygon.size(); ++i) twice_area += orient(polygon[0], polygon[i], polygon[i + 1]);
  return twice_area < 0;
}

}  // namespace

Outline close_voids(const Raster& raster, Outline outline, double tolerance) {
  const auto closes = [&](const std::vector<Point>& polygon) {
    return is_void(polygon) && Void(raster, polygon).closes(tolerance);
  };
  outline.erase(std::remove_if(outline.begin(), outline.end(), closes), outline.end());
  return outline;
}

}  // namespace scarp::grid
