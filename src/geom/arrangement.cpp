#include "geom/arrangement.h"

#include <algorithm>
#include <utility>

#include "geom/hot_points.h"

namespace scarp {
namespace {

/// A part of a line in the rectangle.
struct Piece {
  ClippedSegment clipped;
  std::uint32_t segment;  ///< of the line
};

/// Pieces that follow each other without a gap.
struct Run {
  std::uint32_t line;
  std::size_t begin, end;  ///< of the pieces
};

struct Pieces {
  std::vector<Piece> pieces;
  std::vector<Run> runs;
};

void cut_line(std::span<const Point> line, std::uint32_t number, std::int32_t width, std::int32_t height, Pieces& cut) {
  bool is_open = false;  // the last run ends where this segment begins
  for (std::uint32_t k = 0; k + 1 < line.size(); ++k) {
    if (line[k] == line[k + 1]) continue;
    Piece piece{{}, k};
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

Pieces cut_lines(const Polylines& lines, std::int32_t width, std::int32_t height) {
  Pieces cut;
  for (std::uint32_t k = 0; k < lines.size(); ++k) cut_line(lines[k], k, width, height, cut);
  return cut;
}

void sort_uniquely(std::vector<Point>& points) {
  std::sort(points.begin(), points.end(), before);
  points.erase(std::unique(points.begin(), points.end()), points.end());
}

/// All ends and crossings.
HotPoints find_hot_points(const Pieces& cut, std::span<const Segment> rigid, bool& is_exact) {
  std::vector<Segment> segments;
  segments.reserve(cut.pieces.size());
  for (const Piece& piece : cut.pieces) segments.push_back(piece.clipped.segment);
  auto [points, are_exact] = find_crossings(segments, rigid);
  is_exact = are_exact;
  points.reserve(points.size() + 2 * (segments.size() + rigid.size()));
  for (const auto& list : {std::span<const Segment>(segments), rigid}) {
    for (const Segment& s : list) {
      points.push_back(s.from);
      points.push_back(s.to);
    }
  }
  sort_uniquely(points);
  return {std::move(points), rigid, is_exact};
}

/// The ends of an edge in one number, the lower first.
class Edges {
 public:
  void add(std::uint32_t a, std::uint32_t b) { keys_.push_back(std::uint64_t{std::min(a, b)} << 32 | std::max(a, b)); }
  const std::vector<std::uint64_t>& sort() {
    std::sort(keys_.begin(), keys_.end());
    keys_.erase(std::unique(keys_.begin(), keys_.end()), keys_.end());
    return keys_;
  }

 private:
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

/// Leaves out hot points that nothing passes.
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
  for (auto& stop : result.stops) stop.vertex = numbers[stop.vertex];
}

}  // namespace

Arrangement arrange(const Polylines& lines, std::span<const Segment> rigid, std::int32_t width, std::int32_t height) {
  Arrangement result;
  const Pieces cut = cut_lines(lines, width, height);
  HotPoints hot = find_hot_points(cut, rigid, result.is_exact);

  std::vector<HotPoints::Pass> passes;
  Edges line_edges, rigid_edges;
  for (const Segment& s : rigid) {
    hot.walk(s, true, passes);
    for (std::size_t k = 1; k < passes.size(); ++k) rigid_edges.add(passes[k - 1].point, passes[k].point);
  }
  for (const Run& run : cut.runs) {
    const auto begin = static_cast<std::uint32_t>(result.stops.size());
    for (std::size_t k = run.begin; k < run.end; ++k) {
      const auto& [clipped, segment] = cut.pieces[k];
      hot.walk(clipped.segment, false, passes);
      for (const auto& pass : passes) {
        if (result.stops.size() > begin) {
          if (result.stops.back().vertex == pass.point) continue;
          line_edges.add(result.stops.back().vertex, pass.point);
        }
        result.stops.push_back({pass.point, segment, clipped.begin + pass.fraction * (clipped.end - clipped.begin)});
      }
    }
    result.chains.push_back({run.line, begin, static_cast<std::uint32_t>(result.stops.size())});
  }
  result.edges = merge(line_edges.sort(), rigid_edges.sort());
  number_vertices(hot.points(), result);
  return result;
}

}  // namespace scarp
