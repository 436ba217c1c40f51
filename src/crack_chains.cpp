#include "crack_chains.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <optional>

namespace scarp {
namespace {

constexpr std::uint32_t kNoCrack = 0xffffffff;

class Cracks {
 public:
  Cracks(const Raster& raster, double height, const std::function<bool(Point)>& is_left_out)
      : raster_(raster), height_(height), is_left_out_(is_left_out) {
    for (std::int32_t row = 0; row < raster.rows; ++row) {
      for (std::int32_t col = 0; col < raster.cols; ++col) {
        for (const Side side : {Side{{col, row}, false}, Side{{col, row}, true}}) {
          if (is_cracked(side)) sides_.push_back(side);
        }
      }
    }
    next_.assign(sides_.size(), kNoCrack);
    has_previous_.assign(sides_.size(), 0);
    is_before_saddle_.assign(sides_.size(), 0);
    for (std::uint32_t i = 0; i < sides_.size(); ++i) link(i);
  }

  std::vector<CrackChain> chains() {
    std::vector<CrackChain> chains;
    std::vector<std::uint8_t> is_taken(sides_.size(), 0);
    const auto follow = [&](std::uint32_t first) {
      CrackChain chain;
      std::uint32_t i = first;
      for (; i != kNoCrack && is_taken[i] == 0; i = next_[i]) {
        is_taken[i] = 1;
        chain.cracks.push_back(crack_of(sides_[i]));
        chain.cracks.back().is_before_saddle = is_before_saddle_[i] != 0;
      }
      chain.is_ring = i == first;
      chains.push_back(std::move(chain));
    };
    for (std::uint32_t i = 0; i < sides_.size(); ++i) {
      if (has_previous_[i] == 0) follow(i);
    }
    for (std::uint32_t i = 0; i < sides_.size(); ++i) {
      if (is_taken[i] == 0) follow(i);
    }
    return chains;
  }

 private:
  /// From a sample to the one on its right, or below it.
  struct Side {
    Point from;
    bool is_down;
    Point to() const { return is_down ? Point{from.x, from.y + 1} : Point{from.x + 1, from.y}; }
    friend bool operator==(const Side&, const Side&) = default;
  };
  static bool comes_before(const Side& a, const Side& b) {
    return a.from == b.from ? a.is_down < b.is_down : before(a.from, b.from);
  }

  bool is_cracked(const Side& side) const {
    const Point to = side.to();
    if (to.x >= raster_.cols || to.y >= raster_.rows) return false;
    const double step = double{raster_.at(side.from)} - double{raster_.at(to)};
    return std::abs(step) > height_ && !is_left_out_(side.from) && !is_left_out_(to);
  }
  Crack crack_of(const Side& side) const {
    return raster_.at(side.from) > raster_.at(side.to()) ? Crack{side.from, side.to()} : Crack{side.to(), side.from};
  }
  std::uint32_t find(const Side& side) const {
    const auto at = std::lower_bound(sides_.begin(), sides_.end(), side, comes_before);
    return at != sides_.end() && *at == side ? static_cast<std::uint32_t>(at - sides_.begin()) : kNoCrack;
  }

  /// A cell, its corners and sides clockwise as it is looked at: side k from corner k to corner k + 1.
  struct Cell {
    std::array<Point, 4> corners;
    std::array<std::uint32_t, 4> cracks;
  };
  std::optional<Cell> cell_at(Point p) const {
    if (p.x < 0 || p.y < 0 || p.x + 1 >= raster_.cols || p.y + 1 >= raster_.rows) return std::nullopt;
    Cell cell;
    cell.corners = {p, {p.x + 1, p.y}, {p.x + 1, p.y + 1}, {p.x, p.y + 1}};
    for (const Point corner : cell.corners) {
      if (!raster_.is_valid(corner)) return std::nullopt;
    }
    cell.cracks = {find({p, false}), find({cell.corners[1], true}), find({cell.corners[3], false}), find({p, true})};
    return cell;
  }
  /// Whether a wall with its high samples on the left leaves through the side: it falls clockwise.
  bool goes_out(const Cell& cell, std::size_t k) const {
    return raster_.at(cell.corners[k]) > raster_.at(cell.corners[(k + 1) % 4]);
  }

  /// Finds what follows on crack i: beyond it on the way with the high sample on the left.
  void link(std::uint32_t i) {
    const Side& side = sides_[i];
    const bool falls = raster_.at(side.from) > raster_.at(side.to());
    // Where a side downwards falls the way goes right, where one to the right falls it goes up.
    const std::int32_t back = side.is_down == falls ? 0 : 1;
    const Point at = side.is_down ? Point{side.from.x - back, side.from.y} : Point{side.from.x, side.from.y - back};
    const auto cell = cell_at(at);
    if (!cell) return;
    const auto k =
        static_cast<std::size_t>(std::find(cell->cracks.begin(), cell->cracks.end(), i) - cell->cracks.begin());
    std::size_t count = 0, out = 4;
    for (std::size_t s = 0; s < 4; ++s) {
      if (cell->cracks[s] == kNoCrack) continue;
      ++count;
      if (s != k && goes_out(*cell, s)) out = s;
    }
    if (count == 4) {
      const auto& c = cell->corners;
      // Corner k is low and k + 1 high: a saddle has its low samples at k and k + 2.
      const float lows = std::abs(raster_.at(c[k]) - raster_.at(c[(k + 2) % 4]));
      const float highs = std::abs(raster_.at(c[(k + 1) % 4]) - raster_.at(c[(k + 3) % 4]));
      const bool is_saddle =
          goes_out(*cell, (k + 1) % 4) && !goes_out(*cell, (k + 2) % 4) && goes_out(*cell, (k + 3) % 4);
      if (!is_saddle) return;
      out = highs <= lows ? (k + 3) % 4 : (k + 1) % 4;
      is_before_saddle_[i] = 1;
    } else if (count != 2 || out == 4) {
      return;
    }
    next_[i] = cell->cracks[out];
    has_previous_[cell->cracks[out]] = 1;
  }

  const Raster& raster_;
  double height_;
  const std::function<bool(Point)>& is_left_out_;
  std::vector<Side> sides_;  // in raster order
  std::vector<std::uint32_t> next_;
  std::vector<std::uint8_t> has_previous_, is_before_saddle_;
};

}  // namespace

std::vector<CrackChain> find_crack_chains(const Raster& raster, double height,
                                          const std::function<bool(Point)>& is_left_out) {
  return Cracks(raster, height, is_left_out).chains();
}

}  // namespace scarp
