#include "features/crack_chains.h"

#include <algorithm>
#include <cmath>
#include <utility>

namespace scarp::features {
namespace {

constexpr std::uint32_t kNoCrack = 0xffffffff;

}  // namespace

void CrackChains::add_row(std::int32_t row, const float* above, const float* here, const float* below) {
  const auto are_valid = [&](const float* heights, std::int32_t col) {
    return heights != nullptr && col >= 0 && col + 1 < cols_ && !std::isnan(heights[col]) &&
           !std::isnan(heights[col + 1]);
  };
  const auto add = [&](Point from, bool is_down, float a, float b) {
    const Point to = is_down ? Point{from.x, from.y + 1} : Point{from.x + 1, from.y};
    if (is_left_out_(from) || is_left_out_(to)) return;
    const Side side{key_of(from, is_down), a, b};
    const Point at = cell_ahead(side);
    const bool is_whole =
        at.y < row ? are_valid(above, at.x) && are_valid(here, at.x) : are_valid(here, at.x) && are_valid(below, at.x);
    sides_.push_back(side);
    flags_.push_back(is_whole ? kIsAheadWhole : 0);
  };
  const auto is_step = [&](float a, float b) { return std::abs(double{a} - double{b}) > height_; };
  for (std::int32_t col = 0; col < cols_; ++col) {
    const float at = here[col];
    if (col + 1 < cols_ && is_step(at, here[col + 1])) add({col, row}, false, at, here[col + 1]);
    if (below != nullptr && is_step(at, below[col])) add({col, row}, true, at, below[col]);
  }
}

void CrackChains::link() {
  next_.assign(sides_.size(), kNoCrack);
  for (std::uint32_t i = 0; i < sides_.size(); ++i) link(i);
}

void CrackChains::visit(const std::function<void(const CrackChain&)>& visit) const {
  std::vector<bool> is_taken(sides_.size(), false);
  const auto follow = [&](std::uint32_t first) {
    CrackChain chain;
    std::uint32_t i = first;
    for (; i != kNoCrack && !is_taken[i]; i = next_[i]) {
      is_taken[i] = true;
      chain.cracks.push_back(crack_of(i));
    }
    chain.is_ring = i == first;
    visit(chain);
  };
  for (std::uint32_t i = 0; i < sides_.size(); ++i) {
    if ((flags_[i] & kHasPrevious) == 0) follow(i);
  }
  for (std::uint32_t i = 0; i < sides_.size(); ++i) {
    if (!is_taken[i]) follow(i);
  }
}

Point CrackChains::from_of(const Side& side) const {
  const std::uint64_t sample = side.key / 2, cols = static_cast<std::uint64_t>(cols_);
  return {static_cast<std::int32_t>(sample % cols), static_cast<std::int32_t>(sample / cols)};
}

/// The next cell along the chain, with the high sample on the left, by its first corner.
Point CrackChains::cell_ahead(const Side& side) const {
  const Point from = from_of(side);
  const bool is_down = side.key % 2 == 1, falls = side.from > side.to;
  // A vertical side that falls points right, a horizontal one up.
  const std::int32_t back = is_down == falls ? 0 : 1;
  return is_down ? Point{from.x - back, from.y} : Point{from.x, from.y - back};
}

Crack CrackChains::crack_of(std::uint32_t i) const {
  const Side& side = sides_[i];
  const Point from = from_of(side), to = side.key % 2 == 1 ? Point{from.x, from.y + 1} : Point{from.x + 1, from.y};
  const bool is_before_saddle = (flags_[i] & kIsBeforeSaddle) != 0;
  return side.from > side.to ? Crack{from, to, side.from, side.to, is_before_saddle}
                             : Crack{to, from, side.to, side.from, is_before_saddle};
}

std::uint32_t CrackChains::find(std::uint64_t key) const {
  const auto at = std::lower_bound(sides_.begin(), sides_.end(), key,
                                   [](const Side& side, std::uint64_t of) { return side.key < of; });
  return at != sides_.end() && at->key == key ? static_cast<std::uint32_t>(at - sides_.begin()) : kNoCrack;
}

/// Height at the clockwise end of a crack.
float CrackChains::corner(const Cell& cell, std::size_t k) const {
  return k < 2 ? sides_[cell[k]].from : sides_[cell[k]].to;
}

/// True if a wall with its high samples on the left leaves through this crack: heights fall clockwise.
bool CrackChains::goes_out(const Cell& cell, std::size_t k) const {
  const Side& side = sides_[cell[k]];
  return k < 2 ? side.from > side.to : side.to > side.from;
}

void CrackChains::link(std::uint32_t i) {
  if ((flags_[i] & kIsAheadWhole) == 0) return;
  const Point at = cell_ahead(sides_[i]);
  const Cell cell{find(key_of(at, false)), find(key_of({at.x + 1, at.y}, true)), find(key_of({at.x, at.y + 1}, false)),
                  find(key_of(at, true))};
  const auto k = static_cast<std::size_t>(std::find(cell.begin(), cell.end(), i) - cell.begin());
  std::size_t count = 0, out = 4;
  for (std::size_t s = 0; s < 4; ++s) {
    if (cell[s] == kNoCrack) continue;
    ++count;
    if (s != k && goes_out(cell, s)) out = s;
  }
  if (count == 4) {
    // Corner k is low and k + 1 high: a saddle has its low samples at k and k + 2.
    const float lows = std::abs(corner(cell, k) - corner(cell, (k + 2) % 4));
    const float highs = std::abs(corner(cell, (k + 1) % 4) - corner(cell, (k + 3) % 4));
    const bool is_saddle = goes_out(cell, (k + 1) % 4) && !goes_out(cell, (k + 2) % 4) && goes_out(cell, (k + 3) % 4);
    if (!is_saddle) return;
    out = highs <= lows ? (k + 3) % 4 : (k + 1) % 4;
    flags_[i] |= kIsBeforeSaddle;
  } else if (count != 2 || out == 4) {
    return;
  }
  next_[i] = cell[out];
  flags_[cell[out]] |= kHasPrevious;
}

}  // namespace scarp::features
