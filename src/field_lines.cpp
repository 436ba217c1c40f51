#include "field_lines.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <numeric>
#include <utility>

#include "base/parallel.h"
#include "breaklines.h"
#include "grid/affine_map.h"
#include "profile.h"
#include "refine/samples.h"

namespace scarp {

namespace {

/// Gives a soft line the vertices that it needs to follow the raster.
class SoftLine {
 public:
  SoftLine(const Raster& raster, const std::array<double, 6>& affine, double tolerance)
      : raster_(raster), to_samples_(affine), tolerance_(tolerance) {}

  Line follow(const Line& line) const {
    Line result = line;
    result.points.clear();
    for (std::size_t k = 0; k + 1 < line.points.size(); ++k) {
      result.points.push_back(line.points[k]);
      if (std::isnan(line.points[k][2]) || std::isnan(line.points[k + 1][2]))
        add_between(line.points[k], line.points[k + 1], result.points);
    }
    result.points.push_back(line.points.back());
    return result;
  }

 private:
  using Place = std::array<double, 3>;

  static Place between(const Place& a, const Place& b, double share) {
    return {a[0] + share * (b[0] - a[0]), a[1] + share * (b[1] - a[1]), std::numeric_limits<double>::quiet_NaN()};
  }
  /// The raster's surface there; NaN beyond it.
  double height_at(const Place& place) const {
    const auto [col, row] = to_samples_.place(place[0], place[1]);
    if (!(col >= 0 && row >= 0 && col <= raster_.cols - 1 && row <= raster_.rows - 1)) return NAN;
    return height_between_samples(raster_, {static_cast<std::int32_t>(std::lround(col * kLatticeSteps)),
                                            static_cast<std::int32_t>(std::lround(row * kLatticeSteps))});
  }

  /// Bends where the surface asks for it. Two looks a sample.
  void add_between(const Place& from, const Place& to, std::vector<Place>& points) const {
    const SamplePlace way = to_samples_.way(to[0] - from[0], to[1] - from[1]);
    const double length = std::hypot(way.col, way.row);
    constexpr double kMostLooks = 1 << 20;
    const auto looks = static_cast<std::size_t>(std::min(std::ceil(2 * length), kMostLooks));
    if (looks < 2) return;
    std::vector<double> heights;
    for (std::size_t i = 0; i <= looks; ++i)
      heights.push_back(height_at(between(from, to, static_cast<double>(i) / static_cast<double>(looks))));
    for (const std::size_t i : find_bends(heights, tolerance_))
      points.push_back(between(from, to, static_cast<double>(i) / static_cast<double>(looks)));
  }

  const Raster& raster_;
  MapToSamples to_samples_;
  double tolerance_;
};

/// The edges of lines, and the points that they need.
ConstraintGraph graph_of(const Breaklines& placed) {
  ConstraintGraph graph;
  std::vector<std::uint32_t> numbers(placed.points.size(), kNone);
  const auto number_of = [&](std::uint32_t point) {
    if (numbers[point] == kNone) {
      numbers[point] = static_cast<std::uint32_t>(graph.points.size());
      graph.points.push_back(placed.points[point]);
      graph.heights.push_back(placed.heights[point]);
    }
    return numbers[point];
  };
  for (std::size_t i = 0; i < placed.edges.size(); ++i) {
    const Arrangement::Edge& edge = placed.edges[i];
    if (!edge.is_line) continue;
    const std::uint32_t a = number_of(edge.a), b = number_of(edge.b);
    graph.edges.push_back({a, b});
    if (!placed.is_held.empty()) graph.is_start.push_back(placed.is_held[i] ? 0 : 1);
  }
  return graph;
}

/// Calls visit(sample, share) for the samples on a closed edge, share from a to b.
template <class Visit>
void visit_samples(Point a, Point b, const Visit& visit) {
  const std::int32_t dx = b.x - a.x, dy = b.y - a.y, steps = std::gcd(std::abs(dx), std::abs(dy));
  for (std::int32_t i = 0; i <= steps; ++i) {
    const Point p{a.x + dx / steps * i, a.y + dy / steps * i};
    if (PlaceHeights::is_sample(p))
      visit(Point{p.x / kLatticeSteps, p.y / kLatticeSteps}, static_cast<double>(i) / steps);
  }
}

/// Gives the samples on hard lines, but for faults, the heights of the lines.
void edit_samples(const Breaklines& placed, std::int32_t cols, FieldLines& lines) {
  const auto edit = [&](Point p, double height) {
    float& sample =
        lines.samples[static_cast<std::size_t>(p.y) * static_cast<std::size_t>(cols) + static_cast<std::size_t>(p.x)];
    const auto after = static_cast<float>(height);
    if (std::isnan(sample) || sample == after) return;
    lines.edits.push_back({p.x, p.y, sample, after});
    sample = after;
  };
  for (std::size_t i = 0; i < placed.edges.size(); ++i) {
    const Arrangement::Edge& edge = placed.edges[i];
    if (!edge.is_line || !placed.is_hard[edge.a] || !placed.is_hard[edge.b]) continue;
    if (!placed.is_held.empty() && !placed.is_held[i]) continue;
    const double from{placed.heights[edge.a]}, to{placed.heights[edge.b]};
    visit_samples(placed.points[edge.a], placed.points[edge.b],
                  [&](Point p, double share) { edit(p, from + share * (to - from)); });
  }
  for (std::size_t i = 0; i < placed.points.size(); ++i) {
    const Point p = placed.points[i];
    if (placed.is_hard[i] && PlaceHeights::is_sample(p))
      edit({p.x / kLatticeSteps, p.y / kLatticeSteps}, placed.heights[i]);
  }
  std::sort(lines.edits.begin(), lines.edits.end(), [](const SampleEdit& a, const SampleEdit& b) {
    return before({a.col, a.row}, {b.col, b.row});
  });
}

}  // namespace

HeightField FieldLines::apply(const HeightField& field) const {
  HeightField edited = field;
  if (samples.empty()) return edited;
  edited.samples = samples.data();
  edited.nodata = std::nullopt;
  return edited;
}

Result<FieldLines> prepare_lines(const HeightField& field, const LineConstraints& lines, double tolerance,
                                 int threads) {
  auto cleaned = Samples::of(field);
  if (!cleaned) return tl::unexpected(cleaned.error());
  const Raster raster = cleaned->raster();
  const SoftLine soft(raster, lines.affine, tolerance);
  std::vector<Line> followed(lines.lines.size());
  constexpr std::size_t kTogether = 64;
  parallel_for((followed.size() + kTogether - 1) / kTogether, threads, [&](std::size_t part) {
    const std::size_t first = part * kTogether, end = std::min(first + kTogether, followed.size());
    for (std::size_t k = first; k < end; ++k) followed[k] = soft.follow(lines.lines[k]);
  });
  const auto placed = place_breaklines(followed, lines.affine, raster, trace_outline(raster), lines.conflict);
  if (!placed) return tl::unexpected(placed.error());
  FieldLines result;
  result.graph = graph_of(*placed);
  if (std::find(placed->is_hard.begin(), placed->is_hard.end(), true) != placed->is_hard.end()) {
    result.samples.assign(raster.samples, raster.row(raster.rows));
    edit_samples(*placed, raster.cols, result);
  }
  result.laid = lines.lines.size() - placed->outside;
  return result;
}

}  // namespace scarp
