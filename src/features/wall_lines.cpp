#include "features/wall_lines.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <limits>

namespace scarp::features {
namespace {

/// In kLatticeSteps: half the gap between top and foot on a crack; the spacing of pairs on cracks, and in cells. On the
/// streets of Athens, twice as many pairs need five times the time and save 1 % of the vertices; without pairs in cells
/// there are 4 % more vertices.
constexpr std::int32_t kHalfGap = 2, kPairStep = 16, kCellStep = 64;
/// Cost of a pair of vertices, and of a crack without lines.
constexpr std::int32_t kPairCost = 10, kCrackCost = 3;
constexpr std::size_t kLongestWallLink = 1024;  ///< in stations

constexpr std::uint32_t kNoPair = 0xffffffff;
constexpr std::int32_t kNeverReached = std::numeric_limits<std::int32_t>::max() / 2;

struct WallVector {
  std::int64_t x, y;
};
WallVector operator-(Point a, Point b) { return {std::int64_t{a.x} - b.x, std::int64_t{a.y} - b.y}; }
/// True if b points to the left of a, rows downwards.
bool is_left(WallVector a, WallVector b) { return a.x * b.y - a.y * b.x < 0; }

Point scaled(Point p) { return {p.x * grid::kLatticeSteps, p.y * grid::kLatticeSteps}; }

/// Finds the fewest vertices by dynamic programming over pairs of candidate lattice points.
class WallSearch {
 public:
  explicit WallSearch(double tolerance) : tolerance_(tolerance) {}

  std::vector<Wall> search(const CrackChain& chain) {
    for (std::size_t k = 0; k < chain.cracks.size(); ++k) {
      if (k > 0) add_cell(chain.cracks[k - 1], chain.cracks[k]);
      add_crack(chain.cracks[k]);
    }
    run(kNoPair);
    std::vector<std::uint32_t> pairs = trace(kNoPair);
    if (chain.is_ring && !pairs.empty()) {
      const std::uint32_t cut = pairs[pairs.size() / 2];
      turn(chain.cracks, stations_[station_of_[cut]]);
      const std::uint32_t first = cut - begin_of_cut_;
      run(first);
      pairs = trace(first);
    }
    return walls(pairs);
  }

 private:
  /// A candidate position of a vertex: on a crack, or in the next cell if the chain turns there and passes the cell
  /// once.
  struct Station {
    std::size_t crack;
    bool is_cell;
    std::uint32_t begin, end;  // its pairs
    Point middle;
    double high, low;
  };
  struct PointPair {
    Point top, foot;
  };
  struct State {
    std::int32_t cost = kNeverReached;
    std::uint32_t from = kNoPair;  // start of the link; kNoPair: lines begin here
  };

  void clear() {
    cracks_.clear();
    stations_.clear();
    pairs_.clear();
    station_of_.clear();
  }

  /// Rotates a ring to begin and end at a station.
  void turn(const std::vector<Crack>& ring, const Station& at) {
    const Station cut = at;
    begin_of_cut_ = cut.begin;
    std::vector<Crack> turned(ring);
    const std::size_t first = (cut.crack + (cut.is_cell ? 1 : 0)) % ring.size();
    std::rotate(turned.begin(), turned.begin() + static_cast<std::ptrdiff_t>(first), turned.end());
    clear();
    if (cut.is_cell) add_cell(turned.back(), turned.front());
    for (std::size_t k = 0; k < turned.size(); ++k) {
      if (k > 0) add_cell(turned[k - 1], turned[k]);
      add_crack(turned[k]);
    }
    add_cell(turned.back(), turned.front());
    if (!cut.is_cell) add_crack(turned.front());
  }

  void add_crack(const Crack& crack) {
    const Point high = scaled(crack.high);
    const std::int32_t dx = crack.low.x - crack.high.x, dy = crack.low.y - crack.high.y;
    const auto at = [&](std::int32_t t) { return Point{high.x + dx * t, high.y + dy * t}; };
    const std::uint32_t begin = begin_station();
    for (std::int32_t t = kPairStep; t < grid::kLatticeSteps; t += kPairStep)
      pairs_.push_back({at(t - kHalfGap), at(t + kHalfGap)});
    end_station({cracks_.size(), false, begin, 0, at(grid::kLatticeSteps / 2), double{crack.top}, double{crack.foot}});
    cracks_.push_back(crack);
  }

  void add_cell(const Crack& before, const Crack& after) {
    const bool around_high = before.high == after.high, around_low = before.low == after.low;
    if (around_high == around_low || before.is_before_saddle) return;
    // The vector from the sample around which the chain turns to the opposite one.
    const Point pivot = around_high ? before.high : before.low;
    const Point a = around_high ? before.low : before.high, b = around_high ? after.low : after.high;
    const std::int32_t dx = a.x + b.x - 2 * pivot.x, dy = a.y + b.y - 2 * pivot.y;
    const std::int32_t gap = around_high ? kHalfGap : -kHalfGap;
    const Point from = scaled(pivot);
    const auto at = [&](std::int32_t right, std::int32_t down) {
      return Point{from.x + dx * right, from.y + dy * down};
    };
    const std::uint32_t begin = begin_station();
    for (std::int32_t down = kCellStep; down < grid::kLatticeSteps; down += kCellStep) {
      for (std::int32_t right = kCellStep; right < grid::kLatticeSteps; right += kCellStep)
        pairs_.push_back({at(right - gap, down - gap), at(right + gap, down + gap)});
    }
    end_station({cracks_.empty() ? 0 : cracks_.size() - 1, true, begin, 0,
                 at(grid::kLatticeSteps / 2, grid::kLatticeSteps / 2), (double{before.top} + double{after.top}) / 2,
                 (double{before.foot} + double{after.foot}) / 2});
  }

  std::uint32_t begin_station() const { return static_cast<std::uint32_t>(pairs_.size()); }
  void end_station(Station station) {
    station.end = static_cast<std::uint32_t>(pairs_.size());
    station_of_.resize(pairs_.size(), static_cast<std::uint32_t>(stations_.size()));
    stations_.push_back(station);
  }

  void run(std::uint32_t first) {
    states_.assign(pairs_.size(), {});
    off_.assign(cracks_.size() + 1, {});
    off_[0].cost = 0;
    for (std::size_t s = 0; s < stations_.size(); ++s) {
      const Station& station = stations_[s];
      if (first != kNoPair && s == 0) {
        states_[first] = {kPairCost, kNoPair};
      } else {
        begin_lines(station);
      }
      // A ring's last crack equals its first: lines continue there, or have already ended.
      if (!station.is_cell) end_lines(station, first == kNoPair || s + 1 < stations_.size());
      find_ends(s);
      for (std::uint32_t p = station.begin; p < station.end; ++p) {
        if (states_[p].cost < kNeverReached) spread(s, p);
      }
    }
  }

  void begin_lines(const Station& station) {
    if (station.is_cell) return;
    const std::int32_t cost = off_[station.crack].cost + kPairCost;
    for (std::uint32_t p = station.begin; p < station.end; ++p) {
      if (cost < states_[p].cost) states_[p] = {cost, kNoPair};
    }
  }
  void end_lines(const Station& station, bool may_end) {
    State& after = off_[station.crack + 1];
    after = {off_[station.crack].cost + kCrackCost, kNoPair};
    if (!may_end) return;
    for (std::uint32_t p = station.begin; p < station.end; ++p) {
      if (states_[p].cost < after.cost) after = {states_[p].cost, p};
    }
  }

  /// Finds the stations that links from station s can reach, judged by heights.
  void find_ends(std::size_t s) {
    constexpr double kFar = std::numeric_limits<double>::infinity();
    ends_.clear();
    double high_least = -kFar, high_most = kFar, low_least = -kFar, low_most = kFar;
    const Station& from = stations_[s];
    for (std::size_t t = s + 1; t < std::min(stations_.size(), s + kLongestWallLink); ++t) {
      const Station& to = stations_[t];
      const WallVector way = to.middle - from.middle;
      const double length = std::max(std::sqrt(static_cast<double>(way.x * way.x + way.y * way.y)), 1.0);
      const double rise = (to.high - from.high) / length, fall = (to.low - from.low) / length;
      ends_.push_back(rise >= high_least && rise <= high_most && fall >= low_least && fall <= low_most);
      if (to.is_cell) continue;
      const double slack = tolerance_ / length;
      high_least = std::max(high_least, rise - slack);
      high_most = std::min(high_most, rise + slack);
      low_least = std::max(low_least, fall - slack);
      low_most = std::min(low_most, fall + slack);
      if (high_least > high_most || low_least > low_most) break;
    }
  }

  /// Links a pair of station s to all pairs visible through the cracks.
  void spread(std::size_t s, std::uint32_t p) {
    const std::int32_t cost = states_[p].cost + kPairCost;
    const PointPair& from = pairs_[p];
    WallVector high_limit{0, 0}, low_limit{0, 0};
    bool is_limited = false;
    for (std::size_t t = s + 1; t <= s + ends_.size(); ++t) {
      const Station& to = stations_[t];
      if (!to.is_cell) {
        const WallVector h = scaled(cracks_[to.crack].high) - from.top, l = scaled(cracks_[to.crack].low) - from.foot;
        if (!is_limited || !is_left(high_limit, h)) high_limit = h;
        if (!is_limited || is_left(low_limit, l)) low_limit = l;
        is_limited = true;
        if (!is_left(low_limit, high_limit)) return;
      }
      if (ends_[t - s - 1] == 0) continue;
      for (std::uint32_t q = to.begin; q < to.end; ++q) {
        if (!(cost < states_[q].cost)) continue;
        const PointPair& end = pairs_[q];
        const WallVector above = end.top - from.top, below = end.foot - from.foot;
        if (is_limited && !(is_left(above, high_limit) && is_left(low_limit, below))) continue;
        // The lines of a wall must not cross.
        if (!is_left(from.foot - from.top, above) || !is_left(end.foot - end.top, above)) continue;
        states_[q] = {cost, p};
      }
    }
  }

  /// Pairs of vertices, last one first.
  std::vector<std::uint32_t> trace(std::uint32_t first) const {
    std::vector<std::uint32_t> pairs;
    std::size_t crack = cracks_.size();
    std::uint32_t p = kNoPair;
    if (first != kNoPair) {
      // A ring's last vertex is its first.
      const std::uint32_t last = stations_.back().begin + first;
      if (states_[last].cost - kPairCost < off_[crack].cost) p = last;
    }
    for (;;) {
      if (p == kNoPair) {
        if (crack == 0) return pairs;
        p = off_[crack].from;
        if (p == kNoPair) --crack;
        continue;
      }
      pairs.push_back(p);
      if (p == first) return pairs;
      if (states_[p].from == kNoPair) crack = stations_[station_of_[p]].crack;
      p = states_[p].from;
    }
  }

  std::vector<Wall> walls(const std::vector<std::uint32_t>& pairs) const {
    std::vector<Wall> walls;
    for (auto p = pairs.rbegin(); p != pairs.rend(); ++p) {
      if (states_[*p].from == kNoPair) walls.emplace_back();
      const Station& station = stations_[station_of_[*p]];
      walls.back().top.push_back({pairs_[*p].top, static_cast<float>(station.high)});
      walls.back().foot.push_back({pairs_[*p].foot, static_cast<float>(station.low)});
    }
    // Merge the parts of a ring on both sides of the cut.
    if (walls.size() > 1 && walls.back().top.back() == walls.front().top.front()) {
      Wall& last = walls.back();
      last.top.insert(last.top.end(), walls.front().top.begin() + 1, walls.front().top.end());
      last.foot.insert(last.foot.end(), walls.front().foot.begin() + 1, walls.front().foot.end());
      walls.erase(walls.begin());
    }
    return walls;
  }

  double tolerance_;
  std::vector<Crack> cracks_;
  std::vector<Station> stations_;
  std::vector<PointPair> pairs_;
  std::vector<std::uint32_t> station_of_;
  std::uint32_t begin_of_cut_ = 0;
  std::vector<State> states_;
  std::vector<State> off_;  // state without lines before each crack, and at the end
  std::vector<char> ends_;
};

}  // namespace

std::vector<Wall> find_walls(const CrackChain& chain, double tolerance) { return WallSearch(tolerance).search(chain); }

}  // namespace scarp::features
