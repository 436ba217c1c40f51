// Lines and a boundary for scattered points.
#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <optional>
#include <utility>
#include <vector>

#include "base/ring_bands.h"
#include "grid/keep_points.h"
#include "refine/point_surface.h"
#include "scarp/points.h"

namespace scarp {

namespace {

std::uint32_t add_point(PointSet& points, double x, double y, double z) {
  points.x.push_back(x);
  points.y.push_back(y);
  points.z.push_back(z);
  return static_cast<std::uint32_t>(points.size() - 1);
}

std::vector<PlaceRing> places_of(std::span<const Line> rings) {
  std::vector<PlaceRing> places;
  for (const Line& ring : rings) {
    places.emplace_back();
    for (std::size_t k = 0; k + 1 < ring.points.size(); ++k)
      places.back().push_back({ring.points[k][0], ring.points[k][1]});
  }
  return places;
}

/// A place where a line meets the boundary.
struct Meeting {
  std::size_t edge;
  double along_edge, along_segment;
  std::uint32_t point;
};

/// The boundary's own points, ring by ring: its corners, and the places where lines meet it.
class BoundaryMaker {
 public:
  BoundaryMaker(std::span<const Line> rings, double tolerance, PointSet& points, DuplicatePolicy duplicates)
      : rings_(rings), edges_(places_of(rings)), points_(points), tolerance_(tolerance), duplicates_(duplicates) {}

  Result<BoundaryCut> run() {
    SCARP_TRY(const auto& surface, refine::PointSurface::make(points_, duplicates_));
    spacing_ = surface.spacing() / 2;
    find_on_boundary();
    const std::size_t given = points_.size();
    cut_lines();
    const std::size_t crossings = points_.size() - given;
    BoundaryCut cut;
    cut.points_outside = drop_outside();
    const std::size_t kept = points_.size();
    add_rings(surface, cut);
    points_.added = crossings + points_.size() - kept;
    return cut;
  }

 private:
  /// Vertices of lines on the boundary also belong to the boundary; a vertex at a corner is the corner.
  void find_on_boundary() {
    own_.resize(points_.size(), false);
    for (const PointLine& line : points_.lines) {
      for (const std::uint32_t point : line.points) {
        if (own_[point]) continue;
        const double x = points_.x[point], y = points_.y[point];
        const double near = 1e-9 * spacing_;
        edges_.each_near(y - near, y + near, [&](std::size_t e) {
          const auto& [from, to] = edges_.edge(e);
          const double dx = to[0] - from[0], dy = to[1] - from[1], square = dx * dx + dy * dy;
          const double along = ((x - from[0]) * dx + (y - from[1]) * dy) / square;
          const double off = std::abs((x - from[0]) * dy - (y - from[1]) * dx) / std::sqrt(square);
          const double slack = near / std::sqrt(square);
          if (own_[point] || !(off <= near) || along < -slack || along >= 1 - slack) return;
          own_[point] = true;
          meetings_.push_back({e, along <= slack ? 0 : along, 0, point});
        });
      }
    }
  }

  bool is_inside(std::uint32_t point) const { return own_[point] || edges_.holds(points_.x[point], points_.y[point]); }

  /// Cuts lines where they cross the boundary, and adds points there.
  void cut_lines() {
    std::vector<PointLine> kept;
    for (const PointLine& line : points_.lines) {
      PointLine part{{}, line.name, line.keeps_vertices};
      const auto finish = [&] {
        if (part.points.size() > 1) kept.push_back(part);
        part.points.clear();
      };
      for (std::size_t k = 0; k + 1 < line.points.size(); ++k) {
        const std::uint32_t a = line.points[k], b = line.points[k + 1];
        if (part.points.empty() && is_inside(a)) part.points.push_back(a);
        for (const Meeting& meeting : meetings_of(a, b)) {
          part.points.push_back(meeting.point);
          const Place next = place_after(a, b, meeting.along_segment);
          if (!edges_.holds(next[0], next[1])) finish();
        }
        if (is_inside(b)) {
          part.points.push_back(b);
        } else {
          finish();
        }
      }
      finish();
    }
    points_.lines = std::move(kept);
  }

  /// A place a little farther along a segment than `share`.
  Place place_after(std::uint32_t a, std::uint32_t b, double share) const {
    const double farther = share + (1 - share) * 1e-6;
    return {points_.x[a] + farther * (points_.x[b] - points_.x[a]),
            points_.y[a] + farther * (points_.y[b] - points_.y[a])};
  }

  /// Crossings of a segment with the boundary, in order. Each becomes a point of both.
  std::vector<Meeting> meetings_of(std::uint32_t a, std::uint32_t b) {
    std::vector<Meeting> found;
    const double ax = points_.x[a], ay = points_.y[a], bx = points_.x[b], by = points_.y[b];
    edges_.each_near(ay, by, [&](std::size_t e) {
      const auto& [from, to] = edges_.edge(e);
      const double ux = bx - ax, uy = by - ay, vx = to[0] - from[0], vy = to[1] - from[1];
      const double cross = ux * vy - uy * vx;
      if (cross == 0) return;
      const double wx = from[0] - ax, wy = from[1] - ay;
      const double s = (wx * vy - wy * vx) / cross, t = (wx * uy - wy * ux) / cross;
      if (!(s > 0 && s < 1 && t > 0 && t < 1)) return;
      found.push_back({e, t, s, 0});
    });
    std::sort(found.begin(), found.end(),
              [](const Meeting& p, const Meeting& q) { return p.along_segment < q.along_segment; });
    for (Meeting& meeting : found) {
      const double s = meeting.along_segment;
      const double z = points_.z[a] + s * (points_.z[b] - points_.z[a]);
      meeting.point = add_point(points_, ax + s * (bx - ax), ay + s * (by - ay), z);
      own_.resize(points_.size(), false);
      own_[meeting.point] = true;
      meetings_.push_back(meeting);
    }
    return found;
  }

  /// Drops the points outside the boundary and returns their number.
  std::uint64_t drop_outside() {
    const std::size_t given = points_.size();
    const auto names =
        grid::keep_points(points_, [&](std::size_t i) { return own_[i] || edges_.holds(points_.x[i], points_.y[i]); });
    for (Meeting& meeting : meetings_) meeting.point = names[meeting.point];
    return given - points_.size();
  }

  void add_rings(const refine::PointSurface& surface, BoundaryCut& cut) {
    std::sort(meetings_.begin(), meetings_.end(), [](const Meeting& p, const Meeting& q) {
      return p.edge != q.edge ? p.edge < q.edge : p.along_edge < q.along_edge;
    });
    note_edges_of_lines();
    auto meeting = meetings_.begin();
    std::size_t edge = 0;
    for (const Line& ring : rings_) {
      std::vector<std::uint32_t> corners;
      for (std::size_t k = 0; k + 1 < ring.points.size(); ++k, ++edge) {
        const double x = ring.points[k][0], y = ring.points[k][1];
        if (meeting != meetings_.end() && meeting->edge == edge && meeting->along_edge == 0) {
          corners.push_back((meeting++)->point);
        } else {
          const auto height = surface.at(x, y);
          if (height.distance > 0) ++cut.corners_beyond;
          cut.farthest = std::max(cut.farthest, height.distance);
          corners.push_back(add_point(points_, x, y, height.z));
        }
        for (; meeting != meetings_.end() && meeting->edge == edge; ++meeting) {
          if (!is_edge_of_line(corners.back(), meeting->point))
            follow(surface, {points_.x[meeting->point], points_.y[meeting->point], points_.z[meeting->point]}, corners);
          corners.push_back(meeting->point);
        }
        std::optional<std::uint32_t> next;
        if (k + 2 == ring.points.size()) {
          next = corners.front();
        } else if (meeting != meetings_.end() && meeting->edge == edge + 1 && meeting->along_edge == 0) {
          next = meeting->point;
        }
        if (next && is_edge_of_line(corners.back(), *next)) continue;
        const double next_x = ring.points[k + 1][0], next_y = ring.points[k + 1][1];
        const double next_z = next ? points_.z[*next] : surface.at(next_x, next_y).z;
        follow(surface, {next_x, next_y, next_z}, corners);
      }
      cut.corners += corners.size();
      points_.boundary.push_back(std::move(corners));
    }
  }

  void note_edges_of_lines() {
    for (const PointLine& line : points_.lines) {
      for (std::size_t k = 0; k + 1 < line.points.size(); ++k)
        line_edges_.push_back(std::minmax({line.points[k], line.points[k + 1]}));
    }
    std::sort(line_edges_.begin(), line_edges_.end());
  }

  bool is_edge_of_line(std::uint32_t a, std::uint32_t b) const {
    return std::binary_search(line_edges_.begin(), line_edges_.end(),
                              std::pair<std::uint32_t, std::uint32_t>(std::minmax({a, b})));
  }

  /// Adds the corners between the last one and `to` that the surface along the edge needs.
  void follow(const refine::PointSurface& surface, const std::array<double, 3>& to,
              std::vector<std::uint32_t>& corners) {
    constexpr double kMostPlaces = 4096;
    const std::uint32_t last = corners.back();
    const std::array<double, 3> from{points_.x[last], points_.y[last], points_.z[last]};
    const double length = std::hypot(to[0] - from[0], to[1] - from[1]);
    const auto count = static_cast<std::size_t>(std::clamp(length / spacing_, 1.0, kMostPlaces));
    std::vector<double> heights(count + 1, from[2]);
    heights[count] = to[2];
    const auto place = [&](std::size_t i) {
      const double share = static_cast<double>(i) / static_cast<double>(count);
      return Place{from[0] + share * (to[0] - from[0]), from[1] + share * (to[1] - from[1])};
    };
    for (std::size_t i = 1; i < count; ++i) heights[i] = surface.at(place(i)[0], place(i)[1]).z;
    std::vector<std::size_t> ends{count};
    for (std::size_t begin = 0; !ends.empty();) {
      const std::size_t end = ends.back();
      double largest = tolerance_;
      std::size_t split = end;
      for (std::size_t i = begin + 1; i < end; ++i) {
        const double share = static_cast<double>(i - begin) / static_cast<double>(end - begin);
        const double off = std::abs(heights[begin] + share * (heights[end] - heights[begin]) - heights[i]);
        if (off <= largest) continue;
        largest = off;
        split = i;
      }
      if (split != end) {
        ends.push_back(split);
        continue;
      }
      if (end != count) corners.push_back(add_point(points_, place(end)[0], place(end)[1], heights[end]));
      begin = end;
      ends.pop_back();
    }
  }

  std::span<const Line> rings_;
  RingBands edges_;
  PointSet& points_;
  double tolerance_, spacing_ = 1;
  DuplicatePolicy duplicates_;
  std::vector<Meeting> meetings_;
  std::vector<std::pair<std::uint32_t, std::uint32_t>> line_edges_;  // the lower point first, sorted
  std::vector<bool> own_;                                            // by point: true for a meeting
};

}  // namespace

Result<std::uint64_t> add_lines(std::span<const Line> lines, PointSet& points, DuplicatePolicy duplicates) {
  const bool any_soft = std::any_of(lines.begin(), lines.end(), [](const Line& line) {
    return std::any_of(line.points.begin(), line.points.end(), [](const auto& point) { return std::isnan(point[2]); });
  });
  std::optional<refine::PointSurface> surface;
  if (any_soft) {
    SCARP_TRY(auto&& made, refine::PointSurface::make(points, duplicates));
    surface.emplace(std::move(made));
  }
  std::uint64_t beyond = 0;
  for (const Line& line : lines) {
    PointLine chain{{}, line.name, true};
    for (const auto& [x, y, z] : line.points) {
      const auto height = std::isnan(z) ? surface->at(x, y) : refine::PointSurface::Height{z, 0};
      if (height.distance > 0) ++beyond;
      chain.points.push_back(add_point(points, x, y, height.z));
    }
    if (line.is_ring()) {
      chain.points.back() = chain.points.front();
      points.x.pop_back();
      points.y.pop_back();
      points.z.pop_back();
    }
    points.lines.push_back(std::move(chain));
  }
  return beyond;
}

namespace {

std::uint64_t keep_side(std::span<const Line> rings, bool is_inside, PointSet& points) {
  const RingBands edges(places_of(rings));
  const std::size_t given = points.size();
  points.lines.clear();
  grid::keep_points(points, [&](std::size_t i) { return edges.holds(points.x[i], points.y[i]) == is_inside; });
  return given - points.size();
}

}  // namespace

std::uint64_t drop_outside(std::span<const Line> rings, PointSet& points) { return keep_side(rings, true, points); }
std::uint64_t drop_inside(std::span<const Line> rings, PointSet& points) { return keep_side(rings, false, points); }

Result<BoundaryCut> cut_to_boundary(std::span<const Line> rings, double tolerance, PointSet& points,
                                    DuplicatePolicy duplicates) {
  if (rings.empty()) return fail(ErrorKind::kInput, "the boundary has no polygon");
  return BoundaryMaker(rings, tolerance, points, duplicates).run();
}

}  // namespace scarp
