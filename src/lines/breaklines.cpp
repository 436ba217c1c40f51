#include "lines/breaklines.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <optional>

#include "base/caught.h"
#include "grid/affine_map.h"
#include "grid/line_positions.h"

namespace scarp::lines {
namespace {

/// An unrounded vertex, in samples.
struct PathVertex {
  double col = 0, row = 0, z = 0;
};

PathVertex between(const PathVertex& a, const PathVertex& b, double at) {
  return {a.col + at * (b.col - a.col), a.row + at * (b.row - a.row), a.z + at * (b.z - a.z)};
}

/// Narrows [begin, end] to the t with from + t · span in [least, most]. Returns false if there are none.
bool narrow(double from, double span, double least, double most, double& begin, double& end) {
  if (span == 0) return from >= least && from <= most;
  const double a = (least - from) / span, b = (most - from) / span;
  begin = std::max(begin, std::min(a, b));
  end = std::min(end, std::max(a, b));
  return begin <= end;
}

/// Lines in steps, clipped about a sample outside the raster so that every coordinate fits. arrange() clips exactly.
class LatticeLines {
 public:
  LatticeLines(std::int32_t cols, std::int32_t rows) : most_col_(cols), most_row_(rows) {}

  void add(std::uint32_t line, std::span<const PathVertex> vertices) {
    line_ = line;
    for (std::size_t k = 0; k + 1 < vertices.size(); ++k) {
      const PathVertex &from = vertices[k], &to = vertices[k + 1];
      double begin = 0, end = 1;
      if (!narrow(from.col, to.col - from.col, -1, most_col_, begin, end) ||
          !narrow(from.row, to.row - from.row, -1, most_row_, begin, end)) {
        close();
        continue;
      }
      if (begin > 0) close();
      if (part_.empty()) push(begin > 0 ? between(from, to, begin) : from);
      climbs_.back() = climb(from, to);
      push(end < 1 ? between(from, to, end) : to);
      if (end < 1) close();
    }
    close();
  }

  const geom::Polylines& parts() const { return parts_; }
  std::uint32_t line_of(std::uint32_t part) const { return lines_[part]; }

  /// The height of the line at a stop; NaN where it is soft.
  double height_at(std::uint32_t part, const geom::Arrangement::Stop& stop) const {
    const double* z = &heights_[parts_.begins[part] + stop.segment];
    if (stop.fraction == 0) return z[0];
    if (stop.fraction == 1) return z[1];
    return z[0] + stop.fraction * (z[1] - z[0]);
  }
  bool has_heights() const {
    return std::any_of(heights_.begin(), heights_.end(), [](double z) { return !std::isnan(z); });
  }
  /// True if neither end of a segment has a height.
  bool is_soft(std::uint32_t part, std::uint32_t segment) const {
    const double* z = &heights_[parts_.begins[part] + segment];
    return std::isnan(z[0]) && std::isnan(z[1]);
  }
  /// Calls visit(part, point, height, climb) for each point of the parts [from, to) that has a height. climb: the
  /// larger change of height per step in the adjacent segments.
  template <class Visit>
  void visit_points(std::uint32_t from, std::uint32_t to, Visit&& visit) const {
    for (std::uint32_t part = from; part < to; ++part) {
      const std::uint32_t first = parts_.begins[part], end = parts_.begins[part + 1];
      for (std::uint32_t k = first; k < end; ++k) {
        const double behind = k + 1 < end ? climbs_[k] : 0, before = k > first ? climbs_[k - 1] : 0;
        if (!std::isnan(heights_[k])) visit(part, parts_.points[k], heights_[k], std::max(behind, before));
      }
    }
  }
  /// The line's change of height per step at a stop; 0 where it is soft.
  double climb_at(std::uint32_t part, const geom::Arrangement::Stop& stop) const {
    return climbs_[parts_.begins[part] + stop.segment];
  }

 private:
  static std::int32_t in_steps(double samples) {
    return static_cast<std::int32_t>(std::floor(samples * grid::kLatticeSteps + 0.5));
  }
  void push(const PathVertex& v) {
    part_.push_back({in_steps(v.col), in_steps(v.row)});
    heights_.push_back(v.z);
    climbs_.push_back(0);
  }
  /// The change of height per step; 0 for two vertices at one lattice point, whose heights may conflict instead.
  static double climb(const PathVertex& a, const PathVertex& b) {
    const double length = std::max(std::abs(b.col - a.col), std::abs(b.row - a.row)) * grid::kLatticeSteps;
    const double climb = std::abs(b.z - a.z) / length;
    return std::isfinite(climb) ? climb : 0;
  }
  void close() {
    if (part_.empty()) return;
    parts_.add(part_);
    lines_.push_back(line_);
    part_.clear();
  }

  double most_col_, most_row_;
  geom::Polylines parts_;
  std::vector<double> heights_;       ///< heights of the parts' points
  std::vector<double> climbs_;        ///< change per step, from each point to the next
  std::vector<std::uint32_t> lines_;  ///< lines of the parts
  std::uint32_t line_ = 0;
  std::vector<Point> part_;  ///< the part being built
};

std::vector<geom::Segment> segments_of(const grid::Outline& outline) {
  std::vector<geom::Segment> rigid;
  const auto in_steps = [](Point p) { return Point{p.x * grid::kLatticeSteps, p.y * grid::kLatticeSteps}; };
  for (const auto& polygon : outline) {
    for (std::size_t k = 0; k < polygon.size(); ++k)
      rigid.push_back({in_steps(polygon[k]), in_steps(polygon[(k + 1) % polygon.size()])});
  }
  return rigid;
}

/// The heights of hard lines at one point, line by line.
struct Claims {
  std::uint32_t first = 0, last = 0, opponent = 0;  ///< lines; `opponent` differs in height
  std::uint32_t count = 0;                          ///< number of distinct heights, summed over lines
  bool are_opposed = false;
  bool yield = false;  ///< the heights belong to lines that yield
  double first_height = 0, first_tolerance = 0, last_height = 0, opposed_height = 0;
  double sum = 0, highest = 0;
  double climb = 0;  ///< change of the raster per step

  void add(std::uint32_t line, bool yields, double height, double tolerance) {
    if (count > 0 && yields != yield) {
      if (yields) return;
      const double kept = climb;
      *this = {};
      climb = kept;
    }
    yield = yields;
    if (count > 0 && last == line && last_height == height) return;
    if (count++ == 0) {
      first = line;
      first_height = highest = height;
      first_tolerance = tolerance;
    }
    last = line;
    last_height = height;
    sum += height;
    highest = std::max(highest, height);
    if (are_opposed || std::abs(height - first_height) <= tolerance + first_tolerance) return;
    are_opposed = true;
    opponent = line;
    opposed_height = height;
  }
  double height(LineConflict conflict) const {
    if (conflict == LineConflict::kMean) return sum / static_cast<double>(count);
    return conflict == LineConflict::kHighest ? highest : first_height;
  }
};

/// The change of the raster per step, in the cell of a point.
double climb_of(const LineSamples& samples, Point point) {
  const std::int32_t col = std::min(point.x / grid::kLatticeSteps, samples.cols() - 2),
                     row = std::min(point.y / grid::kLatticeSteps, samples.rows() - 2);
  double low = std::numeric_limits<double>::infinity(), high = -low;
  for (const Point p : {Point{col, row}, {col + 1, row}, {col, row + 1}, {col + 1, row + 1}}) {
    if (!samples.is_valid(p)) continue;
    low = std::min(low, double{samples.at(p)});
    high = std::max(high, double{samples.at(p)});
  }
  return low <= high ? (high - low) / grid::kLatticeSteps : 0;
}

/// The claims on each point; empty where no line has heights.
std::vector<Claims> collect_claims(const geom::Arrangement& arranged, const LatticeLines& lattice,
                                   std::span<const Line> lines, const LineSamples& samples) {
  std::vector<Claims> claims;
  if (!lattice.has_heights()) return claims;
  const auto& points = arranged.vertices;
  claims.resize(points.size());
  const auto claim = [&](std::uint32_t point, std::uint32_t part, double height, double climb) {
    Claims& at = claims[point];
    const std::uint32_t line = lattice.line_of(part);
    // Walls change no sample, even if rounding moves a wall onto one, and conflict with no line.
    const Point p = points[point];
    const bool is_sample = p.x % grid::kLatticeSteps == 0 && p.y % grid::kLatticeSteps == 0;
    if (is_wall(lines[line]) && (is_sample || at.count > 0)) return;
    if (at.count == 0) at.climb = climb_of(samples, p);
    at.add(line, lines[line].yields(), height, 2 * std::max(climb, at.climb) + std::abs(height) * 0x1p-23);
  };
  auto chain = arranged.chains.begin();
  for (std::uint32_t part = 0, end = 0; part < lattice.parts().size(); part = end) {
    while (end < lattice.parts().size() && lattice.line_of(end) == lattice.line_of(part)) ++end;
    for (; chain != arranged.chains.end() && chain->line < end; ++chain) {
      for (const auto& stretch : arranged.stretches_of(*chain)) {
        if (lattice.is_soft(chain->line, stretch.segment)) continue;
        arranged.visit_stops(stretch, [&](const geom::Arrangement::Stop& stop) {
          const double height = lattice.height_at(chain->line, stop);
          if (!std::isnan(height)) claim(stop.vertex, chain->line, height, lattice.climb_at(chain->line, stop));
        });
      }
    }
    // A chain stops once where two vertices share a lattice point.
    lattice.visit_points(part, end, [&](std::uint32_t of, Point p, double height, double climb) {
      const auto found = std::lower_bound(points.begin(), points.end(), p, before);
      if (found == points.end() || *found != p) return;
      claim(static_cast<std::uint32_t>(found - points.begin()), of, height, climb);
    });
  }
  return claims;
}

Result<void> set_heights(std::span<const Claims> claims, std::span<const Line> lines,
                         const std::array<double, 6>& affine, LineConflict conflict, Breaklines& placed) {
  for (std::size_t point = 0; point < claims.size(); ++point) {
    const Claims& at = claims[point];
    if (at.count == 0) continue;
    placed.heights[point] = static_cast<float>(at.height(conflict));
    placed.is_hard[point] = true;
    if (!at.are_opposed || conflict != LineConflict::kError) continue;
    const double col = placed.points[point].x / double{grid::kLatticeSteps},
                 row = placed.points[point].y / double{grid::kLatticeSteps};
    return fail(
        ErrorKind::kInput,
        fmt::format("{} has the height {:.9g} and {} has {:.9g} where they meet at {:.9g}, {:.9g}: mend one of "
                    "them, or say which height counts (line conflict: first, mean or highest)",
                    lines[at.first].name, at.first_height,
                    at.first == at.opponent ? "elsewhere along it" : lines[at.opponent].name, at.opposed_height,
                    affine[0] + affine[1] * col + affine[2] * row, affine[3] + affine[4] * col + affine[5] * row));
  }
  return {};
}

Result<LatticeLines> to_lattice(std::span<const Line> lines, const std::array<double, 6>& affine, std::int32_t cols,
                                std::int32_t rows) {
  const grid::MapToSamples to_samples(affine);
  LatticeLines lattice(cols, rows);
  std::vector<PathVertex> vertices;
  for (std::uint32_t k = 0; k < lines.size(); ++k) {
    vertices.clear();
    SCARP_RETURN_IF_ERROR(grid::check_line_positions(lines[k].name, lines[k].points, affine));
    for (const auto& point : lines[k].points) {
      const grid::SamplePosition at = to_samples.position(point[0], point[1]);
      vertices.push_back({at.col, at.row, point[2]});
      if (std::abs(point[2]) > double{std::numeric_limits<float>::max()})
        return fail(ErrorKind::kInput,
                    fmt::format("{} has the height {:.9g}, which is none: heights are float32, of at "
                                "most 3.4e38; mend it, or let the line be soft",
                                lines[k].name, point[2]));
    }
    lattice.add(k, vertices);
  }
  return lattice;
}

/// True for a line that is inserted first but need not remain.
bool is_start(const Line& line) { return is_wall(line) || line.kind == LineKind::kRidge; }

/// By edge: true if the outline, or a line that is no start, runs there. Empty without starts.
std::vector<bool> held_edges(const geom::Arrangement& arranged, const LatticeLines& lattice,
                             std::span<const Line> lines) {
  std::vector<bool> is_held;
  if (std::none_of(lines.begin(), lines.end(), is_start)) return is_held;
  for (const geom::Arrangement::Edge& edge : arranged.edges) is_held.push_back(edge.is_rigid);
  const auto comes_before = [](const geom::Arrangement::Edge& edge,
                               const std::pair<std::uint32_t, std::uint32_t>& ends) {
    return std::pair(edge.a, edge.b) < ends;
  };
  for (const auto& chain : arranged.chains) {
    if (is_start(lines[lattice.line_of(chain.line)])) continue;
    for (const auto& stretch : arranged.stretches_of(chain)) {
      const auto [first, last] = std::minmax(stretch.first, stretch.last);
      for (std::uint32_t k = first; k < last; ++k) {
        const std::pair<std::uint32_t, std::uint32_t> ends = std::minmax(arranged.passes[k], arranged.passes[k + 1]);
        const auto at = std::lower_bound(arranged.edges.begin(), arranged.edges.end(), ends, comes_before);
        is_held[static_cast<std::size_t>(at - arranged.edges.begin())] = true;
      }
    }
  }
  return is_held;
}

/// Sets the chains; counts lines without one.
void take_chains(const geom::Arrangement& arranged, const LatticeLines& lattice, Breaklines& placed) {
  for (const auto& chain : arranged.chains) {
    const auto begin = static_cast<std::uint32_t>(placed.passed.size());
    for (const auto& stop : arranged.stops_of(chain)) placed.passed.push_back(stop.vertex);
    placed.chains.push_back({lattice.line_of(chain.line), begin, static_cast<std::uint32_t>(placed.passed.size())});
  }
}

std::uint64_t count_outside(const geom::Arrangement& arranged, const LatticeLines& lattice, std::size_t lines) {
  std::vector<bool> is_there(lines, false);
  for (const auto& chain : arranged.chains) is_there[lattice.line_of(chain.line)] = true;
  return static_cast<std::uint64_t>(std::count(is_there.begin(), is_there.end(), false));
}

template <class Heights>
double bilinear_at(const Heights& raster, std::int32_t cols, std::int32_t rows, Point point) {
  if (point.x % grid::kLatticeSteps == 0 && point.y % grid::kLatticeSteps == 0)
    return raster.at({point.x / grid::kLatticeSteps, point.y / grid::kLatticeSteps});
  const std::int32_t col = std::min(point.x / grid::kLatticeSteps, cols - 2),
                     row = std::min(point.y / grid::kLatticeSteps, rows - 2);
  const double right = point.x / double{grid::kLatticeSteps} - col, down = point.y / double{grid::kLatticeSteps} - row;
  // Around the cell, so that k and k + 2 are opposite.
  const std::array<double, 4> weights{(1 - right) * (1 - down), right * (1 - down), right * down, (1 - right) * down};
  std::array<double, 4> heights{raster.at({col, row}), raster.at({col + 1, row}), raster.at({col + 1, row + 1}),
                                raster.at({col, row + 1})};
  double whole = 0;
  for (std::size_t k = 0; k < 4; ++k) whole += weights[k] * heights[k];
  if (!std::isnan(whole)) return whole;  // without nodata the exact weights add up to 1
  const auto nodata = std::count_if(heights.begin(), heights.end(), [](double z) { return std::isnan(z); });
  if (nodata == 1) {
    const auto k = static_cast<std::size_t>(
        std::find_if(heights.begin(), heights.end(), [](double z) { return std::isnan(z); }) - heights.begin());
    heights[k] = heights[(k + 1) % 4] + heights[(k + 3) % 4] - heights[(k + 2) % 4];
  }
  double sum = 0, weight = 0;
  for (std::size_t k = 0; k < 4; ++k) {
    if (weights[k] == 0 || std::isnan(heights[k])) continue;
    sum += weights[k] * heights[k];
    weight += weights[k];
  }
  return weight == 0 ? std::numeric_limits<double>::quiet_NaN() : weight == 1 ? sum : sum / weight;
}

}  // namespace

bool is_inserted_first(const Line& line) { return is_wall(line) || is_ridge_line(line); }

double height_between_samples(const grid::SampleView& heights, Point point) {
  return bilinear_at(heights, heights.cols(), heights.rows(), point);
}

double surface_at(const LineSamples& samples, grid::SamplePosition position) {
  if (!(position.col >= 0 && position.row >= 0 && position.col <= samples.cols() - 1 &&
        position.row <= samples.rows() - 1))
    return NAN;
  return bilinear_at(samples, samples.cols(), samples.rows(),
                     {static_cast<std::int32_t>(std::lround(position.col * grid::kLatticeSteps)),
                      static_cast<std::int32_t>(std::lround(position.row * grid::kLatticeSteps))});
}

double surface_at(const grid::Raster& raster, grid::SamplePosition position) {
  return surface_at(LineSamples(raster), position);
}

Result<std::vector<geom::Segment>> find_courses(std::span<const Line> lines, const std::array<double, 6>& affine,
                                                std::int32_t cols, std::int32_t rows) {
  SCARP_TRY(const auto& lattice, to_lattice(lines, affine, cols, rows));
  std::vector<geom::Segment> courses;
  for (std::uint32_t part = 0; part < lattice.parts().size(); ++part) {
    const auto points = lattice.parts()[part];
    for (std::size_t k = 0; k + 1 < points.size(); ++k) courses.push_back({points[k], points[k + 1]});
  }
  return courses;
}

Result<Breaklines> place_breaklines(std::span<const Line> lines, const std::array<double, 6>& affine,
                                    const grid::Raster& raster, const grid::Outline& outline, LineConflict conflict,
                                    bool with_chains) {
  return place_breaklines(lines, affine, LineSamples(raster), segments_of(outline), conflict, with_chains);
}

Result<Breaklines> place_breaklines(std::span<const Line> lines, const std::array<double, 6>& affine,
                                    const LineSamples& samples, std::span<const geom::Segment> rigid,
                                    LineConflict conflict, bool with_chains) try {
  const std::int32_t cols = samples.cols(), rows = samples.rows();
  if (std::max(cols, rows) > kMaxCoordinate / grid::kLatticeSteps)
    return fail(ErrorKind::kUsage, fmt::format("a raster of {} x {} samples is too large for lines: at most {} a side",
                                               cols, rows, kMaxCoordinate / grid::kLatticeSteps));
  SCARP_TRY(const auto& lattice, to_lattice(lines, affine, cols, rows));
  const std::int32_t width = (cols - 1) * grid::kLatticeSteps, height = (rows - 1) * grid::kLatticeSteps;
  std::vector<geom::Segment> fixed{
      {{0, 0}, {width, 0}}, {{width, 0}, {width, height}}, {{width, height}, {0, height}}, {{0, height}, {0, 0}}};
  fixed.insert(fixed.end(), rigid.begin(), rigid.end());
  geom::Arrangement arranged = geom::arrange(lattice.parts(), fixed, width, height);

  const std::vector<Claims> claims = collect_claims(arranged, lattice, lines, samples);
  Breaklines placed;
  placed.outside = count_outside(arranged, lattice, lines.size());
  placed.is_held = held_edges(arranged, lattice, lines);
  if (with_chains) take_chains(arranged, lattice, placed);
  placed.points = std::move(arranged.vertices);
  placed.edges = std::move(arranged.edges);
  placed.heights.reserve(placed.points.size());
  for (const Point p : placed.points) placed.heights.push_back(static_cast<float>(bilinear_at(samples, cols, rows, p)));
  placed.is_hard.assign(placed.points.size(), false);
  SCARP_RETURN_IF_ERROR(set_heights(claims, lines, affine, conflict, placed));
  return placed;
} catch (...) {
  return caught(ErrorKind::kInput, "place the lines on the raster");
}

}  // namespace scarp::lines
