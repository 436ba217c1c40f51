// Nodes on a coarser lattice.
#pragma once

#include <cstdint>

#include "scarp/tile.h"

namespace scarp::tiles {

/// Coarser lattices of a source that is read on its finest one. Each height is the source's at that place.
class DecimatedNodes final : public NodeSource {
 public:
  /// `per_turn`: steps of the finest lattice around the globe. Borrows the source.
  DecimatedNodes(const NodeSource& source, std::int64_t per_turn) : source_(source), per_turn_(per_turn) {}

  /// REQUIRES: window.per_turn divides the finest lattice's.
  Result<void> read(const NodeWindow& window, std::span<float> out) const override;

 private:
  const NodeSource& source_;
  std::int64_t per_turn_;
};

}  // namespace scarp::tiles
