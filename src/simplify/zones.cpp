// Materials and node strings of a finished mesh, found by place.
#include "simplify/zones.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <numeric>
#include <utility>

#include "base/sort.h"
#include "scarp/io.h"

namespace scarp::run {

namespace {

struct Spot {
  double x = 0, y = 0;
};

Spot map_of(const Mesh& mesh, const std::array<double, 6>& to_map, double x, double y) {
  x += mesh.origin[0];
  y += mesh.origin[1];
  return {to_map[0] + to_map[1] * x + to_map[2] * y, to_map[3] + to_map[4] * x + to_map[5] * y};
}

struct Extent {
  double west = std::numeric_limits<double>::infinity(), east = -west, south = west, north = -west;

  void include(const std::array<double, 3>& p) {
    west = std::min(west, p[0]);
    east = std::max(east, p[0]);
    south = std::min(south, p[1]);
    north = std::max(north, p[1]);
  }
};

/// Spots in the order of y, for queries of boxes.
class SpotsByRow {
 public:
  explicit SpotsByRow(std::vector<Spot> spots) : spots_(std::move(spots)), order_(spots_.size()) {
    std::iota(order_.begin(), order_.end(), 0u);
    sort_rarely(order_, [this](std::uint32_t a, std::uint32_t b) {
      return spots_[a].y != spots_[b].y ? spots_[a].y < spots_[b].y : a < b;
    });
  }
  const Spot& operator[](std::uint32_t k) const { return spots_[k]; }

  template <class Visit>
  void visit(const Extent& box, Visit&& visit) const {
    auto k = std::lower_bound(order_.begin(), order_.end(), box.south,
                              [this](std::uint32_t a, double south) { return spots_[a].y < south; });
    for (; k != order_.end() && spots_[*k].y <= box.north; ++k) {
      if (spots_[*k].x >= box.west && spots_[*k].x <= box.east) visit(*k);
    }
  }

 private:
  std::vector<Spot> spots_;
  std::vector<std::uint32_t> order_;
};

/// True if p is in the zone, by the even-odd rule over all rings.
bool holds(const Zone& zone, const Spot& p) {
  bool is_inside = false;
  for (const Line& ring : zone.rings) {
    for (std::size_t k = 0; k + 1 < ring.points.size(); ++k) {
      const auto &a = ring.points[k], &b = ring.points[k + 1];
      if ((a[1] > p.y) == (b[1] > p.y)) continue;
      if (p.x < a[0] + (p.y - a[1]) / (b[1] - a[1]) * (b[0] - a[0])) is_inside = !is_inside;
    }
  }
  return is_inside;
}

/// A vertex near a line, and its place along the line: the segment and the share of the segment.
struct Passed {
  double along = 0;
  std::uint32_t vertex = 0;
};

std::vector<Passed> find_passed(const SpotsByRow& spots, const Line& line, double reach) {
  std::vector<Passed> passed;
  for (std::size_t k = 0; k + 1 < line.points.size(); ++k) {
    const auto &a = line.points[k], &b = line.points[k + 1];
    const double dx = b[0] - a[0], dy = b[1] - a[1], square = dx * dx + dy * dy;
    if (!(square > 0)) continue;
    Extent box;
    box.include({a[0] - reach, a[1] - reach, 0});
    box.include({a[0] + reach, a[1] + reach, 0});
    box.include({b[0] - reach, b[1] - reach, 0});
    box.include({b[0] + reach, b[1] + reach, 0});
    spots.visit(box, [&](std::uint32_t v) {
      const double share = std::clamp(((spots[v].x - a[0]) * dx + (spots[v].y - a[1]) * dy) / square, 0.0, 1.0);
      const double off = std::hypot(spots[v].x - a[0] - share * dx, spots[v].y - a[1] - share * dy);
      if (off <= reach) passed.push_back({static_cast<double>(k) + share, v});
    });
  }
  sort_rarely(passed, [](const Passed& a, const Passed& b) {
    return a.along != b.along ? a.along < b.along : a.vertex < b.vertex;
  });
  const auto is_same = [](const Passed& a, const Passed& b) { return a.vertex == b.vertex; };
  passed.erase(std::unique(passed.begin(), passed.end(), is_same), passed.end());
  return passed;
}

class Neighbours {
 public:
  explicit Neighbours(const Mesh& mesh) : begins_(mesh.vertex_count() + 1) {
    for (const std::uint32_t v : mesh.triangles) begins_[v + 1] += 2;
    std::partial_sum(begins_.begin(), begins_.end(), begins_.begin());
    others_.resize(2 * mesh.triangles.size());
    std::vector<std::size_t> end(begins_.begin(), begins_.end() - 1);
    for (std::size_t k = 0; k < mesh.triangles.size(); ++k) {
      const std::size_t t = k - k % 3;
      for (const std::size_t other : {t + (k + 1) % 3, t + (k + 2) % 3})
        others_[end[mesh.triangles[k]]++] = mesh.triangles[other];
    }
  }
  bool are(std::uint32_t a, std::uint32_t b) const {
    const auto first = others_.begin() + static_cast<std::ptrdiff_t>(begins_[a]),
               last = others_.begin() + static_cast<std::ptrdiff_t>(begins_[a + 1]);
    return std::find(first, last, b) != last;
  }

 private:
  std::vector<std::size_t> begins_;
  std::vector<std::uint32_t> others_;
};

}  // namespace

std::vector<std::uint32_t> find_materials(const Mesh& mesh, const std::vector<Zone>& zones,
                                          const std::array<double, 6>& to_map, std::uint32_t elsewhere) {
  std::vector<Spot> centres;
  for (std::size_t t = 0; t < mesh.triangle_count(); ++t) {
    double x = 0, y = 0;
    for (std::size_t k = 3 * t; k < 3 * t + 3; ++k) {
      x += mesh.positions[3 * std::size_t{mesh.triangles[k]}] / 3;
      y += mesh.positions[3 * std::size_t{mesh.triangles[k]} + 1] / 3;
    }
    centres.push_back(map_of(mesh, to_map, x, y));
  }
  const SpotsByRow spots(std::move(centres));
  std::vector<std::uint32_t> materials(mesh.triangle_count(), elsewhere);
  std::vector<bool> is_taken(mesh.triangle_count());
  for (const Zone& zone : zones) {
    Extent box;
    for (const Line& ring : zone.rings) {
      for (const auto& point : ring.points) box.include(point);
    }
    spots.visit(box, [&](std::uint32_t t) {
      if (is_taken[t] || !holds(zone, spots[t])) return;
      is_taken[t] = true;
      materials[t] = zone.material;
    });
  }
  return materials;
}

std::vector<NodeString> find_node_strings(const Mesh& mesh, const std::vector<Line>& lines,
                                          const std::array<double, 6>& to_map, double reach) {
  std::vector<Spot> places;
  for (std::size_t v = 0; v < mesh.vertex_count(); ++v)
    places.push_back(map_of(mesh, to_map, mesh.positions[3 * v], mesh.positions[3 * v + 1]));
  const SpotsByRow spots(std::move(places));
  const Neighbours neighbours(mesh);
  constexpr std::size_t kAhead = 8;  // most vertices next to the line between two vertices of its chain
  std::vector<NodeString> strings;
  for (const Line& line : lines) {
    const std::vector<Passed> passed = find_passed(spots, line, reach);
    NodeString string{line.name, {}};
    const auto finish = [&] {
      if (string.nodes.size() > 1) strings.push_back(string);
      string.nodes.clear();
    };
    for (std::size_t k = 0; k < passed.size();) {
      if (string.nodes.empty()) string.nodes.push_back(passed[k].vertex);
      std::size_t next = k + 1;
      const std::size_t last = std::min(passed.size(), k + 1 + kAhead);
      while (next < last && !neighbours.are(passed[k].vertex, passed[next].vertex)) ++next;
      if (next < last) {
        string.nodes.push_back(passed[next].vertex);
        k = next;
      } else {
        finish();
        ++k;
      }
    }
    finish();
  }
  return strings;
}

}  // namespace scarp::run
