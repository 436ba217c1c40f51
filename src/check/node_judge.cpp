#include "check/node_judge.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <utility>

#include "check/tile_faults.h"

namespace scarp::check {
namespace {

/// Limit of exhaustive searches per tile and block: a tile with more such nodes is faulty anyway.
constexpr int kMostSecondLooks = 100'000;

}  // namespace

NodeBlock NodeBlock::begin(const NodeWindow& window, const World& world) {
  NodeBlock block{window, world, {}, {}, {}};
  for (int col = 0; col < window.cols; ++col)
    block.meridians.push_back(world.meridian(window.longitude(window.col + col)));
  for (int row = 0; row < window.rows; ++row)
    block.parallels.push_back(world.parallel(window.latitude(window.row + row)));
  return block;
}

void NodeVerdict::add(const NodeVerdict& more) {
  node_error = std::max(node_error, more.node_error);
  distance = std::max(distance, more.distance);
  source_error = std::max(source_error, more.source_error);
  nodes += more.nodes;
}

NodeJudge::NodeJudge(const ClientTile& tile, std::int64_t steps, double background, double bound, const TileGrid& grid)
    : tile_(tile),
      grid_(grid),
      box_(grid.bounds_of(tile.id)),
      per_turn_(grid.columns(tile.id.z) * steps),
      steps_(static_cast<double>(steps)),
      background_(background),
      bound_(bound) {
  for (std::size_t k = 0; k < tile.triangles.size(); k += 3) {
    const Place& corner = tile.places[tile.triangles[k]];
    longest_.push_back(std::max(length(tile.places[tile.triangles[k + 1]] - corner),
                                length(tile.places[tile.triangles[k + 2]] - corner)));
  }
  first_col_ = static_cast<double>(tile.id.x) * steps_;
  first_row_ = static_cast<double>(grid.rows(tile.id.z) - 1 - tile.id.y) * steps_;
}

double NodeJudge::line_of(std::int64_t row) const {
  const double latitude = NodeWindow{per_turn_, 0, row, 1, 1, grid_}.latitude(row);
  const double line = (box_.north - latitude) / (box_.north - box_.south) * steps_;
  const double even = static_cast<double>(row) - first_row_;
  return std::abs(line - even) < 1e-6 ? even : line;
}

NodeJudge::OnLattice NodeJudge::on_lattice(std::size_t k) const {
  OnLattice triangle;
  for (std::size_t c = 0; c < 3; ++c) {
    const std::uint32_t v = tile_.triangles[k + c];
    triangle.vertices[c] = v;
    triangle.cols[c] = tile_.u[v] * steps_ / kWholeTile;
    triangle.rows[c] = (kWholeTile - tile_.v[v]) * steps_ / kWholeTile;
  }
  const std::array<double, 3>&x = triangle.cols, &y = triangle.rows;
  triangle.area = (x[1] - x[0]) * (y[2] - y[0]) - (x[2] - x[0]) * (y[1] - y[0]);
  return triangle;
}

std::pair<double, double> NodeJudge::columns_of(const OnLattice& triangle, double row) {
  double from = std::numeric_limits<double>::infinity(), to = -from;
  for (std::size_t c = 0; c < 3; ++c) {
    const std::size_t d = (c + 1) % 3;
    const double low = std::min(triangle.rows[c], triangle.rows[d]),
                 high = std::max(triangle.rows[c], triangle.rows[d]);
    if (row < low || row > high) continue;
    if (low == high) {
      from = std::min({from, triangle.cols[c], triangle.cols[d]});
      to = std::max({to, triangle.cols[c], triangle.cols[d]});
      continue;
    }
    const double t = (row - triangle.rows[c]) / (triangle.rows[d] - triangle.rows[c]);
    const double col = triangle.cols[c] + t * (triangle.cols[d] - triangle.cols[c]);
    from = std::min(from, col);
    to = std::max(to, col);
  }
  return {from, to};
}

double NodeJudge::nearest(const Place& node) const {
  double least = std::numeric_limits<double>::infinity();
  for (std::size_t k = 0; k < tile_.triangles.size() && least > bound_; k += 3) {
    const Place way = node - tile_.places[tile_.triangles[k]];
    const double reach = bound_ + longest_[k / 3];
    if (inner(way, way) > reach * reach) continue;
    least = std::min(least,
                     distance_to_triangle(node, tile_.places[tile_.triangles[k]], tile_.places[tile_.triangles[k + 1]],
                                          tile_.places[tile_.triangles[k + 2]]));
  }
  return least;
}

NodeVerdict NodeJudge::judge(const NodeBlock& block) const {
  NodeVerdict verdict;
  const double slack = 1e-9 + 1e-15 * steps_;
  const double west = static_cast<double>(block.window.col) - first_col_, last_col = west + block.window.cols - 1;
  std::vector<double> lines;
  for (int row = 0; row < block.window.rows; ++row) lines.push_back(line_of(block.window.row + row));
  double worst = 0, farthest = 0;  // squared
  int second_looks = 0;
  for (std::size_t k = 0; k < tile_.triangles.size(); k += 3) {
    const OnLattice triangle = on_lattice(k);
    if (triangle.area == 0) continue;
    const auto [low_row, high_row] = std::minmax({triangle.rows[0], triangle.rows[1], triangle.rows[2]});
    const auto [low_col, high_col] = std::minmax({triangle.cols[0], triangle.cols[1], triangle.cols[2]});
    if (high_row < lines.front() - slack || low_row > lines.back() + slack || high_col < west - slack ||
        low_col > last_col + slack)
      continue;
    const auto& [a, b, c] = triangle.vertices;
    const double height = tile_.heights[a], to_b = tile_.heights[b] - height, to_c = tile_.heights[c] - height;
    const Place place = tile_.places[a], way_b = tile_.places[b] - place, way_c = tile_.places[c] - place;
    const double b_step = (triangle.rows[2] - triangle.rows[0]) / triangle.area,
                 c_step = -(triangle.rows[1] - triangle.rows[0]) / triangle.area;
    auto in_row =
        static_cast<std::size_t>(std::lower_bound(lines.begin(), lines.end(), low_row - slack) - lines.begin());
    for (; in_row < lines.size() && lines[in_row] <= high_row + slack; ++in_row) {
      const double row = lines[in_row];
      const auto [left, right] = columns_of(triangle, std::clamp(row, low_row, high_row));
      const double from = std::max(std::ceil(left - slack), west), to = std::min(std::floor(right + slack), last_col);
      if (from > to) continue;
      const double x = from - triangle.cols[0], y = row - triangle.rows[0];
      double share_b =
          (x * (triangle.rows[2] - triangle.rows[0]) - (triangle.cols[2] - triangle.cols[0]) * y) / triangle.area;
      double share_c =
          ((triangle.cols[1] - triangle.cols[0]) * y - x * (triangle.rows[1] - triangle.rows[0])) / triangle.area;
      const World::Parallel& parallel = block.parallels[in_row];
      const float* const nodes = block.heights.data() + in_row * static_cast<std::size_t>(block.window.cols);
      for (auto col = static_cast<std::size_t>(from - west); col <= static_cast<std::size_t>(to - west); ++col) {
        const double node = std::isnan(nodes[col]) ? background_ : double{nodes[col]};
        worst = std::max(worst, std::abs(height + share_b * to_b + share_c * to_c - node));
        const Place at = block.place(parallel, col, node);
        double square = 0;
        for (std::size_t i = 0; i < 3; ++i) {
          const double apart = place[i] + share_b * way_b[i] + share_c * way_c[i] - at[i];
          square += apart * apart;
        }
        if (square > farthest) {
          if (square > bound_ * bound_) {
            double distance = distance_to_triangle(at, tile_.places[a], tile_.places[b], tile_.places[c]);
            if (distance > bound_ && second_looks++ < kMostSecondLooks) distance = std::min(distance, nearest(at));
            square = distance * distance;
          }
          farthest = std::max(farthest, square);
        }
        share_b += b_step;
        share_c += c_step;
        ++verdict.nodes;
      }
    }
  }
  verdict.node_error = worst;
  verdict.distance = std::sqrt(farthest);
  return verdict;
}

NodeVerdict NodeJudge::judge_outside(const NodeRectangle& inside, const World& world) const {
  NodeVerdict verdict;
  const double slack = 1e-9 + 1e-15 * steps_;
  const auto turn = static_cast<double>(per_turn_);
  const double west = static_cast<double>(inside.from_col) - first_col_,
               east = static_cast<double>(inside.to_col) - first_col_;
  const double north = line_of(inside.from_row), south = line_of(inside.to_row);
  for (std::size_t k = 0; k < tile_.triangles.size(); k += 3) {
    const OnLattice triangle = on_lattice(k);
    if (triangle.area == 0) continue;
    const auto [low_row, high_row] = std::minmax({triangle.rows[0], triangle.rows[1], triangle.rows[2]});
    const auto [low_col, high_col] = std::minmax({triangle.cols[0], triangle.cols[1], triangle.cols[2]});
    if (low_row >= north && high_row <= south && low_col >= west && high_col <= east) continue;
    const auto& [a, b, c] = triangle.vertices;
    const double height = tile_.heights[a], to_b = tile_.heights[b] - height, to_c = tile_.heights[c] - height;
    const double most = std::max({std::abs(tile_.heights[a] - background_), std::abs(tile_.heights[b] - background_),
                                  std::abs(tile_.heights[c] - background_)});
    double error = 0;
    if (most <= verdict.node_error || (std::isfinite(bound_) && most <= bound_ / 100)) {
      // The corners bound the error at nodes, and this bound is small enough.
      error = most;
    } else {
      const auto top = static_cast<std::int64_t>(first_row_), bottom = top + static_cast<std::int64_t>(steps_);
      // The first row that is not above the triangle.
      std::int64_t above = top - 1, first = bottom;
      while (first - above > 1) {
        const std::int64_t middle = above + (first - above) / 2;
        (line_of(middle) < low_row - slack ? above : first) = middle;
      }
      for (std::int64_t node_row = first; node_row <= bottom; ++node_row) {
        const double row = line_of(node_row);
        if (row > high_row + slack) break;
        const auto [left, right] = columns_of(triangle, std::clamp(row, low_row, high_row));
        const double from = std::ceil(left - slack), to = std::floor(right + slack);
        const auto look_at = [&](double col) {
          const double x = col - triangle.cols[0], y = row - triangle.rows[0];
          const double share_b =
              (x * (triangle.rows[2] - triangle.rows[0]) - (triangle.cols[2] - triangle.cols[0]) * y) / triangle.area;
          const double share_c =
              ((triangle.cols[1] - triangle.cols[0]) * y - x * (triangle.rows[1] - triangle.rows[0])) / triangle.area;
          error = std::max(error, std::abs(height + share_b * to_b + share_c * to_c - background_));
        };
        // Differences are largest at the ends of the outer intervals.
        double next = from;
        if (node_row >= inside.from_row && node_row <= inside.to_row) {
          for (const double shift : {-turn, 0.0, turn}) {
            if (east + shift < next || west + shift > to) continue;
            if (next < west + shift) {
              look_at(next);
              look_at(west + shift - 1);
            }
            next = std::max(next, east + shift + 1);
          }
        }
        if (next > to) continue;
        look_at(next);
        look_at(to);
        verdict.nodes += 2;
      }
    }
    verdict.node_error = std::max(verdict.node_error, error);
    ClientTile alone;
    alone.places = {tile_.places[a], tile_.places[b], tile_.places[c]};
    alone.triangles = {0, 1, 2};
    verdict.distance = std::max(verdict.distance, error + measure_sag(alone, world));
  }
  return verdict;
}

}  // namespace scarp::check
