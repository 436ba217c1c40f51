// The samples of a field that moves: heights, tolerances and channels, one layer each.
#pragma once

#include <cstddef>
#include <cstdint>
#include <vector>

#include "live/sample_ring.h"
#include "scarp/height_field.h"
#include "scarp/result.h"

namespace scarp::live {

/// Samples of an area, by layer and row by row; an empty layer is not part of the patch.
struct Patch {
  Area area;
  std::vector<std::vector<float>> layers;
};

class FieldSamples {
 public:
  static constexpr std::size_t kHeights = 0;

  FieldSamples(const Area& area, bool has_tolerances, std::size_t channels);

  const Area& area() const { return area_; }
  std::size_t layer_count() const { return rings_.size(); }
  bool has_tolerances() const { return has_tolerances_; }
  std::size_t tolerances() const { return 1; }
  std::size_t channel(std::size_t k) const { return (has_tolerances_ ? 2 : 1) + k; }
  std::size_t channel_count() const { return layer_count() - channel(0); }

  /// The samples of an area. Those outside the field are voids without a tolerance, with channels of 0.
  Patch read(const Area& area) const;
  /// The area of the samples that a patch changes, and of the neighbours of samples that become valid or void.
  Area find_changes(const Patch& patch) const;
  /// Fails with kInput if a height of the patch lacks a channel.
  Result<void> check(const Patch& patch) const;
  /// The patch then holds the field's earlier samples.
  void swap(Patch& patch);

  /// Moves the field to another area of its size, and returns the samples that are no longer in it.
  std::vector<Patch> move(const Area& to);
  void move_back(const Area& to, const std::vector<Patch>& left);

 private:
  void write(const Patch& patch);

  Area area_;
  bool has_tolerances_;
  std::vector<SampleRing> rings_;
};

}  // namespace scarp::live
