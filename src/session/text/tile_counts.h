#pragma once

#include <cstdint>

namespace scarp::cli {

/// The tiles made so far.
struct TileCounts {
  std::uint64_t tiles = 0, bytes = 0;
};

}  // namespace scarp::cli
