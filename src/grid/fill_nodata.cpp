// Filling nodata.
//
// Problem: a nodata sample needs a height from the valid samples around it, weighted by proximity, in time independent
// of the size of the area.
//
// Idea: search only along the eight compass directions. A sample's nearest valid sample to the north-west is its
// north-western neighbour if valid, and otherwise that neighbour's result. So one sweep down the rows finds W, N, NW
// and NE, and one sweep up finds E, S, SW and SE. Each nodata sample accumulates Σ w and Σ w·(z − reference), with w =
// 1 / distance², in two passes over the raster. The reference is the first height found, so a flat surround gives
// exactly its height. Σ w is a float, to save memory; Σ w·(z − reference) may exceed float's range. Heights are written
// at the end, so filled samples do not affect each other.
//
// Sources: sweeps as in distance transforms (Rosenfeld & Pfaltz 1966); weights of Shepard (1968).
#include <algorithm>
#include <cmath>
#include <cstddef>
#include <limits>
#include <vector>

#include "scarp/height_field.h"

namespace scarp {
namespace {

/// The nearest valid sample along one direction.
struct Seen {
  float height = 0;
  int steps = -1;  ///< distance; −1: none
};

/// Sums of one nodata sample: 16 bytes.
struct Gathered {
  float reference = 0;
  float weight = 0;
  double weighted = 0;  ///< Σ w·(z − reference)
};

class Sweeper {
 public:
  Sweeper(const OwnedHeightField& field, std::vector<Gathered>& gathered, double max_distance)
      : field_(field), gathered_(gathered), max_squared_(max_distance * max_distance) {}

  /// Visits rows downwards and columns eastwards (`step` = +1), or the reverse (−1). Accumulates heights for each
  /// nodata sample along the four directions behind the sweep.
  void sweep(int step) {
    const int cols = field_.cols, rows = field_.rows;
    const std::size_t width = static_cast<std::size_t>(cols);
    // Results of the previous row and of this one: straight, left, right. Each border has an extra column.
    std::vector<Seen> straight(width + 2), left(width + 2), right(width + 2);
    std::vector<Seen> next_straight(width + 2), next_left(width + 2), next_right(width + 2);
    std::size_t slot = step > 0 ? 0 : gathered_.size();
    for (int r = 0; r < rows; ++r) {
      const int row = step > 0 ? r : rows - 1 - r;
      const float* line = field_.samples.data() + static_cast<std::size_t>(row) * width;
      Seen beside;
      for (int c = 0; c < cols; ++c) {
        const int col = step > 0 ? c : cols - 1 - c;
        const std::size_t at = static_cast<std::size_t>(col) + 1;
        const float height = line[col];
        if (std::isfinite(height)) {
          beside = next_straight[at] = next_left[at] = next_right[at] = {height, 0};
          continue;
        }
        beside = farther(beside);
        next_straight[at] = farther(straight[at]);
        next_left[at] = farther(left[at - 1]);
        next_right[at] = farther(right[at + 1]);
        Gathered& sums = gathered_[step > 0 ? slot++ : --slot];
        gather(sums, beside, 1);
        gather(sums, next_straight[at], 1);
        gather(sums, next_left[at], 2);
        gather(sums, next_right[at], 2);
      }
      straight.swap(next_straight);
      left.swap(next_left);
      right.swap(next_right);
    }
  }

 private:
  static Seen farther(Seen seen) {
    if (seen.steps >= 0) ++seen.steps;
    return seen;
  }

  /// `squared_step`: squared length of one step along the direction.
  void gather(Gathered& sums, const Seen& seen, double squared_step) const {
    if (seen.steps < 0) return;
    const double squared = squared_step * seen.steps * seen.steps;
    if (squared > max_squared_) return;
    if (sums.weight == 0) sums.reference = seen.height;
    const double weight = 1 / squared;
    const double rise = static_cast<double>(seen.height) - static_cast<double>(sums.reference);
    sums.weight = static_cast<float>(sums.weight + weight);
    sums.weighted += weight * rise;
  }

  const OwnedHeightField& field_;
  std::vector<Gathered>& gathered_;
  double max_squared_;
};

}  // namespace

std::uint64_t fill_nodata(OwnedHeightField& field, double max_distance) {
  field.own();
  std::size_t nodata = 0;
  for (const float z : field.samples) nodata += std::isfinite(z) ? 0 : 1;
  if (nodata == 0) return 0;
  std::vector<Gathered> gathered(nodata);
  Sweeper sweeper(field, gathered, max_distance);
  sweeper.sweep(1);
  sweeper.sweep(-1);
  constexpr double kLargest = std::numeric_limits<float>::max();  // a rounded mean of the largest heights may exceed it
  std::uint64_t filled = 0;
  std::size_t slot = 0;
  for (float& z : field.samples) {
    if (std::isfinite(z)) continue;
    const Gathered& sums = gathered[slot++];
    if (sums.weight == 0) continue;
    const double mean = static_cast<double>(sums.reference) + sums.weighted / static_cast<double>(sums.weight);
    z = static_cast<float>(std::clamp(mean, -kLargest, kLargest));
    ++filled;
  }
  return filled;
}

std::uint64_t fill_background(OwnedHeightField& field, float value) {
  field.own();
  std::uint64_t filled = 0;
  for (float& z : field.samples) {
    if (std::isfinite(z)) continue;
    z = value;
    ++filled;
  }
  return filled;
}

}  // namespace scarp
