// The error metric of triangles with corners between samples. Corners have their own heights.
#pragma once

#include <cstddef>
#include <cstdint>
#include <optional>
#include <span>
#include <vector>

#include "geom/plane.h"
#include "grid/bands.h"
#include "grid/vertex_lattice.h"
#include "metric/error_metric.h"

namespace scarp::metric {

/// Heights of lattice points, from set() or else from their samples.
class LatticeHeights {
 public:
  explicit LatticeHeights(const grid::SampleView& samples) : samples_(samples), slots_(kFewest) {}
  void set(Point point, float height);
  /// Reserves memory for `count` points, so that set() need not rehash.
  void reserve(std::size_t count);
  static bool is_sample(Point point) {
    return point.x % grid::kLatticeSteps == 0 && point.y % grid::kLatticeSteps == 0;
  }
  /// REQUIRES: the point was set, or is a sample.
  float at(Point point) const {
    if (is_sample(point) && !has_samples_) return sample(point);
    const Slot& slot = slots_[find(key(point))];
    return slot.key != 0 ? slot.height : sample(point);
  }

 private:
  /// A slot of an open-addressing table, at most half filled.
  struct Slot {
    std::uint64_t key = 0;  // 0: an empty slot
    float height = 0;
  };
  static constexpr std::size_t kFewest = 64;

  float sample(Point point) const {
    return samples_.at({point.x / grid::kLatticeSteps, point.y / grid::kLatticeSteps});
  }
  static std::uint64_t key(Point point) {
    return (std::uint64_t{static_cast<std::uint32_t>(point.y)} << 32 | static_cast<std::uint32_t>(point.x)) + 1;
  }
  /// The key's slot, or the empty slot for it.
  std::size_t find(std::uint64_t key) const {
    std::size_t slot = (key * 0x9e3779b97f4a7c15) >> 32 & (slots_.size() - 1);
    while (slots_[slot].key != key && slots_[slot].key != 0) slot = (slot + 1) & (slots_.size() - 1);
    return slot;
  }

  grid::SampleView samples_;
  std::vector<Slot> slots_;
  std::size_t taken_ = 0;
  bool has_samples_ = false;  ///< true if set() changed heights of samples
};

/// Corners and candidates are in kLatticeSteps. Importance is error / bound if samples have individual bounds
/// (row-major, +infinity: no bound), otherwise the error. Comparisons with bounds are exact.
class LatticeMetric final : public ErrorMetric {
 public:
  /// `heights` and the bounds must outlive it.
  LatticeMetric(const grid::SampleView& samples, const LatticeHeights& heights, double threshold,
                std::span<const float> bounds)
      : samples_(samples), heights_(heights), threshold_(threshold) {
    if (!bounds.empty()) bounds_ = grid::SampleView(grid::Raster{bounds.data(), samples.cols(), samples.rows()});
  }
  /// With individual bounds in the rows of `bounds`.
  LatticeMetric(const grid::SampleView& samples, const LatticeHeights& heights, const grid::Band& bounds)
      : samples_(samples), heights_(heights), bounds_(bounds) {}

  Fit fit(const std::array<Point, 3>& corners, const FitQuestion& question) const override;
  std::optional<Candidate> find_candidate(const std::array<Point, 3>& corners, const Fit& fit) const override;
  double goal() const override { return bounds_ ? 1 : threshold_; }
  double squares_between(Point a, Point b) const override;
  double bend(const std::array<Point, 3>& a, const std::array<Point, 3>& b) const override;

 private:
  Fit fit_evenly(const std::array<Point, 3>& corners) const;
  Fit fit_by_bounds(const std::array<Point, 3>& corners) const;
  std::array<float, 3> heights_at(const std::array<Point, 3>& corners) const;
  geom::Plane plane_of(const std::array<Point, 3>& corners) const {
    return geom::Plane::through(corners, heights_at(corners));
  }
  double importance(double error, double bound) const;

  grid::SampleView samples_;
  const LatticeHeights& heights_;
  double threshold_ = 0;
  std::optional<grid::SampleView> bounds_;
};

}  // namespace scarp::metric
