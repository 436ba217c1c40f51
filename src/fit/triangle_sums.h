// The sums over the samples of a trial triangle, in vectors of four. The order of the sums is part of the result. Only
// for triangle_error.cpp, triangle_pull.cpp and triangle_kernels.cpp.
#pragma once

#include <algorithm>
#include <array>
#include <cstddef>
#include <limits>

#include "fit/triangle_kernels.h"
#include "fit/triangle_scan.h"

namespace scarp::fit {

inline float sum_of(Floats low, Floats high) {
  const Floats s = low + high;
  return std::min((s[0] + s[2]) + (s[1] + s[3]), std::numeric_limits<float>::max());
}
inline double exact_sum_of(Floats s) { return (double{s[0]} + s[2]) + (double{s[1]} + s[3]); }

/// Largest error, lane by lane.
struct Largest {
  Floats worst{};

  void add(Floats low, Floats high) { worst = larger_of(larger_of(low, high), worst); }
  bool exceeds(float cut) const { return any(worst > all(cut)); }
  float largest() const { return std::max(std::max(worst[0], worst[2]), std::max(worst[1], worst[3])); }
};

/// Also the sum of squares.
struct Squares : Largest {
  Floats low_sum{}, high_sum{};

  void add(Floats low, Floats high, float) {
    Largest::add(low, high);
    low_sum += low * low;
    high_sum += high * high;
  }
  float energy(float per_square) const { return sum_of(low_sum, high_sum) * per_square; }
};

/// Also the sum of eighth powers of errors in thresholds.
struct EighthPowers : Largest {
  Floats low_sum{}, high_sum{};

  void add(Floats low, Floats high, float per_square) {
    Largest::add(low, high);
    const Floats low2 = low * low * all(per_square), high2 = high * high * all(per_square);
    const Floats low4 = low2 * low2, high4 = high2 * high2;
    low_sum += low4 * low4;
    high_sum += high4 * high4;
  }
  float energy(float) const { return sum_of(low_sum, high_sum); }
};

// For every four samples: t, the error in thresholds, and λ, its change per unit rise of the corner.

struct SquarePull {
  Floats stiffness{}, push{};

  void add(Floats t, Floats share) {
    stiffness += share * share;
    push += share * t;
  }
};

struct EighthPull {
  Floats stiffness{}, push{};

  void add(Floats t, Floats share) {
    const Floats t2 = t * t, weighed = t2 * t2 * t2 * share;
    stiffness += weighed * share;
    push += weighed * t;
  }
};

template <std::size_t kCount>
struct MomentSums {
  std::array<Floats, kCount> sums{};

  void join(const MomentSums& other) {
    for (std::size_t k = 0; k < kCount; ++k) sums[k] += other.sums[k];
  }
};

struct SquareMoments : MomentSums<3> {
  void add(Floats t, Floats share) {
    sums[0] += t * t;
    sums[1] += t * share;
    sums[2] += share * share;
  }
};

struct EighthMoments : MomentSums<9> {
  void add(Floats t, Floats share) {
    const Floats t2 = t * t, t4 = t2 * t2, share2 = share * share, share4 = share2 * share2, both = t * share;
    sums[0] += t4 * t4;
    sums[1] += t4 * t2 * both;
    sums[2] += t4 * t2 * share2;
    sums[3] += t4 * both * share2;
    sums[4] += t4 * share4;
    sums[5] += t2 * both * share4;
    sums[6] += t2 * share4 * share2;
    sums[7] += both * share4 * share2;
    sums[8] += share4 * share4;
  }
};

template <class Sums>
void add_up(const Sums& of, TriangleError::Moments& moments) {
  for (std::size_t k = 0; k < of.sums.size(); ++k) moments[k] += exact_sum_of(of.sums[k]);
}

struct RoomLeft {
  Floats lowest, highest;

  explicit RoomLeft(const TriangleError::Room& room) : lowest(all(room.lowest)), highest(all(room.highest)) {}
  void add(Floats t, Floats share) {
    const Masks weighs = share > all(kLeastShare);
    const Floats down = (all(-1) - t) / share, up = (all(1) - t) / share;
    lowest = (weighs & (down > lowest)) ? down : lowest;
    highest = (weighs & (up < highest)) ? up : highest;
  }
  TriangleError::Room room() const {
    return {std::max({lowest[0], lowest[1], lowest[2], lowest[3]}),
            std::min({highest[0], highest[1], highest[2], highest[3]})};
  }
};

}  // namespace scarp::fit
