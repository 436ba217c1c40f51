#include "features/valley_paths.h"

#include <algorithm>
#include <cstdint>
#include <numeric>
#include <queue>
#include <utility>

namespace scarp::features {
namespace {

constexpr std::uint32_t kNoNode = 0xffffffff;

/// Samples near low ones, indexed in the full raster.
class DenseNear {
 public:
  using Id = std::size_t;  // in raster order

  DenseNear(const grid::Raster& raster, const std::vector<Hollow>& hollows,
            const std::function<bool(Point)>& is_left_out)
      : raster_(raster), hollows_(hollows), states_(hollows.size(), State::kBeyond) {
    for (std::size_t i = 0; i < hollows.size(); ++i) {
      if (hollows[i] == Hollow::kNone) continue;
      const Point at = point(i);
      for (std::int32_t dy = -2; dy <= 2; ++dy) {
        for (std::int32_t dx = -2; dx <= 2; ++dx) {
          const Point p{at.x + dx, at.y + dy};
          if (!is_inside(p) || states_[index(p)] != State::kBeyond || !raster.is_valid(p) || is_left_out(p)) continue;
          states_[index(p)] = State::kNear;
          near_.push_back(index(p));
        }
      }
    }
  }

  std::vector<Id> all() { return std::move(near_); }
  float height(Id i) const { return raster_.samples[i]; }
  bool is_low(Id i) const { return hollows_[i] != Hollow::kNone; }
  Hollow hollow(Id i) const { return hollows_[i]; }
  Point point(Id i) const {
    const auto cols = static_cast<std::size_t>(raster_.cols);
    return {static_cast<std::int32_t>(i % cols), static_cast<std::int32_t>(i / cols)};
  }
  bool is_reached(Id i) const { return states_[i] == State::kReached; }
  void reach(Id i) { states_[i] = State::kReached; }
  template <class Visit>
  void visit_neighbours(Id i, const Visit& visit) const {
    const Point at = point(i);
    for (std::int32_t dy = -1; dy <= 1; ++dy) {
      for (std::int32_t dx = -1; dx <= 1; ++dx) {
        const Point p{at.x + dx, at.y + dy};
        if (is_inside(p) && states_[index(p)] != State::kBeyond) visit(index(p));
      }
    }
  }

 private:
  enum class State : std::uint8_t { kBeyond, kNear, kReached };

  std::size_t index(Point p) const {
    return static_cast<std::size_t>(p.y) * static_cast<std::size_t>(raster_.cols) + static_cast<std::size_t>(p.x);
  }
  bool is_inside(Point p) const { return p.x >= 0 && p.y >= 0 && p.x < raster_.cols && p.y < raster_.rows; }

  const grid::Raster& raster_;
  const std::vector<Hollow>& hollows_;
  std::vector<State> states_;
  std::vector<Id> near_;
};

/// Samples near low ones, indexed separately.
class SparseNear {
 public:
  using Id = std::uint32_t;  // in raster order

  explicit SparseNear(const HollowSamples& samples) : samples_(samples), is_reached_(samples.size(), 0) {}

  std::vector<Id> all() const {
    std::vector<Id> all(samples_.size());
    std::iota(all.begin(), all.end(), 0u);
    return all;
  }
  float height(Id i) const { return samples_.height(i); }
  bool is_low(Id i) const { return hollow(i) != Hollow::kNone; }
  Hollow hollow(Id i) const { return samples_.hollow(i); }
  Point point(Id i) const { return samples_.point(i); }
  bool is_reached(Id i) const { return is_reached_[i] != 0; }
  void reach(Id i) { is_reached_[i] = 1; }
  template <class Visit>
  void visit_neighbours(Id i, const Visit& visit) const {
    samples_.visit_neighbours(i, visit);
  }

 private:
  const HollowSamples& samples_;
  std::vector<std::uint8_t> is_reached_;
};

/// The forest that links low samples, in the order in which the search reaches them.
template <class Near>
class Forest {
 public:
  using Id = typename Near::Id;

  explicit Forest(Near near) : near_(std::move(near)) {
    std::vector<Id> all = near_.all();
    std::sort(all.begin(), all.end(),
              [&](Id a, Id b) { return std::pair(near_.height(a), a) < std::pair(near_.height(b), b); });
    nodes_.reserve(all.size());
    for (const Id i : all) {
      if (!near_.is_reached(i)) grow(i);
    }
    weigh();
  }

  std::vector<ValleyPath> paths() const {
    std::vector<std::vector<std::uint32_t>> kept;
    std::vector<std::uint8_t> is_joint(nodes_.size(), 0);
    for (std::uint32_t n = 0; n < nodes_.size(); ++n) {
      const std::uint32_t from = nodes_[n].parent;
      if (from == kNoNode) {
        if (std::vector<std::uint32_t> path = trunk(n); is_valley(path)) kept.push_back(std::move(path));
        continue;
      }
      if (nodes_[from].heir == n || (nodes_[from].parent == kNoNode && nodes_[from].second == n)) continue;
      std::vector<std::uint32_t> path = course(n);
      if (!is_valley(path)) continue;
      path.insert(path.begin(), from);
      is_joint[from] = 1;
      kept.push_back(std::move(path));
    }
    std::vector<ValleyPath> paths;
    for (const auto& nodes : kept) {
      ValleyPath path;
      for (std::size_t k = 0; k < nodes.size(); ++k) {
        if (is_joint[nodes[k]] != 0 && k > 0 && k + 1 < nodes.size()) path.joints.push_back(k);
        path.samples.push_back(near_.point(nodes_[nodes[k]].sample));
      }
      paths.push_back(std::move(path));
    }
    return paths;
  }

 private:
  struct Node {
    Id sample;
    std::uint32_t parent;
    std::uint32_t heir = kNoNode;    // the child whose branch continues
    std::uint32_t second = kNoNode;  // the child that would continue without the heir
    std::uint32_t low = 0;           // low samples from here to the end of the branch
  };
  struct Waiting {
    float height;
    Id sample;
    std::uint32_t parent;
    /// The lowest sample comes first.
    friend bool operator<(const Waiting& a, const Waiting& b) {
      return std::pair(a.height, a.sample) > std::pair(b.height, b.sample);
    }
  };

  void grow(Id root) {
    std::priority_queue<Waiting> waiting;
    near_.reach(root);
    waiting.push({near_.height(root), root, kNoNode});
    while (!waiting.empty()) {
      const Waiting next = waiting.top();
      waiting.pop();
      const auto n = static_cast<std::uint32_t>(nodes_.size());
      nodes_.push_back({next.sample, next.parent});
      near_.visit_neighbours(next.sample, [&](Id i) {
        if (near_.is_reached(i)) return;
        near_.reach(i);
        waiting.push({near_.height(i), i, n});
      });
    }
  }

  void weigh() {
    const auto low = [&](std::uint32_t n) { return n == kNoNode ? 0 : nodes_[n].low; };
    // Children precede their parents, the last child first, so that among equal branches the first one continues.
    for (auto n = static_cast<std::uint32_t>(nodes_.size()); n-- > 0;) {
      Node& node = nodes_[n];
      node.low = low(node.heir) + (is_low(n) ? 1 : 0);
      if (node.parent == kNoNode) continue;
      Node& parent = nodes_[node.parent];
      if (node.low >= low(parent.heir)) {
        parent.second = std::exchange(parent.heir, n);
      } else if (node.low >= low(parent.second)) {
        parent.second = n;
      }
    }
  }

  bool is_low(std::uint32_t n) const { return near_.is_low(nodes_[n].sample); }

  /// The branch from a node to its last low sample.
  std::vector<std::uint32_t> course(std::uint32_t first) const {
    std::vector<std::uint32_t> path;
    for (std::uint32_t n = first; n != kNoNode; n = nodes_[n].heir) path.push_back(n);
    while (!path.empty() && !is_low(path.back())) path.pop_back();
    return path;
  }
  /// Both branches that continue at a root.
  std::vector<std::uint32_t> trunk(std::uint32_t root) const {
    std::vector<std::uint32_t> path;
    if (nodes_[root].second != kNoNode) path = course(nodes_[root].second);
    std::reverse(path.begin(), path.end());
    const std::vector<std::uint32_t> rest = course(root);
    path.insert(path.end(), rest.begin(), rest.end());
    path.erase(path.begin(), std::find_if(path.begin(), path.end(), [&](std::uint32_t n) { return is_low(n); }));
    return path;
  }
  bool is_valley(const std::vector<std::uint32_t>& path) const {
    const auto count = [&](Hollow least) {
      return static_cast<std::size_t>(std::count_if(
          path.begin(), path.end(), [&](std::uint32_t n) { return near_.hollow(nodes_[n].sample) >= least; }));
    };
    return count(Hollow::kFaint) >= kShortestValley && count(Hollow::kClear) >= kShortestValley / 2;
  }

  Near near_;
  std::vector<Node> nodes_;
};

}  // namespace

std::vector<ValleyPath> follow_valleys(const grid::Raster& raster, const std::vector<Hollow>& hollows,
                                       const std::function<bool(Point)>& is_left_out) {
  return Forest(DenseNear(raster, hollows, is_left_out)).paths();
}

std::vector<ValleyPath> follow_valleys(const HollowSamples& samples) { return Forest(SparseNear(samples)).paths(); }

}  // namespace scarp::features
