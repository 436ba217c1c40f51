// The cells of a field as one mesh.
#pragma once

#include <memory>
#include <span>

#include "live/sample_ring.h"
#include "scarp/live.h"

namespace scarp::live {

/// `cells`: by place, row by row. `side`: sample steps along a cell. `channels`: number of channels per vertex.
/// `place`: place of the field's first sample. Vertices at the same place on a border of cells become one.
Mesh join_cells(std::span<const std::shared_ptr<const LiveCell>> cells, std::int32_t side, int channels,
                const Area& field, const Frame& frame);

}  // namespace scarp::live
