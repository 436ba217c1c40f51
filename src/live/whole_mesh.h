// The cells of a field as one mesh.
#pragma once

#include <memory>
#include <span>

#include "live/sample_ring.h"
#include "scarp/live.h"

namespace scarp::live {

/// `cells`: by place, row by row. `side`: samples along a cell. `channels`: of each vertex. `place`: of the field's
/// first sample. Vertices at one place of the lattice of borders become one.
Mesh join_cells(std::span<const std::shared_ptr<const LiveCell>> cells, std::int32_t side, int channels,
                const Area& field, const Frame& frame);

}  // namespace scarp::live
