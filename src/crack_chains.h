// Where a raster steps between neighbours, and how the steps hang together.
//
// A crack lies between two samples side by side, or one below the other, whose heights differ by more than a given
// one. In a cell of four samples with two cracked sides a wall runs in through one and out through the other; so
// cracks hang together in chains, along which all high samples lie on the left (as rasters are looked at, rows
// downwards) and all low ones on the right. A line that crosses the cracks of a chain one after the other, each between
// its samples, tells the two apart.
#pragma once

#include <cstdint>
#include <functional>
#include <vector>

#include "grid/raster.h"

namespace scarp {

struct Crack {
  Point high, low;                ///< samples
  bool is_before_saddle = false;  ///< the cell between it and the next crack of its chain is passed twice
  friend bool operator==(const Crack&, const Crack&) = default;
};

struct CrackChain {
  std::vector<Crack> cracks;  ///< successive ones are two sides of a cell of four heights
  bool is_ring = false;       ///< the last is followed by the first
};

/// All cracks between samples that differ by more than `height`, each in one chain. Chains end where a cell has one
/// crack or three, two that contradict each other, or a void. A cell with four, a saddle, is passed twice: around the
/// two samples that differ more. `is_left_out`: of samples, cracks of which do not count. In raster order of their
/// first cracks, rings last. Cost: O(samples + n log n) for n cracks.
std::vector<CrackChain> find_crack_chains(const Raster& raster, double height,
                                          const std::function<bool(Point)>& is_left_out);

}  // namespace scarp
