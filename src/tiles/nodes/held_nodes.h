// Nodes in memory.
#pragma once

#include <cstdint>
#include <span>
#include <vector>

#include "scarp/tile.h"

namespace scarp {

/// Nodes that were read once for many tiles: those of the source's land, for the others have no heights.
class HeldNodes final : public NodeSource {
 public:
  /// `threads` read bands of rows.
  static Result<HeldNodes> read(const NodeWindow& window, const NodeSource& source, int threads);
  bool has_heights() const;
  /// A hash of all heights and their places in the window; 0 without any.
  std::uint64_t hash() const;
  /// REQUIRES: the window lies in the one that is held, with columns of the same turn.
  Result<void> read(const NodeWindow& window, std::span<float> out) const override;
  NodeWindow land(const NodeWindow& window) const override;
  /// Samples of the source, which is borrowed: they are not held.
  bool has_samples() const override { return source_->has_samples(); }
  Result<void> visit_samples(const DegreeBox& box, const SampleVisitor& visit) const override {
    return source_->visit_samples(box, visit);
  }

 private:
  const NodeSource* source_ = nullptr;
  NodeWindow window_;  ///< the nodes asked for
  NodeWindow land_;    ///< the part of them that is held
  std::vector<float> heights_;
};

}  // namespace scarp
