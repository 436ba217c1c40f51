// The work of one thread on tiles, which reuses its memory from tile to tile.
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

namespace scarp::pieces {

/// The result of a tile.
struct TileOutcome {
  Result<void> status;
  tin::TilePiece piece;
  std::vector<float> heights;  ///< heights of the piece's points, if the field has a source
  Work work;
  bool is_unsuited = false;    ///< magnitudes of heights differ too much for exact arithmetic
  bool is_broken_off = false;  ///< reached the vertex limit; there is no piece
};

/// Expected number of vertices per sample of the plane, if lines of `steps` steps kept `kept` vertices.
double expected_density(std::size_t kept, std::int64_t steps);

void add(Work& sum, const Work& work);

class TileWorker {
 public:
  /// Refines one tile until every sample lies within `threshold`; independent of earlier tiles. `density`: the expected
  /// density of the whole mesh; 0 if unknown. `most`: limit of added vertices.
  TileOutcome refine(const HeightField& field, const refine::TileWindow& window, const refine::SharedSides& shared,
                     double threshold, double density, std::size_t most);

  /// Refines a whole field as one tile that starts with the given vertices; no other vertices are added on its sides. A
  /// field with nodata is also unsuited. REQUIRES: sides of at most kMaxTileSide samples, whose samples break no bound.
  TileOutcome refine_alone(const HeightField& field, std::span<const Point> on_sides, std::span<const Point> inside,
                           double threshold, std::size_t most);

 private:
  bool is_suited() const { return tile_.largest_height() <= geom::kMaxScanHeight; }
  /// Starts from the border and the vertices inside. REQUIRES: the tile is loaded.
  TileOutcome refine_loaded(const HeightField& field, const refine::TileWindow& window,
                            const refine::SharedSides& shared, double threshold, double density, std::size_t most,
                            std::span<const Point> inside);
  Result<void> find_border(const HeightField& field, const refine::TileWindow& window,
                           const refine::SharedSides& shared, double threshold);

  refine::Tile tile_;
  tin::TileMesh mesh_;
  refine::CoarseStart coarse_;
  tin::PieceMaker pieces_;
  std::vector<geom::TilePoint> border_;
  std::int64_t steps_ = 0;  // along the shared sides
};

}  // namespace scarp::pieces
