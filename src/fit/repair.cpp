#include "fit/repair.h"

#include <algorithm>
#include <array>
#include <limits>

namespace scarp::fit {

namespace {

/// Errors above this, in thresholds, justify a flip.
constexpr double kWorthChange = 0.9;
/// The first limits of the excess, before the first round and after each. On terrain less than a tenth of the cases
/// above them could be repaired. The last value applies to all further rounds.
constexpr std::array<double, 5> kFirstLimits{2.5, 1, 0.42, 0.22, 0.11};
/// Excesses above this share of their limit are near it.
constexpr double kNearLimit = 0.6;
/// The rate at which a limit changes, and the share of its first value to which it may fall.
constexpr double kLearning = 0.2, kLeastLimit = 0.7;

double first_limit(const RepairDepth& depth, std::size_t round) {
  return depth.patience * kFirstLimits[std::min(round, kFirstLimits.size() - 1)];
}

}  // namespace

void measure(Patch& patch, const TriangleError& error, Patch::Id face) {
  const auto& [a, b, c] = patch.face(face).corners;
  const auto verdict = error.assess(patch.at(a), patch.at(b), patch.at(c), std::numeric_limits<float>::infinity());
  patch.set_measure(face, verdict.worst, verdict.energy);
}

bool Repair::remove(Patch::Id v, const Patch::Star& star, std::span<const Patch::RingTriangle> triangles) {
  ring_ = star.ring;
  moved_.clear();
  patch_.begin();
  patch_.remove(v, star, triangles);
  for (std::size_t i = 0; i < triangles.size(); ++i) {
    if (patch_.face(star.faces[i]).energy < 0) measure(patch_, loose_, star.faces[i]);
  }
  return finish();
}

bool Repair::merge(Patch::Id v, const Patch::Star& star, std::span<const Patch::RingTriangle> fan, Patch::Id u,
                   const FitCorner& place) {
  moved_.assign(1, u);
  patch_.begin();
  patch_.remove(v, star, fan);
  patch_.move(u, place);
  patch_.find_star(u, star_);
  ring_ = star_.ring;
  ring_.push_back(u);
  for (const Patch::Id f : star_.faces) measure(patch_, loose_, f);
  return finish();
}

Patch::Id Repair::insert(const FitCorner& place, Patch::Id face, std::optional<unsigned> edge) {
  const Patch::Id v = edge ? patch_.insert(place, face, *edge) : patch_.insert(place, face);
  patch_.find_star(v, star_);
  for (const Patch::Id f : star_.faces) measure(patch_, loose_, f);
  ring_ = star_.ring;
  ring_.push_back(v);
  moved_.assign(1, v);
  patch_.begin();
  mend_all();
  list_changed();
  patch_.commit();
  return v;
}

/// Repairs the bound after a removal, or undoes the removal.
bool Repair::finish() {
  if (!mend()) {
    patch_.roll_back();
    return false;
  }
  list_changed();
  patch_.commit();
  return true;
}

void Repair::mend_all() {
  for (const Patch::Id v : ring_) {
    if (step_.improve(loose_, v)) moved_.push_back(v);
  }
  for (const Patch::Id v : ring_) flip_around(v, 0);
}

std::vector<double> Repair::first_limits(const RepairDepth& depth) {
  std::vector<double> limits;
  for (std::size_t round = 0; round < static_cast<std::size_t>(depth.rounds); ++round)
    limits.push_back(first_limit(depth, round));
  return limits;
}

bool Repair::mend() {
  if (depth_.mends_all) {
    mend_all();
    return !excess().any;
  }
  excesses_.clear();
  const bool is_repaired = mend_by_rounds();
  learn(is_repaired);
  return is_repaired;
}

bool Repair::mend_by_rounds() {
  for (int round = 0;; ++round) {
    const Excess left = excess();
    if (!left.any) return true;
    if (round == depth_.rounds || left.sum > limits_[static_cast<std::size_t>(round)]) return false;
    excesses_.push_back(left.sum);
    for (const Patch::Id v : ring_) {
      if (is_strained(v, 1) && step_.improve(loose_, v)) moved_.push_back(v);
    }
    for (const Patch::Id v : ring_) flip_around(v, kWorthChange);
    if (depth_.probes && round % 2 == 1) look_around(round);
  }
}

void Repair::learn(bool is_repaired) {
  const double factor = 1 + kLearning * ((is_repaired ? 1 : 0) - depth_.worth);
  for (std::size_t round = 0; round < excesses_.size(); ++round) {
    double& limit = limits_[round];
    if (excesses_[round] > kNearLimit * limit)
      limit = std::max(kLeastLimit * first_limit(depth_, round), factor * limit);
  }
}

/// True if a triangle around v has an error above this share of the threshold.
bool Repair::is_strained(Patch::Id v, double share) {
  patch_.find_star(v, star_);
  return std::any_of(star_.faces.begin(), star_.faces.end(),
                     [&](Patch::Id f) { return patch_.face(f).worst > share * loose_.threshold(); });
}

void Repair::look_around(int round) {
  constexpr std::array<double, 3> kReaches{0.15, 0.07, 0.25};
  for (const Patch::Id v : ring_) {
    if (is_strained(v, 1) && step_.probe(loose_, v, kReaches[static_cast<std::size_t>(round) % 3])) moved_.push_back(v);
  }
}

Repair::Excess Repair::excess() const {
  Excess excess;
  const double threshold = loose_.threshold();
  for (const auto& copy : patch_.touched()) {
    const Patch::Face& face = patch_.face(copy.index);
    if (face.corners[0] == tin::kNone || face.worst <= threshold) continue;
    const double over = face.worst / threshold - 1;
    excess.any = true;
    excess.sum += over;
  }
  return excess;
}

/// Tries to flip edges of triangles around v with errors above this share of the threshold.
void Repair::flip_around(Patch::Id v, double share) {
  patch_.find_star(v, star_);
  for (const Patch::Id f : star_.faces) {
    for (unsigned edge = 0; edge < 3; ++edge) {
      if (patch_.face(f).worst > share * loose_.threshold()) flips_.improve(loose_, f, edge);
    }
  }
}

/// False if only a link to a neighbour changed.
bool Repair::has_changed(const Journal<Patch::Face>::Copy& copy) const {
  const auto& corners = patch_.face(copy.index).corners;
  return corners != copy.before.corners || std::any_of(corners.begin(), corners.end(), [this](Patch::Id v) {
           return std::find(moved_.begin(), moved_.end(), v) != moved_.end();
         });
}

void Repair::list_changed() {
  changed_.clear();
  for (const auto& copy : patch_.touched()) {
    const auto& corners = patch_.face(copy.index).corners;
    if (corners[0] != tin::kNone && has_changed(copy)) changed_.insert(changed_.end(), corners.begin(), corners.end());
  }
  std::sort(changed_.begin(), changed_.end());
  changed_.erase(std::unique(changed_.begin(), changed_.end()), changed_.end());
}

}  // namespace scarp::fit
