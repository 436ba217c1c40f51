#include "fit/flips.h"

#include <algorithm>
#include <limits>

namespace scarp::fit {

namespace {

/// Least gain as a share of the energy before, so that roundings never flip an edge back and forth.
constexpr float kFlipGain = 1e-5f;

}  // namespace

bool Flips::has_shape(const Patch::Quad& q) const {
  if (!shape_.is_on()) return true;
  const FitCorner &a = patch_.at(q.a), &b = patch_.at(q.b), &c = patch_.at(q.c), &d = patch_.at(q.d);
  const TriangleShape floor = shape_.lowered(shape_.lowered(shape_.least(), a, b, c), b, a, d);
  return shape_.shape(c, a, d).worse_of(shape_.shape(d, b, c)).keeps(floor);
}

bool Flips::Trial::operator==(const Trial& other) const {
  const auto is_same = [](const FitCorner& a, const FitCorner& b) { return a.x == b.x && a.y == b.y && a.z == b.z; };
  return limit == other.limit && std::equal(corners.begin(), corners.end(), other.corners.begin(), is_same);
}

Flips::Trial Flips::trial_of(const Patch::Quad& q, float limit) const {
  const FitCorner &a = patch_.at(q.a), &b = patch_.at(q.b), &c = patch_.at(q.c), &d = patch_.at(q.d);
  return q.a < q.b ? Trial{{a, b, c, d}, limit} : Trial{{b, a, d, c}, limit};
}

Flips::Trial& Flips::place_of(const Patch::Quad& q) { return refused_[(q.a * q.b + 3 * (q.c + q.d)) % kRefusals]; }

bool Flips::improve(const TriangleError& error, Patch::Id face, unsigned edge) {
  if (Patch::is_border(patch_.face(face).links[edge])) return false;
  const Patch::Quad q = patch_.quad(face, edge);
  const FitCorner &a = patch_.at(q.a), &b = patch_.at(q.b), &c = patch_.at(q.c), &d = patch_.at(q.d);
  if (area2(c, a, d) <= 0 || area2(d, b, c) <= 0 || !has_shape(q)) return false;
  const float limit = (patch_.face(q.face).energy + patch_.face(q.beyond).energy) * (1 - kFlipGain);
  const Trial trial = trial_of(q, limit);
  Trial& refused = place_of(q);
  if (refused == trial) return false;
  const auto near = error.assess(c, a, d, limit);
  const bool near_keeps = near.kind == TriangleError::Verdict::Kind::kKeeps;
  const auto far = near_keeps ? error.assess(d, b, c, limit - near.energy) : near;
  if (far.kind != TriangleError::Verdict::Kind::kKeeps) {
    refused = trial;
    return false;
  }
  flip(q, near, far);
  return true;
}

bool Flips::heal(const TriangleError& error, Patch::Id face, unsigned edge) {
  constexpr double kWorthFlip = 1.01;
  if (!shape_.is_on() || Patch::is_border(patch_.face(face).links[edge])) return false;
  const Patch::Quad q = patch_.quad(face, edge);
  const FitCorner &a = patch_.at(q.a), &b = patch_.at(q.b), &c = patch_.at(q.c), &d = patch_.at(q.d);
  const TriangleShape least = shape_.least(), before = shape_.shape(a, b, c).worse_of(shape_.shape(b, a, d));
  if (before.keeps(least) || area2(c, a, d) <= 0 || area2(d, b, c) <= 0) return false;
  const TriangleShape after = shape_.shape(c, a, d).worse_of(shape_.shape(d, b, c));
  // The form comes first, so that no edge is flipped back and forth.
  const bool is_thin = before.form < least.form;
  if (is_thin ? after.form < kWorthFlip * before.form
              : after.form < least.form || after.edge < kWorthFlip * before.edge)
    return false;
  constexpr float kAnyEnergy = std::numeric_limits<float>::infinity();
  const auto near = error.assess(c, a, d, kAnyEnergy);
  if (near.kind != TriangleError::Verdict::Kind::kKeeps) return false;
  const auto far = error.assess(d, b, c, kAnyEnergy);
  if (far.kind != TriangleError::Verdict::Kind::kKeeps) return false;
  flip(q, near, far);
  return true;
}

void Flips::flip(const Patch::Quad& q, const TriangleError::Verdict& near, const TriangleError::Verdict& far) {
  patch_.flip(q);
  patch_.set_measure(q.face, near.worst, near.energy);
  patch_.set_measure(q.beyond, far.worst, far.energy);
}

}  // namespace scarp::fit
