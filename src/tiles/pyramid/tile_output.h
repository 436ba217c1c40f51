// Counts tiles on their way to a sink.
#pragma once

#include <cstddef>
#include <cstdint>
#include <functional>
#include <optional>
#include <vector>

#include "base/reporter.h"
#include "scarp/tile.h"

namespace scarp::tiles {

/// Adds a report on other tiles of the same pyramid.
void add_report(PyramidReport& report, const PyramidReport& more);

class TileOutput {
 public:
  TileOutput(const PyramidPlan& plan, TileSink& sink, const Run& run);

  /// Makes the tiles on all threads and passes them to the sink in the given order; `make` returns nothing for an
  /// unwanted tile. Progress: the fraction of these tiles. Fails like `make` and the sink, and with kCancelled.
  Result<void> make(const std::vector<TileId>& tiles,
                    const std::function<Result<std::optional<KeptTile>>(TileId, const TileEncoder&)>& make);

  /// The report with its tiles sorted.
  PyramidReport take_report();

 private:
  Result<void> put(const KeptTile& kept);

  const PyramidPlan& plan_;
  TileSink& sink_;
  const Run& run_;
  Reporter reporter_;
  std::uint64_t tiles_ = 0;
  PyramidReport report_;
};

}  // namespace scarp::tiles
