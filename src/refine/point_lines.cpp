#include "refine/point_lines.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <optional>
#include <utility>

#include "geom/predicates.h"

namespace scarp::refine {

namespace {

/// True if p is on the segment, but not at its ends.
bool is_within(const geom::Segment& s, Point p) {
  if (p == s.from || p == s.to || orient(s.from, s.to, p) != 0) return false;
  return std::min(s.from.x, s.to.x) <= p.x && p.x <= std::max(s.from.x, s.to.x) && std::min(s.from.y, s.to.y) <= p.y &&
         p.y <= std::max(s.from.y, s.to.y);
}

bool cross(const geom::Segment& s, const geom::Segment& t) {
  return sign_of(orient(s.from, s.to, t.from)) * sign_of(orient(s.from, s.to, t.to)) < 0 &&
         sign_of(orient(t.from, t.to, s.from)) * sign_of(orient(t.from, t.to, s.to)) < 0;
}

bool meet(const geom::Segment& s, const geom::Segment& t) {
  return cross(s, t) || is_within(s, t.from) || is_within(s, t.to) || is_within(t, s.from) || is_within(t, s.to);
}

double length_of(const geom::Segment& s) { return std::hypot(double(s.to.x) - s.from.x, double(s.to.y) - s.from.y); }

class DelaunayRule final : public tin::FlipRule {
 public:
  bool should_flip(const tin::Triangulation& tin, tin::HalfEdge h) override {
    const Point d = tin.point(tin.origin(tin::Triangulation::previous(tin.twin(h))));
    const std::array<Point, 3> corners = tin.corners(h / 3);
    return geom::in_circle(corners[0], corners[1], corners[2], d) > 0;
  }
};

/// Removes all constraints but the hull's.
void release_all(tin::Triangulation& tin) {
  for (tin::HalfEdge h = 0; h < 3 * tin.triangle_count(); ++h) {
    const tin::HalfEdge g = tin.twin(h);
    if (g != tin::kNone && tin.is_outside(h / 3) == tin.is_outside(g / 3)) tin.release(h);
  }
}

void restore_delaunay(tin::Triangulation& tin) {
  std::vector<tin::HalfEdge> edges;
  for (tin::HalfEdge h = 0; h < 3 * tin.triangle_count(); ++h) {
    if (tin.twin(h) != tin::kNone && h < tin.twin(h)) edges.push_back(h);
  }
  DelaunayRule rule;
  tin.improve(edges, rule, std::numeric_limits<std::size_t>::max());
}

}  // namespace

std::vector<bool> find_vertices(const ScatteredDomain& domain, std::size_t points) {
  std::vector<bool> is_vertex(points);
  for (const std::uint32_t point : domain.point_of) {
    if (point != tin::kNone) is_vertex[point] = true;
  }
  return is_vertex;
}

Result<PointLines> PointLines::build(const PointSet& points, const grid::SnappedPoints& snapped) {
  PointLines result(points, snapped);
  result.is_on_line_.resize(snapped.size());
  for (std::uint32_t k = 0; k < points.lines.size(); ++k) {
    std::vector<std::uint32_t> line, sources;
    for (const std::uint32_t source : points.lines[k].points) {
      const std::uint32_t point = snapped.place[source];
      if (!line.empty() && line.back() == point) continue;
      line.push_back(point);
      sources.push_back(source);
      result.is_on_line_[point] = true;
    }
    if (line.size() < 2) continue;
    result.lines_.push_back(std::move(line));
    result.sources_.push_back(std::move(sources));
    result.given_.push_back(k);
  }
  SCARP_RETURN_IF_ERROR(result.check_meetings());
  return result;
}

Result<void> PointLines::check_meetings() const {
  std::vector<geom::Segment> segments;
  std::vector<std::pair<std::uint32_t, std::uint32_t>> owners;  // line, first point
  for (std::uint32_t line = 0; line < lines_.size(); ++line) {
    for (std::uint32_t k = 0; k + 1 < lines_[line].size(); ++k) {
      segments.push_back({at(line, k), at(line, k + 1)});
      owners.emplace_back(line, k);
    }
  }
  // If snapping moves lines, heights where they meet are uncertain by the lines' climb there.
  const double moved = snapped_->is_exact ? 0 : 2;
  const auto z_at = [&](std::uint32_t line, std::size_t k) { return points_->z[sources_[line][k]]; };
  std::optional<Error> error;
  const auto compare = [&](std::uint32_t a, double za, std::uint32_t b, double zb, double climb, double x, double y) {
    if (error || std::abs(za - zb) <= 1e-9 * (std::abs(za) + std::abs(zb)) + climb) return;
    if (a > b) {
      std::swap(a, b);
      std::swap(za, zb);
    }
    const std::string &one = points_->lines[given_[a]].name, &other = points_->lines[given_[b]].name;
    error =
        Error{ErrorKind::kInput,
              fmt::format("{} at ({:.12g}, {:.12g}) with the heights {:.12g} and {:.12g}: correct one of the two, "
                          "or leave it out",
                          a == b ? one + " crosses itself" : fmt::format("{} and {} meet", one, other), x, y, za, zb)};
  };
  // Common vertices first.
  std::vector<std::uint32_t> first(snapped_->size(), tin::kNone);
  for (std::uint32_t s = 0; s < segments.size() + lines_.size(); ++s) {
    const bool is_last = s >= segments.size();
    const std::uint32_t line = is_last ? static_cast<std::uint32_t>(s - segments.size()) : owners[s].first;
    const std::size_t k = is_last ? lines_[line].size() - 1 : owners[s].second;
    const std::uint32_t source = sources_[line][k];
    std::uint32_t& before = first[lines_[line][k]];
    if (before == tin::kNone) {
      before = s;
      continue;
    }
    const bool was_last = before >= segments.size();
    const std::uint32_t other = was_last ? static_cast<std::uint32_t>(before - segments.size()) : owners[before].first;
    const double z = z_at(other, was_last ? lines_[other].size() - 1 : owners[before].second);
    if (line != other) compare(other, z, line, points_->z[source], 0, points_->x[source], points_->y[source]);
  }
  geom::visit_neighbours(segments, [&](std::uint32_t i, std::uint32_t j) {
    if (error || !meet(segments[i], segments[j])) return;
    for (auto [s, t] : {std::pair{i, j}, std::pair{j, i}}) {
      const std::uint32_t a = owners[s].first, k = owners[s].second;
      const std::uint32_t b = owners[t].first, m = owners[t].second;
      const double from = z_at(a, k), to = z_at(a, k + 1), climb = std::abs(to - from) / length_of(segments[s]),
                   other_climb = std::abs(z_at(b, m + 1) - z_at(b, m)) / length_of(segments[t]);
      const auto test = [&](double share, double z, double x, double y) {
        compare(a, from + share * (to - from), b, z, moved * (climb + other_climb), x, y);
      };
      for (const std::uint32_t end : {m, m + 1}) {
        const Point p = at(b, end);
        if (!is_within(segments[s], p)) continue;
        const std::uint32_t source = sources_[b][end];
        test(length_of({segments[s].from, p}) / length_of(segments[s]), z_at(b, end), points_->x[source],
             points_->y[source]);
      }
      if (s == i && cross(segments[s], segments[t])) {
        const auto share_of = [](const geom::Segment& of, const geom::Segment& by) {
          const auto before = static_cast<double>(std::abs(orient(by.from, by.to, of.from)));
          return before / (before + static_cast<double>(std::abs(orient(by.from, by.to, of.to))));
        };
        const double share = share_of(segments[s], segments[t]), along = share_of(segments[t], segments[s]);
        const std::uint32_t p = sources_[a][k], q = sources_[a][k + 1];
        test(share, z_at(b, m) + along * (z_at(b, m + 1) - z_at(b, m)),
             points_->x[p] + share * (points_->x[q] - points_->x[p]),
             points_->y[p] + share * (points_->y[q] - points_->y[p]));
      }
    }
  });
  if (error) return tl::unexpected(std::move(*error));
  return {};
}

/// The point between the ends that is farthest from the chord; the first one for ties. REQUIRES: a point between the
/// ends.
std::uint32_t PointLines::farthest(const Chord& chord) const {
  const geom::Segment s = segment_of(chord);
  const double dx = double(s.to.x) - s.from.x, dy = double(s.to.y) - s.from.y, square = dx * dx + dy * dy;
  double most = -1;
  std::uint32_t best = 0;
  for (std::uint32_t k = chord.begin + 1; k < chord.end; ++k) {
    const Point p = at(chord.line, k);
    const double x = double(p.x) - s.from.x, y = double(p.y) - s.from.y;
    const double along = square > 0 ? std::clamp((x * dx + y * dy) / square, 0.0, 1.0) : 0;
    const double off_x = x - along * dx, off_y = y - along * dy, distance = off_x * off_x + off_y * off_y;
    if (distance > most) {
      most = distance;
      best = k;
    }
  }
  return best;
}

std::vector<std::uint32_t> PointLines::ends() const {
  std::vector<std::uint32_t> ends;
  for (std::uint32_t line = 0; line < lines_.size(); ++line) {
    if (points_->lines[given_[line]].keeps_vertices) {
      ends.insert(ends.end(), lines_[line].begin(), lines_[line].end());
      continue;
    }
    const auto last = static_cast<std::uint32_t>(lines_[line].size() - 1);
    ends.push_back(lines_[line].front());
    ends.push_back(lines_[line].back());
    if (lines_[line].front() != lines_[line].back() || last < 3) continue;
    const std::uint32_t far = farthest({line, 0, last});
    ends.push_back(lines_[line][far]);
    const geom::Segment across{at(line, 0), at(line, far)};
    std::int64_t most = -1;
    std::uint32_t third = 0;
    for (std::uint32_t k = 1; k < last; ++k) {
      const std::int64_t off = std::abs(orient(across.from, across.to, at(line, k)));
      if (off > most) {
        most = off;
        third = k;
      }
    }
    ends.push_back(lines_[line][third]);
  }
  return ends;
}

std::vector<PointLines::Chord> PointLines::find_chords(const std::vector<bool>& is_vertex) const {
  std::vector<Chord> chords;
  for (std::uint32_t line = 0; line < lines_.size(); ++line) {
    std::uint32_t begin = 0;
    for (std::uint32_t k = 1; k < lines_[line].size(); ++k) {
      if (!is_vertex[lines_[line][k]]) continue;
      chords.push_back({line, begin, k});
      begin = k;
    }
  }
  return chords;
}

std::vector<std::uint32_t> PointLines::find_splits(const std::vector<bool>& is_vertex) const {
  const std::vector<Chord> chords = find_chords(is_vertex);
  std::vector<geom::Segment> segments;
  std::vector<std::uint32_t> owners;
  std::vector<bool> is_split(chords.size());
  const auto can_split = [](const Chord& chord) { return chord.end > chord.begin + 1; };
  for (std::uint32_t k = 0; k < chords.size(); ++k) {
    const geom::Segment s = segment_of(chords[k]);
    if (s.from == s.to) {
      is_split[k] = can_split(chords[k]);
      continue;
    }
    segments.push_back(s);
    owners.push_back(k);
  }
  geom::visit_neighbours(segments, [&](std::uint32_t i, std::uint32_t j) {
    const std::uint32_t a = owners[i], b = owners[j];
    if ((!can_split(chords[a]) && !can_split(chords[b])) || !meet(segments[i], segments[j])) return;
    for (const std::uint32_t k : {a, b}) is_split[k] = is_split[k] || can_split(chords[k]);
  });
  std::vector<std::uint32_t> splits;
  for (std::uint32_t k = 0; k < chords.size(); ++k) {
    if (is_split[k]) splits.push_back(lines_[chords[k].line][farthest(chords[k])]);
  }
  return splits;
}

std::uint64_t PointLines::hold(ScatteredDomain& domain) const {
  tin::Triangulation& tin = domain.tin;
  std::vector<tin::Vertex> vertex_of(snapped_->size(), tin::kNone);
  for (tin::Vertex v = 0; v < domain.point_of.size(); ++v) {
    if (domain.point_of[v] != tin::kNone) vertex_of[domain.point_of[v]] = v;
  }
  release_all(tin);
  std::uint64_t loose = 0;
  for (const Chord& chord : find_chords(find_vertices(domain, snapped_->size()))) {
    const tin::Vertex a = vertex_of[lines_[chord.line][chord.begin]], b = vertex_of[lines_[chord.line][chord.end]];
    if (a != b && !tin.constrain(a, b)) ++loose;
  }
  restore_delaunay(tin);
  return loose;
}

}  // namespace scarp::refine
