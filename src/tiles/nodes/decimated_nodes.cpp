#include "tiles/nodes/decimated_nodes.h"

#include <vector>

namespace scarp::tiles {
namespace {

/// If wanted nodes are at most this many steps apart, all nodes are read.
constexpr std::int64_t kReadThrough = 64;

}  // namespace

Result<void> DecimatedNodes::read(const NodeWindow& window, std::span<float> out) const {
  const std::int64_t step = per_turn_ / window.per_turn;
  if (step == 1) return source_.read(window, out);
  std::vector<float> between(step <= kReadThrough ? static_cast<std::size_t>((window.cols - 1) * step + 1) : 0);
  for (int j = 0; j < window.rows; ++j) {
    float* const row = out.data() + std::ptrdiff_t{j} * window.cols;
    NodeWindow fine{per_turn_, window.col * step, (window.row + j) * step, static_cast<int>(between.size()),
                    1,         window.grid};
    if (!between.empty()) {
      SCARP_RETURN_IF_ERROR(source_.read(fine, between));
      for (int i = 0; i < window.cols; ++i) row[i] = between[static_cast<std::size_t>(i * step)];
      continue;
    }
    fine.cols = 1;
    for (int i = 0; i < window.cols; ++i, fine.col += step) {
      SCARP_RETURN_IF_ERROR(source_.read(fine, {row + i, 1}));
    }
  }
  return {};
}

}  // namespace scarp::tiles
