// One thread's work on tiles; its memory is kept from tile to tile.
#pragma once

#include <cstddef>
#include <cstdint>
#include <span>
#include <vector>

#include "refine/coarse_start.h"
#include "refine/tile.h"
#include "refine/tile_scanner.h"
#include "scarp/height_field.h"
#include "scarp/result.h"
#include "scarp/run.h"
#include "tin/assembly.h"
#include "tin/tile_mesh.h"

namespace scarp {

/// The result of a tile.
struct TileOutcome {
  Result<void> status;
  TilePiece piece;
  std::vector<float> heights;  ///< heights of the piece's points, where the field has a source
  Work work;
  bool is_unsuited = false;    ///< heights span magnitudes beyond exact arithmetic
  bool is_broken_off = false;  ///< at the most vertices allowed; there is no piece
};

/// Vertices a sample of the plane where `kept` were kept along lines of so many steps.
double expected_density(std::size_t kept, std::int64_t steps);

void add(Work& sum, const Work& work);

class TileWorker {
 public:
  /// Refines one tile until every sample lies within `threshold`; what it did before changes nothing. `density`: the
  /// expected density of the whole mesh; 0 if unknown. `most`: how many vertices may be added.
  TileOutcome refine(const HeightField& field, const TileWindow& window, const SharedSides& shared, double threshold,
                     double density, std::size_t most);

  /// The same of a whole field as one tile, from vertices that it begins with: those on its sides, where no other
  /// comes, and some inside. Unsuited is a field with nodata, too. REQUIRES: its sides are at most kMaxTileSide samples
  /// long; the samples on them break no bound.
  TileOutcome refine_alone(const HeightField& field, std::span<const Point> on_sides, std::span<const Point> inside,
                           double threshold, std::size_t most);

 private:
  bool is_suited() const { return tile_.largest_height() <= kMaxScanHeight; }
  /// From the border and others that the tile begins with; the tile is loaded.
  TileOutcome refine_loaded(const HeightField& field, const TileWindow& window, const SharedSides& shared,
                            double threshold, double density, std::size_t most, std::span<const Point> inside);
  Result<void> find_border(const HeightField& field, const TileWindow& window, const SharedSides& shared,
                           double threshold);

  Tile tile_;
  TileMesh mesh_;
  CoarseStart coarse_;
  PieceMaker pieces_;
  std::vector<TilePoint> border_;
  std::int64_t steps_ = 0;  // along the shared sides
};

}  // namespace scarp
