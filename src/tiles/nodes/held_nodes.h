// Nodes in memory.
#pragma once

#include <cstdint>
#include <span>
#include <vector>

#include "scarp/tile.h"

namespace scarp::tiles {

/// Nodes of the source's land, read once for many tiles; other nodes have no heights.
class HeldNodes final : public NodeSource {
 public:
  /// Reads bands of rows on `threads` threads.
  static Result<HeldNodes> read(const NodeWindow& window, const NodeSource& source, int threads);
  bool has_heights() const;
  /// REQUIRES: like read().
  bool has_heights(const NodeWindow& window) const;
  /// A hash of all heights and their places in the window; 0 without any.
  std::uint64_t hash() const;
  /// REQUIRES: the window lies in the held one, with columns of the same turn.
  Result<void> read(const NodeWindow& window, std::span<float> out) const override;
  NodeWindow land(const NodeWindow& window) const override;
  /// Samples are not held but come from the source, which is borrowed.
  bool has_samples() const override { return source_->has_samples(); }
  Result<void> visit_samples(const DegreeBox& box, const SampleVisitor& visit) const override {
    return source_->visit_samples(box, visit);
  }

 private:
  const NodeSource* source_ = nullptr;
  NodeWindow window_;  ///< the requested nodes
  NodeWindow land_;    ///< the part that is held
  std::vector<float> heights_;
};

}  // namespace scarp::tiles
