#include "check/borders.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <utility>

namespace scarp::check {
namespace {

bool are_same(const EdgeVertex& a, const EdgeVertex& b) { return a.key == b.key && a.normal == b.normal; }

bool are_same(const TileEdge& a, const TileEdge& b) {
  return std::equal(a.begin(), a.end(), b.begin(), b.end(),
                    [](const EdgeVertex& one, const EdgeVertex& other) { return are_same(one, other); });
}

double height_along(const TileEdge& edge, double along) {
  auto after = std::lower_bound(edge.begin(), edge.end(), along,
                                [](const EdgeVertex& vertex, double at) { return vertex.along < at; });
  if (after == edge.end()) return edge.back().height;
  if (after == edge.begin() || after->along == along) return after->height;
  const EdgeVertex& before = after[-1];
  const double t = (along - before.along) / (after->along - before.along);
  return before.height + t * (after->height - before.height);
}

}  // namespace

TileEdges take_edges(const ClientTile& tile) {
  TileEdges edges{tile.id, {}};
  for (std::size_t side = 0; side < edges.sides.size(); ++side) {
    const bool is_upright = side == kWest || side == kEast;
    for (const std::uint32_t v : tile.edges[side]) {
      EdgeVertex vertex;
      vertex.along = is_upright ? tile.v[v] : tile.u[v];
      vertex.height = tile.heights[v];
      if (tile.format == TileFormat::kGlb) {
        vertex.key = tile.places[v];
      } else {
        // Compares heights in single precision, since clients may decode 0 as noise of 10⁻¹¹ m.
        const auto height = double{static_cast<float>(vertex.height)};
        vertex.key = {vertex.along, std::abs(height) < 1e-10 ? 0 : height, 0};
      }
      if (!tile.normals.empty()) vertex.normal = tile.normals[v];
      edges.sides[side].push_back(vertex);
    }
    std::stable_sort(edges.sides[side].begin(), edges.sides[side].end(),
                     [](const EdgeVertex& a, const EdgeVertex& b) { return a.along < b.along; });
  }
  return edges;
}

double largest_gap(const TileEdge& one, const TileEdge& other) {
  if (one.empty() || other.empty()) return 0;
  double gap = 0;
  for (const TileEdge* edge : {&one, &other}) {
    for (const EdgeVertex& vertex : *edge)
      gap = std::max(gap, std::abs(height_along(one, vertex.along) - height_along(other, vertex.along)));
  }
  return gap;
}

void BorderWatch::add(TileEdges tile) {
  if (tile.id.y != row_.y) {
    end_row();
    below_ = std::move(row_);
    row_ = {tile.id.y, {}};
  }
  const std::uint32_t x = tile.id.x;
  if (grid_.has_poles() && tile.id.y == 0) check_pole(tile, kSouth);
  if (grid_.has_poles() && tile.id.y + 1 == grid_.rows(z_)) check_pole(tile, kNorth);
  const auto west = row_.tiles.find(x - 1);
  if (x > 0 && west != row_.tiles.end()) compare(west->second, kEast, tile, kWest);
  if (below_.y + 1 == row_.y) {
    const std::uint32_t columns = grid_.columns(z_), last = columns - 1;
    const auto find_below = [&](bool is_there, std::uint32_t column) {
      const auto found = is_there ? below_.tiles.find(column) : below_.tiles.end();
      return found == below_.tiles.end() ? nullptr : &found->second;
    };
    if (const TileEdges* south = find_below(true, x)) compare(*south, kNorth, tile, kSouth);
    const TileEdge& mine = tile.sides[kSouth];
    const TileEdges* const south_west = find_below(x > 0 || wraps(), x > 0 ? x - 1 : last);
    const TileEdges* const south_east = find_below(x < last || wraps(), x < last ? x + 1 : 0);
    if (south_west != nullptr && !mine.empty() && !south_west->sides[kNorth].empty())
      compare_corner(*south_west, south_west->sides[kNorth].back(), tile, mine.front());
    if (south_east != nullptr && !mine.empty() && !south_east->sides[kNorth].empty())
      compare_corner(*south_east, south_east->sides[kNorth].front(), tile, mine.back());
  }
  // Drop sides that are no longer needed. The row above needs northern sides; the eastern neighbour and, for the first
  // column, the last column need the others.
  tile.sides[kSouth] = {};
  if (x > 0) tile.sides[kWest] = {};
  if (west != row_.tiles.end() && x > 0) west->second.sides[kEast] = {};
  row_.tiles.insert_or_assign(x, std::move(tile));
}

void BorderWatch::end_row() {
  if (!wraps() || row_.tiles.empty()) return;
  const auto first = row_.tiles.begin(), last = std::prev(row_.tiles.end());
  if (first->first == 0 && last->first + 1 == grid_.columns(z_)) compare(last->second, kEast, first->second, kWest);
}

void BorderWatch::compare(const TileEdges& here, TileSide side, const TileEdges& there, TileSide other) {
  const TileEdge &mine = here.sides[side], &theirs = there.sides[other];
  ++level_.edges;
  if (are_same(mine, theirs)) return;
  ++level_.edges_apart;
  const double gap = largest_gap(mine, theirs);
  level_.gap = std::max(level_.gap, gap);
  const auto [vertex, match] = std::mismatch(mine.begin(), mine.end(), theirs.begin(), theirs.end(),
                                             [](const EdgeVertex& a, const EdgeVertex& b) { return are_same(a, b); });
  const bool are_normals = vertex != mine.end() && match != theirs.end() && vertex->key == match->key;
  faults_.push_back(
      {TileFaultKind::kBorder,
       fmt::format("{} and {} differ on the edge that they share: {}", tile_name(format_, here.id),
                   tile_name(format_, there.id),
                   are_normals && mine.size() == theirs.size() && gap == 0
                       ? std::string("their normals do")
                       : fmt::format("{} and {} vertices, a gap of up to {:.6g} m", mine.size(), theirs.size(), gap))});
}

void BorderWatch::compare_corner(const TileEdges& here, const EdgeVertex& mine, const TileEdges& there,
                                 const EdgeVertex& theirs) {
  ++level_.corners;
  // Positions along the edges need no comparison here: both vertices are ends.
  const bool are_equal = mine.normal == theirs.normal &&
                         (format_ == TileFormat::kGlb ? mine.key == theirs.key : mine.key[1] == theirs.key[1]);
  if (are_equal) return;
  ++level_.corners_apart;
  faults_.push_back({TileFaultKind::kBorder, fmt::format("{} and {} differ at the corner where they meet, by {:.6g} m",
                                                         tile_name(format_, here.id), tile_name(format_, there.id),
                                                         std::abs(mine.height - theirs.height))});
}

void BorderWatch::check_pole(const TileEdges& tile, TileSide side) {
  const TileEdge& edge = tile.sides[side];
  if (edge.empty()) return;
  ++level_.edges;
  const EdgeVertex& pole = poles_.emplace(side, edge.front()).first->second;
  double gap = 0;
  bool is_one = true;
  for (const EdgeVertex& vertex : edge) {
    is_one &= vertex.normal == pole.normal &&
              (format_ == TileFormat::kGlb ? vertex.key == pole.key : vertex.key[1] == pole.key[1]);
    gap = std::max(gap, std::abs(vertex.height - pole.height));
  }
  if (is_one) return;
  ++level_.edges_apart;
  level_.gap = std::max(level_.gap, gap);
  faults_.push_back(
      {TileFaultKind::kBorder, fmt::format("{} has a vertex at the pole that differs from others there, by {:.6g} m",
                                           tile_name(format_, tile.id), gap)});
}

}  // namespace scarp::check
