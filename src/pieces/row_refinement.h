// Greedy refinement of a row of tiles as one mesh.
#pragma once

#include <cstdint>

#include "pieces/tiled.h"
#include "refine/refinement.h"
#include "scarp/result.h"
#include "scarp/strategy.h"

namespace scarp {

/// Makes the mesh of a row its domain, with no vertices but the outline's; outside where no cell is surface. Edges
/// along shared borders are free: whether the domain ends there the other row decides, too.
Result<void> start_row(TileRow& row);

/// Inserts the samples that break their bounds, worst first, and adds to `work`. Fails with kInput for too many
/// triangles and as row.check does. REQUIRES: `refinement` is of row.tin.
Result<void> refine_row(const TileRow& row, Refinement& refinement, Work& work);

/// Bytes a vertex of a row that laying lines and refining take, its mesh included.
inline constexpr std::uint64_t kRowRefinementBytesPerVertex = 160;

}  // namespace scarp
