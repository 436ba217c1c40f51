#include "measure/cut_region.h"

#include <algorithm>
#include <cmath>
#include <map>
#include <utility>

namespace scarp::judge {

CutRegion::CutRegion(const Cutline& cutline, int cols, int rows)
    : cols_(cols), rows_(rows), segments_(static_cast<std::size_t>(rows)) {
  const auto& a = cutline.affine;
  const double determinant = a[1] * a[5] - a[2] * a[4];
  std::map<std::uint32_t, std::vector<const Line*>> polygons;
  for (const Line& ring : cutline.rings) {
    if (ring.is_ring()) polygons[ring.polygon].push_back(&ring);
  }
  const auto to_grid = [&](const std::array<double, 3>& point) {
    const double x = point[0] - a[0], y = point[1] - a[3];
    return std::pair((a[5] * x - a[2] * y) / determinant, (a[1] * y - a[4] * x) / determinant);
  };
  for (const auto& [polygon, rings] : polygons) {
    for (const Line* ring : rings) {
      for (std::size_t k = 0; k + 1 < ring->points.size(); ++k) {
        const auto [x0, y0] = to_grid(ring->points[k]);
        const auto [x1, y1] = to_grid(ring->points[k + 1]);
        add({x0, y0, x1, y1, polygon});
      }
    }
  }
}

std::vector<CutRegion::Place> CutRegion::places(int first, int rows) const {
  std::vector<Place> places(static_cast<std::size_t>(cols_) * static_cast<std::size_t>(rows), Place::kOutside);
  for (int row = first; row < first + rows; ++row) {
    Place* line = &places[static_cast<std::size_t>(row - first) * static_cast<std::size_t>(cols_)];
    mark_inside(row, line);
    mark_near(row, line);
  }
  return places;
}

void CutRegion::add(const Segment& segment) {
  const auto row_of = [this](double y) { return static_cast<int>(std::clamp(std::floor(y), -1.0, double(rows_))); };
  const int first = row_of(std::min(segment.y0, segment.y1) - 2 * kNear),
            last = row_of(std::max(segment.y0, segment.y1) + 2 * kNear);
  for (int row = std::max(first, 0); row <= std::min(last, rows_ - 1); ++row)
    segments_[static_cast<std::size_t>(row)].push_back(segment);
}

const std::vector<CutRegion::Segment>& CutRegion::segments_at(double y) const {
  return segments_[static_cast<std::size_t>(std::clamp(std::floor(y), 0.0, rows_ - 1.0))];
}

double CutRegion::distance(const Segment& s, double x, double y) {
  const double dx = s.x1 - s.x0, dy = s.y1 - s.y0, length = dx * dx + dy * dy;
  const double at = length > 0 ? std::clamp(((x - s.x0) * dx + (y - s.y0) * dy) / length, 0.0, 1.0) : 0.0;
  return std::hypot(s.x0 + at * dx - x, s.y0 + at * dy - y);
}

/// True if the segment crosses the row left of the point; half open, so that a vertex on the row counts once.
bool CutRegion::crosses(const Segment& s, double x, double y) {
  if ((s.y0 <= y) == (s.y1 <= y)) return false;
  return s.x0 + (y - s.y0) / (s.y1 - s.y0) * (s.x1 - s.x0) < x;
}

bool CutRegion::holds(double x, double y) const {
  const std::vector<Segment>& segments = segments_at(y);
  for (std::size_t i = 0; i < segments.size();) {
    const std::uint32_t polygon = segments[i].polygon;
    bool is_inside = false;
    for (; i < segments.size() && segments[i].polygon == polygon; ++i) is_inside ^= crosses(segments[i], x, y);
    if (is_inside) return true;
  }
  return false;
}

bool CutRegion::is_near(double x, double y, double distance) const {
  const std::vector<Segment>& segments = segments_at(y);
  return std::any_of(segments.begin(), segments.end(), [&](const Segment& s) {
    if (std::min(s.x0, s.x1) > x + distance || std::max(s.x0, s.x1) < x - distance) return false;
    return CutRegion::distance(s, x, y) <= distance;
  });
}

/// Fills the row between successive pairs of crossings with a polygon's rings.
void CutRegion::mark_inside(int row, Place* places) const {
  const std::vector<Segment>& segments = segments_at(row);
  std::vector<double> crossings;
  for (std::size_t i = 0; i < segments.size();) {
    const std::uint32_t polygon = segments[i].polygon;
    crossings.clear();
    for (; i < segments.size() && segments[i].polygon == polygon; ++i) {
      const Segment& s = segments[i];
      if ((s.y0 <= row) != (s.y1 <= row)) crossings.push_back(s.x0 + (row - s.y0) / (s.y1 - s.y0) * (s.x1 - s.x0));
    }
    std::sort(crossings.begin(), crossings.end());
    for (std::size_t k = 0; k + 1 < crossings.size(); k += 2) {
      const double last = std::min(crossings[k + 1], cols_ - 1.0);
      for (double col = std::max(std::ceil(crossings[k]), 0.0); col <= last; ++col)
        places[static_cast<std::ptrdiff_t>(col)] = Place::kInside;
    }
  }
}

void CutRegion::mark_near(int row, Place* places) const {
  for (const Segment& s : segments_at(row)) {
    // The part of the segment near the row.
    double begin = 0, end = 1;
    if (s.y0 != s.y1) {
      const double one = (row - kNear - s.y0) / (s.y1 - s.y0), other = (row + kNear - s.y0) / (s.y1 - s.y0);
      begin = std::max(begin, std::min(one, other));
      end = std::min(end, std::max(one, other));
    } else if (std::abs(s.y0 - row) > kNear) {
      continue;
    }
    if (begin > end) continue;
    const double x0 = s.x0 + begin * (s.x1 - s.x0), x1 = s.x0 + end * (s.x1 - s.x0);
    const double last = std::min(std::max(x0, x1) + kNear, cols_ - 1.0);
    for (double col = std::max(std::ceil(std::min(x0, x1) - kNear), 0.0); col <= last; ++col) {
      if (distance(s, col, row) <= kNear) places[static_cast<std::ptrdiff_t>(col)] = Place::kNear;
    }
  }
}

}  // namespace scarp::judge
