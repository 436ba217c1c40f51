// Bounds of samples where rows of tiles are finished one after the other.
//
//     row above, done ───·──·──·────    what the samples of a shared row of samples need beyond the tiles' max error is
//     row at hand        ╲ ╱ ╲ ╱        a function of that row, of its vertices and its bounds: both rows insert the
//     ───────────────────────────────   same there, and neither adds more. Within, insertion is greedy by error over
//     rows below, not read yet          bound, as where all is in memory.
#pragma once

#include <cstdint>
#include <span>
#include <vector>

#include "metric/source_bounds.h"
#include "pieces/tiled.h"
#include "scarp/result.h"
#include "scarp/strategy.h"

namespace scarp {

class RowBounds {
 public:
  /// The bounds stay alive.
  explicit RowBounds(const SourceBounds& bounds) : bounds_(bounds) {}

  /// Of rows of samples: tiles are of no use there, for no bound holds for all samples.
  bool makes_whole() const { return !bounds_.has_most(); }

  /// Reads the row's. Fails as SourceBounds::read_aims().
  Result<void> load(const TileRow& row);
  /// Those that were read last, by the row's samples.
  std::span<float> aims() { return aims_; }

  /// The row's mesh, in samples, once each of its samples keeps its aim; those on shared rows, whose edges are for good
  /// by then, are given none any more. Vertices on rows that are shared are the same
  /// for both that share them. Fails as load(), with kInput for too many triangles and as row.check does.
  Result<FinishedRow> refine(TileRow row);

  const Work& work() const { return work_; }

 private:
  Result<void> split_shared(TileRow& row, bool is_top);

  const SourceBounds& bounds_;
  std::vector<float> aims_;
  Work work_;
};

/// Those of a row of samples.
inline std::span<float> along(std::span<float> bounds, const TileRow& row, std::int32_t y) {
  const auto cols = static_cast<std::size_t>(row.samples.cols);
  return bounds.subspan(static_cast<std::size_t>(y) * cols, cols);
}

/// Bytes that bounds take for each sample of a row.
inline constexpr std::uint64_t kRowBoundBytesPerSample = sizeof(float);

}  // namespace scarp
