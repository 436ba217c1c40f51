#include "fit/insertion.h"

#include <algorithm>
#include <array>
#include <cmath>

#include "fit/fan.h"
#include "fit/schedule.h"

namespace scarp::fit {

namespace {

constexpr std::array<double, 3> kInsertShares{0.5, 0.3, 0.7};

}  // namespace

void Insertion::run(std::size_t most) {
  stamps_.assign(patch_.face_count(), 0);
  heap_.clear();
  for (Patch::Id f = 0; f < patch_.face_count(); ++f) {
    if (patch_.face(f).corners[0] != tin::kNone) offer(f);
  }
  std::size_t count = patch_.count_faces();
  while (!heap_.empty() && count + 2 <= most) {
    std::pop_heap(heap_.begin(), heap_.end(), is_later);
    const Offer best = heap_.back();
    heap_.pop_back();
    if (patch_.face(best.face).corners[0] == tin::kNone) continue;
    if (!is_fresh(best)) {
      offer(best.face);
      continue;
    }
    take(best);
    count += 2;
  }
}

bool Insertion::is_fresh(const Offer& offer) const {
  return stamps_[offer.face] == offer.stamp && stamps_[offer.beyond] == offer.stamp_beyond;
}

void Insertion::offer(Patch::Id face) {
  const Offer best = best_at(face);
  if (!(best.gain > 0)) return;
  heap_.push_back(best);
  std::push_heap(heap_.begin(), heap_.end(), is_later);
}

/// Each edge is tried from its face with the lower number.
Insertion::Offer Insertion::best_at(Patch::Id face) {
  Offer best;
  const Patch::Face& near = patch_.face(face);
  const std::array<FitCorner, 3> at{patch_.at(near.corners[0]), patch_.at(near.corners[1]), patch_.at(near.corners[2])};
  rim_.assign(at.begin(), at.end());
  energy_ = near.energy;
  floor_ = rules_.shape.lowered(rules_.shape.least(), at[0], at[1], at[2]);
  try_place((double{1} * at[0].x + at[1].x + at[2].x) / 3, (double{1} * at[0].y + at[1].y + at[2].y) / 3, best,
            {.face = face, .beyond = face});
  for (unsigned edge = 0; edge < 3; ++edge) {
    if (Patch::is_border(near.links[edge])) continue;
    const Patch::Quad q = patch_.quad(face, edge);
    if (q.beyond < face) continue;
    const FitCorner &a = patch_.at(q.a), &b = patch_.at(q.b);
    rim_ = {a, patch_.at(q.d), b, patch_.at(q.c)};
    energy_ = near.energy + patch_.face(q.beyond).energy;
    floor_ =
        rules_.shape.lowered(rules_.shape.lowered(rules_.shape.least(), at[0], at[1], at[2]), b, a, patch_.at(q.d));
    for (const double share : kInsertShares)
      try_place(a.x + share * (b.x - a.x), a.y + share * (b.y - a.y), best,
                {.face = face, .beyond = q.beyond, .edge = edge});
  }
  return best;
}

/// Accepts the place, at its best height, if it gains more than the best so far.
void Insertion::try_place(double x, double y, Offer& best, const Offer& kind) {
  const bool is_free = rules_.freedom == Freedom::kLattice;
  const std::int32_t unit = is_free ? grid::kFreeStep : grid::kLatticeSteps;
  FitCorner place{static_cast<std::int32_t>(std::lround(x / unit)) * unit,
                  static_cast<std::int32_t>(std::lround(y / unit)) * unit, rim_.front().z};
  if (!is_free && error_.has_points()) {
    place = error_.place_of(error_.sample_near(place));
  } else if (!is_free) {
    place.z = error_.height_at({place.x / grid::kLatticeSteps, place.y / grid::kLatticeSteps});
  }
  if (!(std::abs(place.z) <= geom::kMaxScanHeight)) return;
  const auto corner = [this](std::size_t i) -> const FitCorner& { return rim_[i % rim_.size()]; };
  const Fan fan(rim_.size(), corner);
  if (!fan.fits(place, rules_.shape, floor_)) return;
  const float limit = energy_ - best.gain;
  if (is_free) {
    const auto raised = fan.raise(error_, rules_, place, [](double) { return false; });
    if (!(raised.energy < double{limit})) return;
    place = raised.place;
  }
  float left = limit;
  for (std::size_t i = 0; i < rim_.size(); ++i) {
    const auto verdict = error_.assess(place, corner(i), corner(i + 1), left);
    if (verdict.kind != TriangleError::Verdict::Kind::kKeeps) return;
    left -= verdict.energy;
  }
  if (!(left > 0)) return;
  best = kind;
  best.gain = energy_ - (limit - left);
  best.place = place;
  best.stamp = stamps_[kind.face];
  best.stamp_beyond = stamps_[kind.beyond];
}

void Insertion::take(const Offer& offered) {
  const Patch::Id v = repair_.insert(offered.place, offered.face, offered.edge);
  stamps_.resize(patch_.face_count(), 0);
  for (const auto& copy : patch_.touched()) ++stamps_[copy.index];
  patch_.find_star(v, star_);
  for (const Patch::Id f : star_.faces) ++stamps_[f];
  for (const Patch::Id f : star_.faces) offer(f);
}

}  // namespace scarp::fit
