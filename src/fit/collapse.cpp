#include "fit/collapse.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>

#include "base/function_ref.h"
#include "base/sort.h"
#include "fit/fan.h"

namespace scarp::fit {

namespace {

/// Largest rise of energy that is tried, and its multiple beyond which a search ends after its first places.
constexpr float kMostRise = 300, kFarReach = 10;

/// Edges with longer rings are ignored.
constexpr std::size_t kMostCorners = 16;

constexpr std::array<double, 3> kStarts{0.5, 0.15, 0.85}, kCollapseReaches{0.3, 0.15, 0.07};
constexpr int kSteps = 3;  // most steps of each reach
constexpr std::array<Point, 4> kCollapseWays{Point{1, 0}, {-1, 0}, {0, 1}, {0, -1}};

constexpr float kNever = std::numeric_limits<float>::infinity();

}  // namespace

/// False if the edge cannot be collapsed.
bool Collapse::find_polygon(Patch::Id v, Patch::Id u) {
  for (const Patch::Id end : {v, u}) {
    if (patch_.is_removed(end) || patch_.is_locked(end)) return false;
  }
  patch_.find_star(v, star_);
  patch_.find_star(u, other_);
  const std::size_t n = star_.ring.size(), m = other_.ring.size();
  if (!star_.closed || !other_.closed || std::min(n, m) < 4 || std::max(n, m) > kMostCorners) return false;
  hub_ = static_cast<std::size_t>(std::find(star_.ring.begin(), star_.ring.end(), u) - star_.ring.begin());
  const auto back =
      static_cast<std::size_t>(std::find(other_.ring.begin(), other_.ring.end(), v) - other_.ring.begin());
  if (hub_ == n || back == m) return false;
  polygon_.clear();
  for (std::size_t i = 1; i < n; ++i) polygon_.push_back(star_.ring[(hub_ + i) % n]);
  for (std::size_t i = 2; i + 1 < m; ++i) {
    const Patch::Id beyond = other_.ring[(back + i) % m];
    // If both ends have a third common neighbour, the triangles between would be inverted.
    if (std::find(polygon_.begin(), polygon_.end(), beyond) != polygon_.end()) return false;
    polygon_.push_back(beyond);
  }
  energy_ = 0;
  floor_ = rules_.shape.least();
  const auto replace = [&](Patch::Id f) {
    const auto& [a, b, c] = patch_.face(f).corners;
    energy_ += patch_.face(f).energy;
    if (rules_.shape.is_on()) floor_ = rules_.shape.lowered(floor_, patch_.at(a), patch_.at(b), patch_.at(c));
  };
  for (const Patch::Id f : star_.faces) replace(f);
  // The first and the last triangle from v on are the two that both stars share.
  for (std::size_t i = 1; i + 1 < m; ++i) replace(other_.faces[(back + i) % m]);
  return true;
}

/// Finds the best place of the new vertex; false if its energy is too high.
bool Collapse::search(Patch::Id v, Patch::Id u, Offer& offer) const {
  const FitCorner &a = patch_.at(v), &b = patch_.at(u);
  float least = kNever;
  FitCorner best;
  const Fan fan(polygon_.size(), [this](std::size_t i) -> const FitCorner& { return corner(i); });
  const auto look = [&](double x, double y, double z) {
    FitCorner place{static_cast<std::int32_t>(std::lround(x / grid::kFreeStep)) * grid::kFreeStep,
                    static_cast<std::int32_t>(std::lround(y / grid::kFreeStep)) * grid::kFreeStep,
                    static_cast<float>(z)};
    if (!fan.fits(place, rules_.shape, floor_)) return false;
    const auto raised = fan.raise(loose_, rules_, place, [&](double energy) { return energy < least; });
    const auto energy = raised.energy < kNever ? static_cast<float>(raised.least) : kNever;
    if (!(energy < least)) return false;
    least = energy;
    best = raised.place;
    return true;
  };
  const double x = b.x - a.x, y = b.y - a.y, z = double{b.z} - double{a.z};
  for (const double share : kStarts) look(a.x + share * x, a.y + share * y, double{a.z} + share * z);
  if (!(least < energy_ + kFarReach * kMostRise)) return false;
  const double length = std::sqrt(x * x + y * y);
  for (const double reach : kCollapseReaches) {
    bool is_better = true;
    for (int step = 0; is_better && step < kSteps; ++step) {
      const FitCorner from = best;
      is_better = false;
      for (const Point& way : kCollapseWays)
        is_better |= look(from.x + way.x * reach * length, from.y + way.y * reach * length, double{from.z});
    }
  }
  if (!(least < energy_ + kMostRise)) return false;
  offer = {least - energy_ - (rules_.shape.is_short(a, b) ? kShortEdgeFirst : 0), v, u, best};
  return true;
}

/// Offers each edge once, from its end with the lower number.
void Collapse::offer_edges_of(Patch::Id v, FunctionRef<bool(Patch::Id)> is_wanted) {
  if (patch_.is_removed(v) || patch_.is_locked(v)) return;
  patch_.find_star(v, around_);
  for (const Patch::Id u : around_.ring) {
    Offer offer;
    if (u > v && (is_wanted(v) || is_wanted(u)) && find_polygon(v, u) && search(v, u, offer)) offers_.push_back(offer);
  }
}

/// Adds the triangles of a fan about the hub between two corners of v's ring, in the order of Patch::RingTriangle.
void Collapse::add_fan(std::size_t first, std::size_t last) {
  if (last < first + 2) return;
  const std::size_t middle = first == hub_ ? last - 1 : last == hub_ ? first + 1 : hub_;
  fan_.push_back(
      {static_cast<std::uint8_t>(first), static_cast<std::uint8_t>(middle), static_cast<std::uint8_t>(last), -1, -1});
  add_fan(first, middle);
  add_fan(middle, last);
}

bool Collapse::take(const Offer& offer) {
  if (!find_polygon(offer.v, offer.u)) return false;
  for (std::size_t i = 0; i < polygon_.size(); ++i) {
    const auto verdict = loose_.assess(offer.place, corner(i), corner(i + 1), kNever);
    if (verdict.kind != TriangleError::Verdict::Kind::kKeeps) return false;
  }
  fan_.clear();
  add_fan(0, star_.ring.size() - 1);
  return repair_.merge(offer.v, star_, fan_, offer.u, offer.place);
}

Collapse::Counts Collapse::run(FunctionRef<bool(Patch::Id)> is_wanted, const std::function<bool()>& is_time_up) {
  const auto is_over = [&] { return is_time_up && is_time_up(); };
  offers_.clear();
  for (Patch::Id v = 0; v < patch_.node_count() && !is_over(); ++v) offer_edges_of(v, is_wanted);
  sort_rarely(offers_, [](const Offer& a, const Offer& b) {
    return a.rise != b.rise ? a.rise < b.rise : a.v != b.v ? a.v < b.v : a.u < b.u;
  });
  Counts counts;
  std::vector<std::uint8_t> is_stale(patch_.node_count(), 0);
  for (const Offer& offer : offers_) {
    if (is_over()) break;
    if (is_stale[offer.v] != 0 || is_stale[offer.u] != 0) continue;
    ++counts.tried;
    if (!take(offer)) continue;
    ++counts.done;
    for (const Patch::Id changed : repair_.changed()) is_stale[changed] = 1;
  }
  return counts;
}

}  // namespace scarp::fit
