// One thread's work on tiles; its memory is kept from tile to tile.
#pragma once

#include <cstddef>
#include <cstdint>
#include <vector>

#include "refine/coarse_start.h"
#include "refine/tile.h"
#include "refine/tile_scanner.h"
#include "scarp/height_field.h"
#include "scarp/result.h"
#include "scarp/strategy.h"
#include "tin/assembly.h"
#include "tin/tile_mesh.h"

namespace scarp {

/// The result of a tile.
struct TileOutcome {
  Result<void> status;
  TilePiece piece;
  std::vector<float> heights;  ///< of the piece's points, where the field has a source
  Work work;
  bool is_unsuited = false;    ///< heights span magnitudes beyond exact arithmetic
  bool is_broken_off = false;  ///< at the most vertices allowed; there is no piece
};

/// Vertices a sample of the plane where `kept` were kept along lines of so many steps.
double expected_density(std::size_t kept, std::int64_t steps);

void add(Work& sum, const Work& work);

class TileWorker {
 public:
  /// Refines one tile until every sample lies within `threshold`; what it did before changes nothing. `density`: of the
  /// whole mesh, as expected; 0 if unknown. `most`: vertices it may have, but for those it begins with.
  TileOutcome refine(const HeightField& field, const TileWindow& window, const SharedSides& shared, double threshold,
                     double density, std::size_t most);

 private:
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
