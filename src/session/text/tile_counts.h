#pragma once

#include <cstdint>

namespace scarp::cli {

/// What a command that makes tiles has made so far.
struct TileCounts {
  std::uint64_t tiles = 0, bytes = 0;
};

}  // namespace scarp::cli
