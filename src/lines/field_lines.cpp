#include "lines/field_lines.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <numeric>
#include <utility>

#include "base/parallel.h"
#include "geom/polygon_cover.h"
#include "grid/affine_map.h"
#include "grid/line_positions.h"
#include "grid/samples.h"
#include "lines/breaklines.h"
#include "lines/field_cut.h"
#include "lines/profile.h"
#include "scarp/height_field.h"

namespace scarp::lines {

namespace {

/// Adds the vertices that a soft line needs to follow the raster. Vertices of a cutline's ring are at least a sample
/// apart if possible, and on samples if the ring passes any, because very short edges produce slivers.
class SoftLine {
 public:
  SoftLine(const LineSamples& samples, const std::array<double, 6>& affine, double tolerance)
      : samples_(samples), affine_(affine), to_samples_(affine), tolerance_(tolerance) {}

  /// `is_cut`: a clipped ring. It gets no vertices along the raster's sides, which other edges follow.
  Line follow(const Line& line, bool is_cut = false) const {
    Line result = line;
    result.points.clear();
    std::vector<double> heights;
    for (std::size_t k = 0; k + 1 < line.points.size(); ++k) {
      result.points.push_back(line.points[k]);
      if (is_cut && is_along_side(line.points[k], line.points[k + 1])) continue;
      if (std::isnan(line.points[k][2]) || std::isnan(line.points[k + 1][2]))
        add_between(line.points[k], line.points[k + 1], is_cut, heights, result.points);
    }
    result.points.push_back(line.points.back());
    return result;
  }

 private:
  using Place = std::array<double, 3>;
  static constexpr std::size_t kLooksASample = 2;

  static Place between(const Place& a, const Place& b, double share) {
    return {a[0] + share * (b[0] - a[0]), a[1] + share * (b[1] - a[1]), std::numeric_limits<double>::quiet_NaN()};
  }
  /// Column and row.
  std::array<double, 2> sample_of(const Place& place) const {
    const auto [col, row] = to_samples_.position(place[0], place[1]);
    return {col, row};
  }
  /// True if both are on the same side of the raster's rectangle, up to rounding.
  bool is_along_side(const Place& a, const Place& b) const {
    const auto p = sample_of(a), q = sample_of(b);
    const std::array<double, 2> last{samples_.cols() - 1.0, samples_.rows() - 1.0};
    for (const std::size_t axis : {0, 1}) {
      for (const double side : {0.0, last[axis]}) {
        if (std::max(std::abs(p[axis] - side), std::abs(q[axis] - side)) < 0.5 / grid::kLatticeSteps) return true;
      }
    }
    return false;
  }
  /// The nearest sample if it lies on the line between both places; else the place itself.
  Place on_sample(const Place& place, const Place& from, const Place& to) const {
    const auto p = sample_of(from), q = sample_of(to), at = sample_of(place);
    const double col = std::round(at[0]), row = std::round(at[1]), dx = q[0] - p[0], dy = q[1] - p[1];
    const double beside = (col - p[0]) * dy - (row - p[1]) * dx, along = (col - p[0]) * dx + (row - p[1]) * dy;
    const double length = std::hypot(dx, dy);
    if (std::abs(beside) >= 0.5 / grid::kLatticeSteps * length || !(along > 0 && along < length * length)) return place;
    return {affine_[0] + affine_[1] * col + affine_[2] * row, affine_[3] + affine_[4] * col + affine_[5] * row,
            std::numeric_limits<double>::quiet_NaN()};
  }
  /// The raster's height at a place; NaN beyond it.
  double height_at(const Place& place) const {
    const auto [col, row] = sample_of(place);
    return surface_at(samples_, {col, row});
  }

  /// Adds bends required by the surface. Visits two positions per sample, and stores their heights in `heights`.
  void add_between(const Place& from, const Place& to, bool is_cut, std::vector<double>& heights,
                   std::vector<Place>& points) const {
    const grid::SamplePosition way = to_samples_.way(to[0] - from[0], to[1] - from[1]);
    const double length = std::hypot(way.col, way.row);
    constexpr double kMostLooks = 1 << 20;
    const auto looks =
        static_cast<std::size_t>(std::min(std::ceil(static_cast<double>(kLooksASample) * length), kMostLooks));
    if (looks < 2) return;
    heights.clear();
    for (std::size_t i = 0; i <= looks; ++i)
      heights.push_back(height_at(between(from, to, static_cast<double>(i) / static_cast<double>(looks))));
    for (const std::size_t i : find_bends(heights, tolerance_, is_cut ? kLooksASample : 1)) {
      const Place place = between(from, to, static_cast<double>(i) / static_cast<double>(looks));
      points.push_back(is_cut ? on_sample(place, from, to) : place);
    }
  }

  const LineSamples& samples_;
  std::array<double, 6> affine_;
  grid::MapToSamples to_samples_;
  double tolerance_;
};

/// Edges that are part of lines.
std::vector<geom::GraphEdge> edges_of_lines(const Breaklines& placed) {
  std::vector<geom::GraphEdge> edges;
  for (const geom::Arrangement::Edge& edge : placed.edges) {
    if (edge.is_line) edges.push_back({edge.a, edge.b});
  }
  return edges;
}

/// For each edge of lines, 1 if only walls run there. EMPTY: no walls.
std::vector<std::uint8_t> starts_of_lines(const Breaklines& placed) {
  std::vector<std::uint8_t> is_start;
  for (std::size_t i = 0; i < placed.is_held.size(); ++i) {
    if (placed.edges[i].is_line) is_start.push_back(placed.is_held[i] ? 0 : 1);
  }
  return is_start;
}

/// The edges that the lines with numbers [first, end) pass.
std::vector<geom::PolygonEdge> passes_of(const Breaklines& placed, std::span<const Line> lines, std::size_t first,
                                         std::size_t end) {
  std::vector<geom::PolygonEdge> passes;
  for (const auto& chain : placed.chains) {
    if (chain.line < first || chain.line >= end) continue;
    const auto points = placed.points_of(chain);
    for (std::size_t k = 0; k + 1 < points.size(); ++k)
      passes.push_back(
          {lines[chain.line].polygon, {std::min(points[k], points[k + 1]), std::max(points[k], points[k + 1])}});
  }
  return passes;
}

/// True if the edge is on the border of the raster's rectangle.
bool is_on_side(Point p, Point q, std::int32_t cols, std::int32_t rows) {
  const std::int32_t right = (cols - 1) * grid::kLatticeSteps, bottom = (rows - 1) * grid::kLatticeSteps;
  return (p.x == q.x && (p.x == 0 || p.x == right)) || (p.y == q.y && (p.y == 0 || p.y == bottom));
}

/// The edges that become part of the mesh, and the cut of the surface.
struct KeptEdges {
  std::vector<geom::GraphEdge> edges;
  std::vector<std::uint8_t> is_start;         ///< see the graph
  std::vector<geom::GraphEdge> walls;         ///< edges at which the surface ends, on their positive side
  std::vector<std::array<Point, 2>> outline;  ///< outline of the rest: the walls, and parts of the raster's sides
};

/// Edges of breaklines in and around polygons, and the outline of the polygons' union.
KeptEdges cut_edges(const Breaklines& placed, std::span<const Line> lines, std::size_t breaklines, std::int32_t cols,
                    std::int32_t rows) {
  const std::vector<geom::GraphEdge> edges = edges_of_lines(placed);
  std::vector<std::uint8_t> is_start(edges.size(), 0);
  for (std::size_t i = 0, line = 0; i < placed.is_held.size(); ++i) {
    if (placed.edges[i].is_line) is_start[line++] = placed.is_held[i] ? 0 : 1;
  }
  const std::vector<geom::EdgeCover> covers =
      geom::cover_edges(placed.points, edges, passes_of(placed, lines, breaklines, lines.size()));
  std::vector<bool> is_breakline(edges.size(), false);
  for (const geom::PolygonEdge& pass : passes_of(placed, lines, 0, breaklines))
    is_breakline[static_cast<std::size_t>(std::lower_bound(edges.begin(), edges.end(), pass.edge) - edges.begin())] =
        true;
  KeptEdges kept;
  for (std::size_t i = 0; i < edges.size(); ++i) {
    const auto [a, b] = edges[i];
    const bool before = covers[i].positive > 0, after = covers[i].negative > 0;
    if (before != after) kept.outline.push_back({placed.points[a], placed.points[b]});
    const bool is_cut_wall = before != after && !is_on_side(placed.points[a], placed.points[b], cols, rows);
    if (is_cut_wall) kept.walls.push_back(before ? edges[i] : geom::GraphEdge{b, a});
    if (!is_cut_wall && !(is_breakline[i] && (before || after))) continue;
    kept.edges.push_back(edges[i]);
    kept.is_start.push_back(is_start[i]);
  }
  return kept;
}

/// All edges, without a cut.
KeptEdges all_edges(const Breaklines& placed) {
  KeptEdges kept;
  kept.edges = edges_of_lines(placed);
  kept.is_start = starts_of_lines(placed);
  return kept;
}

/// The kept edges, with their points.
ConstraintGraph graph_of(const Breaklines& placed, const KeptEdges& kept) {
  ConstraintGraph graph;
  std::vector<std::uint32_t> numbers(placed.points.size(), tin::kNone);
  const auto number_of = [&](std::uint32_t point) {
    if (numbers[point] == tin::kNone) {
      numbers[point] = static_cast<std::uint32_t>(graph.points.size());
      graph.points.push_back(placed.points[point]);
      graph.heights.push_back(placed.heights[point]);
    }
    return numbers[point];
  };
  for (const auto& [a, b] : kept.edges) {
    const std::uint32_t from = number_of(a), to = number_of(b);
    graph.edges.push_back({from, to});
  }
  graph.is_start = kept.is_start;
  if (kept.outline.empty()) return graph;
  graph.cut.emplace();
  for (const auto& [a, b] : kept.walls) graph.cut->walls.push_back({numbers[a], numbers[b]});
  graph.cut->outline = kept.outline;
  return graph;
}

/// Calls visit(sample, share) for the samples on a closed edge, share from a to b.
template <class Visit>
void visit_samples(Point a, Point b, const Visit& visit) {
  const std::int32_t dx = b.x - a.x, dy = b.y - a.y, steps = std::gcd(std::abs(dx), std::abs(dy));
  for (std::int32_t i = 0; i <= steps; ++i) {
    const Point p{a.x + dx / steps * i, a.y + dy / steps * i};
    if (metric::LatticeHeights::is_sample(p))
      visit(Point{p.x / grid::kLatticeSteps, p.y / grid::kLatticeSteps}, static_cast<double>(i) / steps);
  }
}

/// Sets samples on hard lines, except walls, to the heights of the lines. change(p, height) returns the old height.
template <class Change>
std::vector<SampleEdit> edit_samples(const Breaklines& placed, const Change& change) {
  std::vector<SampleEdit> edits;
  const auto edit = [&](Point p, double height) {
    const auto after = static_cast<float>(height);
    const float before = change(p, after);
    if (!std::isnan(before) && before != after) edits.push_back({p.x, p.y, before, after});
  };
  for (std::size_t i = 0; i < placed.edges.size(); ++i) {
    const geom::Arrangement::Edge& edge = placed.edges[i];
    if (!edge.is_line || !placed.is_hard[edge.a] || !placed.is_hard[edge.b]) continue;
    if (!placed.is_held.empty() && !placed.is_held[i]) continue;
    const double from{placed.heights[edge.a]}, to{placed.heights[edge.b]};
    visit_samples(placed.points[edge.a], placed.points[edge.b],
                  [&](Point p, double share) { edit(p, from + share * (to - from)); });
  }
  for (std::size_t i = 0; i < placed.points.size(); ++i) {
    const Point p = placed.points[i];
    if (placed.is_hard[i] && metric::LatticeHeights::is_sample(p))
      edit({p.x / grid::kLatticeSteps, p.y / grid::kLatticeSteps}, placed.heights[i]);
  }
  std::stable_sort(edits.begin(), edits.end(), [](const SampleEdit& a, const SampleEdit& b) {
    return before({a.col, a.row}, {b.col, b.row});
  });
  return edits;
}

/// The graph of the placed lines: the first `breaklines` of `followed`, then rings if there is a cut.
Result<void> take_graph(const Breaklines& placed, std::span<const Line> followed, std::size_t breaklines, bool is_cut,
                        std::int32_t cols, std::int32_t rows, FieldLines& result) {
  // Lines detected in the raster are not counted.
  std::vector<bool> is_inserted(breaklines, !is_cut);
  for (const auto& chain : placed.chains) {
    if (chain.line < breaklines) is_inserted[chain.line] = true;
  }
  for (std::size_t k = 0; k < breaklines; ++k)
    result.inserted += is_inserted[k] && !is_inserted_first(followed[k]) ? 1 : 0;
  if (!is_cut) result.inserted -= placed.outside;
  result.graph = graph_of(placed, is_cut ? cut_edges(placed, followed, breaklines, cols, rows) : all_edges(placed));
  result.graph.is_inserted_first = std::any_of(followed.begin(), followed.end(), is_inserted_first);
  if (!is_cut) return {};
  if (!result.graph.cut)
    return fail(ErrorKind::kInput,
                "the cutline lies beside the raster, or is narrower than 1/256 sample: nothing would be left");
  SurfaceCut& cut = *result.graph.cut;
  cut.rows = std::make_shared<grid::CutRows>(cut.outline, cols, rows);
  std::erase_if(result.edits, [&](const SampleEdit& edit) {
    return cut.rows->side({edit.col, edit.row}) == grid::CutSide::kBeyond;
  });
  return {};
}

/// Sets samples well beyond the cut to nodata.
Result<void> cut_samples(const grid::CutRows& cut, std::int32_t cols, std::int32_t rows, FieldLines& lines) {
  for (const float sample : lines.samples) lines.valid += std::isnan(sample) ? 0 : 1;
  if (!cut.has_surface({lines.samples.data(), cols, rows}))
    return fail(ErrorKind::kInput, "no part of the raster's surface lies in the cutline: it holds nodata only");
  cut.mask_beyond(0, 0, cols, rows, lines.samples.data(), cols);
  return {};
}

}  // namespace

HeightField FieldLines::apply(const HeightField& field) const {
  HeightField edited = field;
  if (source) edited.source = source.get();
  if (samples.empty()) return edited;
  edited.samples = samples.data();
  edited.nodata = std::nullopt;
  return edited;
}

namespace {

/// `count` lines with the vertices that they need. follow(k) returns line k.
template <class Follow>
std::vector<Line> follow_all(std::size_t count, int threads, const Follow& follow) {
  std::vector<Line> followed(count);
  constexpr std::size_t kTogether = 64;
  parallel_for((count + kTogether - 1) / kTogether, threads, [&](std::size_t part) {
    const std::size_t first = part * kTogether, end = std::min(first + kTogether, count);
    for (std::size_t k = first; k < end; ++k) followed[k] = follow(k);
  });
  return followed;
}

/// The breakline farthest from the raster in height, before lines change it. Lines entirely at zero count tenfold,
/// because most of them have no real heights.
FarthestLine find_farthest(std::span<const Line> lines, const std::array<double, 6>& affine,
                           const LineSamples& samples) {
  const grid::MapToSamples to_samples(affine);
  FarthestLine farthest;
  const auto weight = [](double distance, bool is_at_zero) { return (is_at_zero ? 10 : 1) * distance; };
  for (const Line& line : lines) {
    if (line.kind != LineKind::kBreakline) continue;
    double distance = -1;
    bool is_at_zero = true;
    for (const auto& [x, y, z] : line.points) {
      const double way = std::abs(z - surface_at(samples, to_samples.position(x, y)));
      if (way > distance) distance = way;  // NaN: a soft line, or outside the surface
      is_at_zero = is_at_zero && z == 0;
    }
    const bool is_farther = weight(distance, is_at_zero) > weight(farthest.distance, farthest.is_at_zero);
    if (distance < 0 || (!farthest.name.empty() && !is_farther)) continue;
    farthest = {line.name, distance, is_at_zero};
  }
  return farthest;
}

/// prepare_lines() for a streamed raster.
Result<FieldLines> prepare_from_source(const HeightField& field, const LineConstraints& lines, const Cutline& cutline,
                                       double tolerance, int threads, std::span<const std::int32_t> shared_rows) {
  const bool is_cut = !cutline.rings.empty();
  const std::array<double, 6>& affine = is_cut ? cutline.affine : lines.affine;
  const std::vector<Line> rings = clip_rings(cutline, field.cols, field.rows);
  SCARP_TRY(auto&& courses, find_courses(lines.lines, affine, field.cols, field.rows));
  SCARP_TRY(const auto& around, find_courses(rings, affine, field.cols, field.rows));
  courses.insert(courses.end(), around.begin(), around.end());
  SCARP_TRY(auto&& samples, LineSamples::read(field, courses));
  const std::size_t breaklines = lines.lines.size();
  const SoftLine soft(samples, affine, tolerance);
  const std::vector<Line> followed = follow_all(breaklines + rings.size(), threads, [&](std::size_t k) {
    return k < breaklines ? soft.follow(lines.lines[k]) : soft.follow(rings[k - breaklines], true);
  });
  std::vector<geom::Segment> rigid = samples.outline_near();
  const std::int32_t width = (field.cols - 1) * grid::kLatticeSteps;
  for (const std::int32_t row : shared_rows)
    rigid.push_back({{0, row * grid::kLatticeSteps}, {width, row * grid::kLatticeSteps}});
  SCARP_TRY(const auto& placed, place_breaklines(followed, affine, samples, rigid, lines.conflict, is_cut));
  FieldLines result;
  result.farthest = find_farthest(lines.lines, affine, samples);
  result.edits = edit_samples(placed, [&](Point p, float after) { return samples.change(p, after); });
  SCARP_RETURN_IF_ERROR(take_graph(placed, followed, breaklines, is_cut, field.cols, field.rows, result));
  if (!result.edits.empty()) result.source = edit_source({std::shared_ptr<const void>(), field.source}, result.edits);
  return result;
}

}  // namespace

std::uint64_t line_bytes(const HeightField& field, std::span<const Line> lines, const std::array<double, 6>& affine) {
  constexpr double kBytesPerVertex = 300, kBytesPerSample = 100, kBytesPerSampleOfWall = 50;
  const grid::MapToSamples to_samples(affine);
  const double longest = static_cast<double>(field.cols) + field.rows;
  double bytes = 0;
  for (const Line& line : lines) {
    bytes += kBytesPerVertex * static_cast<double>(line.points.size());
    for (std::size_t k = 0; k + 1 < line.points.size(); ++k) {
      const grid::SamplePosition way =
          to_samples.way(line.points[k + 1][0] - line.points[k][0], line.points[k + 1][1] - line.points[k][1]);
      bytes +=
          (is_wall(line) ? kBytesPerSampleOfWall : kBytesPerSample) * std::fmin(std::hypot(way.col, way.row), longest);
    }
  }
  return static_cast<std::uint64_t>(bytes);
}

std::uint64_t copied_bytes(const HeightField& field, const LineConstraints& lines, const Cutline& cutline) {
  const auto is_hard = [](const Line& line) {
    return std::any_of(line.points.begin(), line.points.end(), [](const auto& p) { return !std::isnan(p[2]); });
  };
  const bool is_copied = !cutline.rings.empty() || std::any_of(lines.lines.begin(), lines.lines.end(), is_hard);
  if (field.samples == nullptr || !is_copied) return 0;
  return sizeof(float) * static_cast<std::uint64_t>(field.cols) * static_cast<std::uint64_t>(field.rows);
}

Result<FieldLines> prepare_lines(const HeightField& field, const LineConstraints& lines, const Cutline& cutline,
                                 double tolerance, int threads, std::span<const std::int32_t> shared_rows) {
  for (const Line& ring : cutline.rings) {
    SCARP_RETURN_IF_ERROR(grid::check_line_positions(ring.name, ring.points, cutline.affine));
  }
  if (field.samples == nullptr) return prepare_from_source(field, lines, cutline, tolerance, threads, shared_rows);
  SCARP_TRY(const auto& cleaned, grid::Samples::of(field));
  const grid::Raster raster = cleaned.raster();
  const bool is_cut = !cutline.rings.empty();
  const std::array<double, 6>& affine = is_cut ? cutline.affine : lines.affine;
  const LineSamples samples(raster);
  const SoftLine soft(samples, affine, tolerance);
  const std::vector<Line> rings = clip_rings(cutline, raster.cols, raster.rows);
  const std::size_t breaklines = lines.lines.size();
  const std::vector<Line> followed = follow_all(breaklines + rings.size(), threads, [&](std::size_t k) {
    return k < breaklines ? soft.follow(lines.lines[k]) : soft.follow(rings[k - breaklines], true);
  });
  SCARP_TRY(const auto& placed,
            place_breaklines(followed, affine, raster, grid::trace_outline(raster), lines.conflict, is_cut));
  FieldLines result;
  result.farthest = find_farthest(lines.lines, affine, samples);
  if (is_cut || std::find(placed.is_hard.begin(), placed.is_hard.end(), true) != placed.is_hard.end()) {
    result.samples.assign(raster.samples, raster.row(raster.rows));
    result.edits = edit_samples(placed, [&](Point p, float after) {
      float& sample = result.samples[static_cast<std::size_t>(p.y) * static_cast<std::size_t>(raster.cols) +
                                     static_cast<std::size_t>(p.x)];
      const float before = sample;
      if (!std::isnan(before)) sample = after;
      return before;
    });
  }
  SCARP_RETURN_IF_ERROR(take_graph(placed, followed, breaklines, is_cut, raster.cols, raster.rows, result));
  if (!is_cut) return result;
  SCARP_RETURN_IF_ERROR(cut_samples(*result.graph.cut->rows, raster.cols, raster.rows, result));
  return result;
}

}  // namespace scarp::lines
