#include "geom/arrangement.h"

#include <algorithm>
#include <utility>

#include "base/radix_sort.h"
#include "geom/courses.h"
#include "geom/hot_points.h"

namespace scarp::geom {
namespace {

/// A part of a line in the rectangle.
struct LinePiece {
  ClippedSegment clipped;
  std::uint32_t segment;
};

/// Successive pieces without a gap.
struct PieceRun {
  std::uint32_t line;
  std::size_t begin, end;
};

struct LinePieces {
  std::vector<LinePiece> pieces;
  std::vector<PieceRun> runs;
};

void cut_line(std::span<const Point> line, std::uint32_t number, std::int32_t width, std::int32_t height,
              LinePieces& cut) {
  bool is_open = false;  // the last run ends where this segment begins
  for (std::uint32_t k = 0; k + 1 < line.size(); ++k) {
    if (line[k] == line[k + 1]) continue;
    LinePiece piece{{}, k};
    if (!clip_segment({line[k], line[k + 1]}, width, height, piece.clipped)) {
      is_open = false;
      continue;
    }
    if (!is_open || piece.clipped.begin > 0) cut.runs.push_back({number, cut.pieces.size(), cut.pieces.size()});
    cut.pieces.push_back(piece);
    cut.runs.back().end = cut.pieces.size();
    is_open = piece.clipped.end == 1;
  }
}

LinePieces cut_lines(const Polylines& lines, std::int32_t width, std::int32_t height) {
  LinePieces cut;
  for (std::uint32_t k = 0; k < lines.size(); ++k) cut_line(lines[k], k, width, height, cut);
  return cut;
}

/// All ends and crossings.
HotPoints find_hot_points(std::span<const Segment> pieces, std::span<const Segment> rigid, const Courses& courses,
                          const Courses& rigid_courses, bool& is_exact) {
  auto [points, are_exact] = find_crossings(courses.segments, rigid_courses.segments);
  is_exact = are_exact;
  points.reserve(points.size() + 2 * (pieces.size() + rigid.size()));
  for (const auto& list : {pieces, rigid}) {
    for (const Segment& s : list) {
      if (points.empty() || points.back() != s.from) points.push_back(s.from);
      points.push_back(s.to);
    }
  }
  sort_uniquely(points);
  return {std::move(points), rigid, is_exact};
}

/// An edge as one number made of its ends, the lower first.
class Edges {
 public:
  explicit Edges(const HotPoints::Passes& passes) {
    keys_.reserve(passes.points.size());
    for (std::size_t k = 0; k + 1 < passes.begins.size(); ++k) {
      for (std::size_t i = passes.begins[k] + 1; i < passes.begins[k + 1]; ++i)
        add(passes.points[i - 1], passes.points[i]);
    }
  }
  const std::vector<std::uint64_t>& sort() {
    radix_sort(keys_, [](std::uint64_t key) { return key; });
    keys_.erase(std::unique(keys_.begin(), keys_.end()), keys_.end());
    return keys_;
  }

 private:
  void add(std::uint32_t a, std::uint32_t b) { keys_.push_back(std::uint64_t{std::min(a, b)} << 32 | std::max(a, b)); }

  std::vector<std::uint64_t> keys_;
};

std::vector<Arrangement::Edge> merge(const std::vector<std::uint64_t>& lines, const std::vector<std::uint64_t>& rigid) {
  std::vector<Arrangement::Edge> edges;
  edges.reserve(lines.size() + rigid.size());
  for (auto line = lines.begin(), fixed = rigid.begin(); line != lines.end() || fixed != rigid.end();) {
    const bool is_line = line != lines.end() && (fixed == rigid.end() || *line <= *fixed),
               is_rigid = fixed != rigid.end() && (line == lines.end() || *fixed <= *line);
    const std::uint64_t key = is_line ? *line : *fixed;
    edges.push_back({static_cast<std::uint32_t>(key >> 32), static_cast<std::uint32_t>(key), is_rigid, is_line});
    line += is_line ? 1 : 0;
    fixed += is_rigid ? 1 : 0;
  }
  return edges;
}

/// Removes unused hot points.
void number_vertices(const std::vector<Point>& points, Arrangement& result) {
  constexpr std::uint32_t kUnused = 0xffffffff;
  std::vector<std::uint32_t> numbers(points.size(), kUnused);
  for (const auto& edge : result.edges) numbers[edge.a] = numbers[edge.b] = 0;
  for (std::size_t k = 0; k < points.size(); ++k) {
    if (numbers[k] == kUnused) continue;
    numbers[k] = static_cast<std::uint32_t>(result.vertices.size());
    result.vertices.push_back(points[k]);
  }
  for (auto& edge : result.edges) edge = {numbers[edge.a], numbers[edge.b], edge.is_rigid, edge.is_line};
  for (std::uint32_t& vertex : result.passes) vertex = numbers[vertex];
}

/// The stretch of a segment in its course.
Arrangement::Stretch stretch_of(const LinePiece& piece, const Segment& course, const HotPoints& hot,
                                const HotPoints::Passes& passes, std::size_t begin, std::size_t end) {
  const auto place_of = [&](Point p) {
    if (p == course.from) return static_cast<std::uint32_t>(begin);
    if (p == course.to) return static_cast<std::uint32_t>(end - 1);
    const auto along = [&](Point q) {
      return std::int64_t{course.to.x - course.from.x} * (q.x - course.from.x) +
             std::int64_t{course.to.y - course.from.y} * (q.y - course.from.y);
    };
    const auto all = std::span(passes.points).subspan(begin, end - begin);
    const auto found = std::partition_point(all.begin(), all.end(),
                                            [&](std::uint32_t k) { return along(hot.points()[k]) < along(p); });
    return static_cast<std::uint32_t>(begin + static_cast<std::size_t>(found - all.begin()));
  };
  const auto& [segment, from, to] = piece.clipped;
  return {piece.segment, place_of(segment.from), place_of(segment.to), from, to};
}

}  // namespace

std::vector<Arrangement::Stop> Arrangement::stops_of(const Chain& chain) const {
  std::vector<Stop> stops;
  for (const Stretch& stretch : stretches_of(chain)) {
    visit_stops(stretch, [&](const Stop& stop) {
      if (stops.empty() || stops.back().vertex != stop.vertex) stops.push_back(stop);
    });
  }
  return stops;
}

Arrangement arrange(const Polylines& lines, std::span<const Segment> rigid, std::int32_t width, std::int32_t height) {
  Arrangement result;
  const LinePieces cut = cut_lines(lines, width, height);
  std::vector<Segment> segments;
  segments.reserve(cut.pieces.size());
  for (const LinePiece& piece : cut.pieces) segments.push_back(piece.clipped.segment);
  const Courses courses = merge_overlaps(segments), rigid_courses = merge_overlaps(rigid);
  const HotPoints hot = find_hot_points(segments, rigid, courses, rigid_courses, result.is_exact);
  // A course passes the same points as its segments. Their ends are among its points; between the ends, the course and
  // the segments meet the same squares.
  HotPoints::Passes passes = hot.walk(courses.segments, false);

  result.stretches.reserve(cut.pieces.size());
  for (std::size_t k = 0; k < cut.pieces.size(); ++k) {
    const std::uint32_t course = courses.of[k];
    result.stretches.push_back(stretch_of(cut.pieces[k], courses.segments[course], hot, passes, passes.begins[course],
                                          passes.begins[course + 1]));
  }
  for (const PieceRun& run : cut.runs)
    result.chains.push_back({run.line, static_cast<std::uint32_t>(run.begin), static_cast<std::uint32_t>(run.end)});
  Edges line_edges(passes), rigid_edges(hot.walk(rigid_courses.segments, true));
  result.edges = merge(line_edges.sort(), rigid_edges.sort());
  result.passes = std::move(passes.points);
  number_vertices(hot.points(), result);
  return result;
}

}  // namespace scarp::geom
