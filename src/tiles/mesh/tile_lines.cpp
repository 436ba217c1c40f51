#include "tiles/mesh/tile_lines.h"

#include <algorithm>
#include <cmath>
#include <cstddef>

#include "base/int128.h"
#include "globe/node_places.h"

namespace scarp {
namespace {

/// A node of a level's lattice on the whole globe, from 180° W and the north pole; columns continue beyond a turn.
using Node = std::array<std::int64_t, 2>;
using Place = std::array<double, 2>;

/// Tolerance in steps of the lattice.
constexpr double kTolerance = 0.5;

double distance_to(const Place& p, const Place& a, const Place& b) {
  const double dx = b[0] - a[0], dy = b[1] - a[1], length = dx * dx + dy * dy;
  const double share = length > 0 ? std::clamp(((p[0] - a[0]) * dx + (p[1] - a[1]) * dy) / length, 0.0, 1.0) : 0;
  return std::hypot(p[0] - a[0] - share * dx, p[1] - a[1] - share * dy);
}

/// The algorithm of Douglas and Peucker, without recursion.
std::vector<Place> simplify_line(const std::vector<Place>& line) {
  std::vector<bool> stays(line.size(), false);
  stays.front() = stays.back() = true;
  std::vector<std::pair<std::size_t, std::size_t>> spans{{0, line.size() - 1}};
  while (!spans.empty()) {
    const auto [first, last] = spans.back();
    spans.pop_back();
    double worst = kTolerance;
    std::size_t at = first;
    for (std::size_t k = first + 1; k < last; ++k) {
      const double distance = distance_to(line[k], line[first], line[last]);
      if (distance <= worst) continue;
      worst = distance;
      at = k;
    }
    if (at == first) continue;
    stays[at] = true;
    spans.push_back({first, at});
    spans.push_back({at, last});
  }
  std::vector<Place> kept;
  for (std::size_t k = 0; k < line.size(); ++k) {
    if (stays[k]) kept.push_back(line[k]);
  }
  return kept;
}

/// A node where a segment crosses edges of tiles, and its position along the segment as a fraction.
struct Crossing {
  Node node;
  std::int64_t share, whole;
};

/// Adds the crossings of a segment with tile edges across `axis`, `cells` steps apart, between low and high only.
void add_crossings(const Node& a, const Node& b, std::size_t axis, std::int64_t cells, std::int64_t low,
                   std::int64_t high, std::vector<Crossing>& crossings) {
  const std::size_t other = 1 - axis;
  const std::int64_t whole = std::abs(b[axis] - a[axis]), way = b[axis] > a[axis] ? 1 : -1;
  const std::int64_t from = std::max(std::min(a[axis], b[axis]), low), to = std::min(std::max(a[axis], b[axis]), high);
  for (std::int64_t at = (globe::floor_of(from, cells) + 1) * cells; at < to; at += cells) {
    if (at == a[axis] || at == b[axis]) continue;
    const std::int64_t share = way * (at - a[axis]);
    // The nearest node on the edge; of two equally near ones, the one farther south or east.
    const Int128 up = 2 * Int128{b[other] - a[other]} * share + whole, down = 2 * Int128{whole};
    const Int128 rounded = up / down - (up % down < 0 ? 1 : 0);
    Crossing crossing{{}, share, whole};
    crossing.node[axis] = at;
    crossing.node[other] = a[other] + static_cast<std::int64_t>(rounded);
    crossings.push_back(crossing);
  }
}

/// The relevant part of the lattice.
struct Extent {
  std::int64_t west, north, east, south;
};

class LevelLines {
 public:
  using Paths = TileLines::Paths;
  using Tiles = std::map<std::pair<std::uint32_t, std::uint32_t>, Paths>;

  LevelLines(const TileGrid& grid, int z, int cells, const Extent& extent)
      : cells_(cells), columns_(grid.columns(z)), rows_(grid.rows(z)), extent_(extent) {}

  /// `turn`: nodes around the globe.
  void add(const std::vector<Place>& line, std::int64_t turn) {
    std::vector<Node> nodes;
    for (const Place& place : simplify_line(line)) {
      const Node node{static_cast<std::int64_t>(std::floor(place[0] + 0.5)),
                      static_cast<std::int64_t>(std::floor(place[1] + 0.5))};
      if (nodes.empty() || nodes.back() != node) nodes.push_back(node);
    }
    for (const std::int64_t more : {-turn, std::int64_t{0}, turn}) {
      for (std::size_t k = 0; k + 1 < nodes.size(); ++k)
        add_segment({nodes[k][0] + more, nodes[k][1]}, {nodes[k + 1][0] + more, nodes[k + 1][1]});
    }
  }

  Tiles take() {
    for (auto& [key, paths] : tiles_) {
      for (auto* const edge : {&paths.edges.top, &paths.edges.bottom, &paths.edges.left, &paths.edges.right}) {
        std::sort(edge->begin(), edge->end());
        edge->erase(std::unique(edge->begin(), edge->end()), edge->end());
      }
      std::sort(paths.steps.begin(), paths.steps.end());
      paths.steps.erase(std::unique(paths.steps.begin(), paths.steps.end()), paths.steps.end());
    }
    return std::move(tiles_);
  }

 private:
  void add_segment(const Node& a, const Node& b) {
    if (std::max(a[0], b[0]) < extent_.west || std::min(a[0], b[0]) > extent_.east ||
        std::max(a[1], b[1]) < extent_.north || std::min(a[1], b[1]) > extent_.south)
      return;
    std::vector<Crossing> crossings;
    add_crossings(a, b, 0, cells_, extent_.west, extent_.east, crossings);
    add_crossings(a, b, 1, cells_, extent_.north, extent_.south, crossings);
    std::stable_sort(crossings.begin(), crossings.end(), [](const Crossing& one, const Crossing& other) {
      return Int128{one.share} * other.whole < Int128{other.share} * one.whole;
    });
    Node before = a;
    add_edge_node(a);
    for (const Crossing& crossing : crossings) {
      add_edge_node(crossing.node);
      add_step(before, crossing.node);
      before = crossing.node;
    }
    add_edge_node(b);
    add_step(before, b);
  }

  /// Null beyond the poles.
  Paths* tile_at(std::int64_t column, std::int64_t row) {
    if (row < 0 || row >= rows_) return nullptr;
    const std::int64_t x = column - globe::floor_of(column, columns_) * columns_, y = rows_ - 1 - row;
    return &tiles_[{static_cast<std::uint32_t>(y), static_cast<std::uint32_t>(x)}];
  }

  /// Adds the node to all tiles whose edge it lies on.
  void add_edge_node(const Node& node) {
    const std::int64_t column = globe::floor_of(node[0], cells_), row = globe::floor_of(node[1], cells_);
    const auto col = static_cast<std::int32_t>(node[0] - column * cells_);
    const auto line = static_cast<std::int32_t>(node[1] - row * cells_);
    const auto last = static_cast<std::int32_t>(cells_);
    const auto add = [&](std::int64_t at_column, std::int64_t at_row, std::vector<std::int32_t> EdgeVertices::*edge,
                         std::int32_t at) {
      if (at <= 0 || at >= last) return;
      if (Paths* const tile = tile_at(at_column, at_row)) (tile->edges.*edge).push_back(at);
    };
    if (col == 0) {
      add(column, row, &EdgeVertices::left, line);
      add(column - 1, row, &EdgeVertices::right, line);
    }
    if (line == 0) {
      add(column, row, &EdgeVertices::top, col);
      add(column, row - 1, &EdgeVertices::bottom, col);
    }
  }

  /// Adds the step to the tile that contains both ends. Skips steps along an edge, which the outlines of tiles include.
  void add_step(const Node& a, const Node& b) {
    if (a == b) return;
    for (std::size_t axis = 0; axis < 2; ++axis) {
      if (a[axis] == b[axis] && a[axis] % cells_ == 0) return;
    }
    // The tile of the step's middle, which is on no edge; computed from the doubled middle.
    const std::int64_t column = globe::floor_of(a[0] + b[0], 2 * cells_),
                       row = globe::floor_of(a[1] + b[1], 2 * cells_);
    const auto local = [&](const Node& node) {
      return std::array<std::int64_t, 2>{node[0] - column * cells_, node[1] - row * cells_};
    };
    const auto from = local(a), to = local(b);
    for (const std::int64_t at : {from[0], from[1], to[0], to[1]}) {
      if (at < 0 || at > cells_) return;  // beyond the extent
    }
    const auto node_of = [](const std::array<std::int64_t, 2>& at) {
      return TileLines::Node{static_cast<std::int32_t>(at[0]), static_cast<std::int32_t>(at[1])};
    };
    Paths* const tile = tile_at(column, row);
    if (tile == nullptr) return;
    std::array<TileLines::Node, 2> step{node_of(from), node_of(to)};
    if (step[1] < step[0]) std::swap(step[0], step[1]);
    tile->steps.push_back(step);
  }

  std::int64_t cells_, columns_, rows_;
  Extent extent_;
  Tiles tiles_;
};

/// The line without jumps around the globe.
std::vector<Place> unrolled(const DegreeLine& line) {
  std::vector<Place> places;
  for (const auto& [longitude, latitude] : line) {
    double x = longitude;
    if (!places.empty()) x -= 360 * std::floor((x - places.back()[0]) / 360 + 0.5);
    places.push_back({x, std::clamp(latitude, -90.0, 90.0)});
  }
  return places;
}

}  // namespace

TileLines::TileLines(std::vector<DegreeLine> lines, const TileGrid& grid, int cells, int max_zoom, int block_level,
                     const DegreeBox& covered)
    : lines_(std::move(lines)) {
  for (int z = 0; z <= max_zoom; ++z) {
    const std::int64_t turn = grid.per_turn(z, cells);
    const double per_degree = static_cast<double>(turn) / 360;
    const auto around = static_cast<std::int64_t>(2 * std::ldexp(cells, std::max(0, z - block_level)));
    const auto step = [&](double degrees) { return static_cast<std::int64_t>(std::floor(degrees * per_degree)); };
    LevelLines level(grid, z, cells,
                     {step(covered.west + 180) - around, step(90 - covered.north) - around,
                      step(covered.east + 180) + around + 1, step(90 - covered.south) + around + 1});
    for (const DegreeLine& line : lines_) {
      if (line.size() < 2) continue;
      std::vector<Place> places;
      for (const Place& at : unrolled(line)) places.push_back({(at[0] + 180) * per_degree, (90 - at[1]) * per_degree});
      level.add(places, turn);
    }
    levels_.push_back(level.take());
  }
}

const TileLines::Paths* TileLines::find(TileId id) const {
  const auto& level = levels_[static_cast<std::size_t>(id.z)];
  const auto found = level.find({id.y, id.x});
  return found == level.end() ? nullptr : &found->second;
}

}  // namespace scarp
