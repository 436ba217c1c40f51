// Nodes with water in them.
#include <algorithm>
#include <cmath>
#include <limits>
#include <utility>
#include <vector>

#include "base/parallel.h"
#include "globe/node_places.h"
#include "globe/row_range.h"
#include "scarp/features.h"
#include "tiles/water/tile_waters.h"
#include "tiles/water/water_shapes.h"

namespace scarp::tiles {
namespace {

constexpr float kNoHeight = std::numeric_limits<float>::quiet_NaN();
/// Nodes a side of a box whose samples are examined at once.
constexpr double kMostNodesAtOnce = 1024;

/// The kind of water that claims a node. The greatest claim wins.
enum class Claim : std::uint8_t { kNone, kRim, kRiver, kLake };

std::int64_t ceil_of(std::int64_t a, std::int64_t b) { return -globe::floor_of(-a, b); }

/// The effect of water on the nodes of a window.
class Claims {
 public:
  Claims(const NodeWindow& window, std::int64_t per_turn)
      : window_(window),
        stride_(per_turn / window.per_turn),
        claims_(static_cast<std::size_t>(window.cols) * static_cast<std::size_t>(window.rows), Claim::kNone),
        heights_(claims_.size(), kNoHeight) {}

  /// Adds a claim on nodes [first, end) in a row of the fine lattice, in any turn.
  void add(std::int64_t row, std::int64_t first, std::int64_t end, Claim claim, float height) {
    const std::int64_t j = globe::floor_of(row, stride_) - window_.row;
    if (row % stride_ != 0 || j < 0 || j >= window_.rows || window_.is_pole(window_.row + j)) return;
    const std::int64_t coarse_turn = window_.per_turn;
    // Columns of the window in each turn that meets them.
    const std::int64_t from = ceil_of(first, stride_), to = ceil_of(end, stride_);
    if (from >= to) return;
    const std::int64_t least = ceil_of(window_.col - to + 1, coarse_turn),
                       most = globe::floor_of(window_.col + window_.cols - 1 - from, coarse_turn);
    for (std::int64_t turn = least; turn <= most; ++turn) {
      const std::int64_t begin = std::max<std::int64_t>(from + turn * coarse_turn - window_.col, 0),
                         stop = std::min<std::int64_t>(to + turn * coarse_turn - window_.col, window_.cols);
      for (std::int64_t i = begin; i < stop; ++i) take(static_cast<std::size_t>(j * window_.cols + i), claim, height);
    }
  }

  /// Relevant rows of the fine lattice.
  std::int64_t first_row() const { return window_.row * stride_ - 1; }
  std::int64_t last_row() const { return (window_.row + window_.rows - 1) * stride_ + 1; }

  Claim claim(std::size_t i) const { return claims_[i]; }
  float height(std::size_t i) const { return heights_[i]; }
  std::span<const float> heights() const { return heights_; }
  bool is_any() const { return is_any_; }

 private:
  void take(std::size_t i, Claim claim, float height) {
    if (claims_[i] > claim) return;
    if (claims_[i] == claim && claim == Claim::kRim) height = std::max(height, heights_[i]);
    if (claims_[i] == claim && claim == Claim::kRiver) height = std::min(height, heights_[i]);
    claims_[i] = claim;
    heights_[i] = height;
    is_any_ = true;
  }

  NodeWindow window_;
  std::int64_t stride_;
  std::vector<Claim> claims_;
  std::vector<float> heights_;
  bool is_any_ = false;
};

/// Heights of one window, as a source to raise.
class HeldHeights final : public NodeSource {
 public:
  explicit HeldHeights(std::span<const float> heights) : heights_(heights) {}
  Result<void> read(const NodeWindow&, std::span<float> out) const override {
    std::copy(heights_.begin(), heights_.end(), out.begin());
    return {};
  }

 private:
  std::span<const float> heights_;
};

class WateredNodes final : public NodeSource {
 public:
  WateredNodes(const NodeSource& source, std::shared_ptr<const TileWaters> waters,
               std::shared_ptr<const HeightZero> zero)
      : source_(source), waters_(std::move(waters)), zero_(std::move(zero)) {
    for (const TileLake& lake : waters_->lakes) {
      const auto box = std::isnan(lake.level) ? std::nullopt : box_of(lake, *waters_);
      if (box) lakes_.push_back({&lake, *box});
    }
    for (const TileRiver& river : waters_->rivers) {
      NodesAround around;
      for (const auto& point : river.course) around.add(point[0], point[1]);
      if (const auto box = around.box(*waters_)) rivers_.push_back({&river, *box});
    }
    kept_.with([&](Kept& kept) {
      kept.lakes.resize(lakes_.size());
      kept.rivers.resize(rivers_.size());
    });
  }

  Result<void> read(const NodeWindow& window, std::span<float> out) const override {
    if (window.grid.kind != waters_->grid.kind || waters_->per_turn % window.per_turn != 0)
      return fail(ErrorKind::kUsage,
                  "these tiles have other nodes than the plan, and water is known at those of the plan "
                  "alone: give the plan that the tiles are made by");
    SCARP_RETURN_IF_ERROR(source_.read(window, out));
    if (!meets_any(window)) return {};
    const Claims claims = claims_in(window);
    if (!claims.is_any()) return {};
    std::vector<float> heights(claims.heights().begin(), claims.heights().end());
    for (std::size_t i = 0; i < heights.size(); ++i) {
      if (std::isnan(out[i])) heights[i] = kNoHeight;
    }
    SCARP_RETURN_IF_ERROR(raise(window, heights));
    for (std::size_t i = 0; i < heights.size(); ++i) {
      if (std::isnan(heights[i])) continue;
      out[i] = claims.claim(i) == Claim::kRim ? std::max(out[i], heights[i]) : heights[i];
    }
    return {};
  }

  /// Water changes heights but never adds any.
  NodeWindow land(const NodeWindow& window) const override { return source_.land(window); }

  bool has_samples() const override { return source_.has_samples(); }

  Result<void> visit_samples(const DegreeBox& box, const SampleVisitor& visit) const override {
    const globe::NodePlaces places(waters_->grid, waters_->per_turn);
    const double left = places.col(box.west), right = places.col(box.east);
    const double top = places.row(box.north), bottom = places.row(box.south);
    if (right - left > kMostNodesAtOnce || bottom - top > kMostNodesAtOnce) {
      const double x = (box.west + box.east) / 2, y = (box.south + box.north) / 2;
      for (const DegreeBox& part : {DegreeBox{box.west, box.south, x, y}, DegreeBox{x, box.south, box.east, y},
                                    DegreeBox{box.west, y, x, box.north}, DegreeBox{x, y, box.east, box.north}}) {
        SCARP_RETURN_IF_ERROR(visit_samples(part, visit));
      }
      return {};
    }
    NodeWindow window{waters_->per_turn, static_cast<std::int64_t>(std::floor(left)) - 1, 0, 0, 0, waters_->grid};
    window.row = std::max<std::int64_t>(static_cast<std::int64_t>(std::floor(top)) - 1, 0);
    window.cols = static_cast<int>(static_cast<std::int64_t>(std::ceil(right)) + 2 - window.col);
    window.rows = static_cast<int>(std::min(static_cast<std::int64_t>(std::ceil(bottom)) + 1, window.last_row()) + 1 -
                                   window.row);
    if (!meets_any(window)) return source_.visit_samples(box, visit);
    const Claims claims = claims_in(window);
    if (!claims.is_any()) return source_.visit_samples(box, visit);
    std::vector<float> raised(claims.heights().begin(), claims.heights().end());
    SCARP_RETURN_IF_ERROR(raise(window, raised));
    std::vector<float> changed;
    return source_.visit_samples(box, [&](const SampleRow& row) {
      const auto [first, end] = globe::range_within(row.longitude, row.step_longitude, row.latitude, row.step_latitude,
                                                    row.heights.size(), box);
      if (first >= end) return;
      SampleRow part = row;
      part.longitude += row.step_longitude * static_cast<double>(first);
      part.latitude += row.step_latitude * static_cast<double>(first);
      changed.assign(row.heights.begin() + static_cast<std::ptrdiff_t>(first),
                     row.heights.begin() + static_cast<std::ptrdiff_t>(end));
      const double level_row = places.row(part.latitude);
      for (std::size_t k = 0; k < changed.size(); ++k) {
        if (std::isnan(changed[k])) continue;
        const double steps = static_cast<double>(k);
        const double x = places.col(part.longitude + row.step_longitude * steps) - static_cast<double>(window.col);
        const double y = row.step_latitude == 0 ? level_row : places.row(part.latitude + row.step_latitude * steps);
        changed[k] = sample_at(claims, raised, window, x, y - static_cast<double>(window.row), changed[k]);
      }
      part.heights = changed;
      visit(part);
    });
  }

 private:
  struct PlacedLake {
    const TileLake* lake;
    NodeBox box;
  };
  struct PlacedRiver {
    const TileRiver* river;
    NodeBox box;
  };
  /// Nodes of lakes and rivers that were read so far.
  struct Kept {
    std::vector<std::shared_ptr<const std::vector<grid::SampleRun>>> lakes;
    std::vector<std::shared_ptr<const std::vector<RiverNode>>> rivers;
  };

  /// The height of a sample between four nodes: the level of a lake that contains all four; nothing if only some have
  /// water.
  static float sample_at(const Claims& claims, const std::vector<float>& raised, const NodeWindow& window, double x,
                         double y, float height) {
    const auto before = [](double place, int count) {
      return static_cast<std::size_t>(std::clamp(std::floor(place), 0.0, count - 2.0));
    };
    const std::size_t i = before(x, window.cols), j = before(y, window.rows);
    const auto cols = static_cast<std::size_t>(window.cols);
    const std::size_t at = j * cols + i;
    const std::array<std::size_t, 4> corners{at, at + 1, at + cols, at + cols + 1};
    const auto has_water = [&](std::size_t corner) { return claims.claim(corner) != Claim::kNone; };
    if (std::none_of(corners.begin(), corners.end(), has_water)) return height;
    const auto is_lake = [&](std::size_t corner) {
      return claims.claim(corner) == Claim::kLake && claims.height(corner) == claims.height(at);
    };
    if (!std::all_of(corners.begin(), corners.end(), is_lake)) return kNoHeight;
    const double tx = x - static_cast<double>(i), ty = y - static_cast<double>(j);
    const double upper = raised[at] + tx * (double{raised[at + 1]} - raised[at]),
                 lower = raised[at + cols] + tx * (double{raised[at + cols + 1]} - raised[at + cols]);
    return static_cast<float>(upper + ty * (lower - upper));
  }

  /// True if a box, with a node around it, meets the window in any turn.
  bool meets(const NodeBox& box, const NodeWindow& window) const {
    const std::int64_t turn = waters_->per_turn, stride = turn / window.per_turn;
    const std::int64_t first = window.col * stride, last = (window.col + window.cols - 1) * stride;
    if (window.row * stride > box.row + box.rows || (window.row + window.rows - 1) * stride < box.row - 1) return false;
    return ceil_of(first - box.col - box.cols, turn) <= globe::floor_of(last - box.col + 1, turn);
  }

  bool meets_any(const NodeWindow& window) const {
    const auto does = [&](const auto& one) { return meets(one.box, window); };
    return std::any_of(lakes_.begin(), lakes_.end(), does) || std::any_of(rivers_.begin(), rivers_.end(), does);
  }

  template <class Member, class Make>
  auto look_up(Member member, std::size_t k, const Make& make) const {
    auto found = kept_.with([&](Kept& kept) { return (kept.*member)[k]; });
    if (found) return found;
    found = std::make_shared<const std::remove_cvref_t<decltype(*found)>>(make());
    kept_.with([&](Kept& kept) { (kept.*member)[k] = found; });
    return found;
  }

  Claims claims_in(const NodeWindow& window) const {
    Claims claims(window, waters_->per_turn);
    for (std::size_t k = 0; k < lakes_.size(); ++k) {
      const TileLake* const lake = lakes_[k].lake;
      const auto& box = lakes_[k].box;
      if (!meets(box, window)) continue;
      const auto runs = look_up(&Kept::lakes, k, [&] { return nodes_of(*lake, box); });
      const auto level = static_cast<float>(lake->level),
                 rim = static_cast<float>(lake->level + WaterOptions().freeboard);
      auto run = std::lower_bound(runs->begin(), runs->end(), claims.first_row() - box.row,
                                  [](const grid::SampleRun& one, std::int64_t row) { return one.row < row; });
      for (; run != runs->end() && box.row + run->row <= claims.last_row(); ++run) {
        const std::int64_t row = box.row + run->row, begin = box.col + run->begin, end = box.col + run->end;
        claims.add(row, begin, end, Claim::kLake, level);
        claims.add(row, begin - 1, begin, Claim::kRim, rim);
        claims.add(row, end, end + 1, Claim::kRim, rim);
        claims.add(row - 1, begin - 1, end + 1, Claim::kRim, rim);
        claims.add(row + 1, begin - 1, end + 1, Claim::kRim, rim);
      }
    }
    for (std::size_t k = 0; k < rivers_.size(); ++k) {
      const PlacedRiver& placed = rivers_[k];
      if (!meets(placed.box, window)) continue;
      const auto nodes = look_up(&Kept::rivers, k, [&] { return nodes_of(*placed.river); });
      auto node = std::lower_bound(nodes->begin(), nodes->end(), claims.first_row(),
                                   [](const RiverNode& one, std::int64_t row) { return one.row < row; });
      for (; node != nodes->end() && node->row <= claims.last_row(); ++node)
        claims.add(node->row, node->col, node->col + 1, Claim::kRiver, node->height);
    }
    return claims;
  }

  /// Converts heights above the zero to heights above the ellipsoid.
  Result<void> raise(const NodeWindow& window, std::vector<float>& heights) const {
    if (!zero_) return {};
    const std::vector<float> above = heights;
    const HeldHeights held(above);
    return make_raised_source(held, zero_)->read(window, heights);
  }

  const NodeSource& source_;
  std::shared_ptr<const TileWaters> waters_;
  std::shared_ptr<const HeightZero> zero_;
  std::vector<PlacedLake> lakes_;
  std::vector<PlacedRiver> rivers_;
  mutable Shared<Kept> kept_;
};

}  // namespace

std::unique_ptr<NodeSource> make_watered_source(const NodeSource& source, std::shared_ptr<const TileWaters> waters,
                                                std::shared_ptr<const HeightZero> zero) {
  return std::make_unique<WateredNodes>(source, std::move(waters), std::move(zero));
}

}  // namespace scarp::tiles
