// Uses the octree of a COPC file (COPC specification 1.0, copc.io) to find the chunks outside a rectangle.
#pragma once

#include <array>
#include <cstdint>
#include <unordered_set>

#include "las/bytes.h"
#include "las/header.h"

namespace scarp::las {

/// xmin, ymin, xmax, ymax, inclusive.
using Extent = std::array<double, 4>;

/// The offsets of chunks outside the extent. Empty for other files, and if the octree cannot be read; points are then
/// selected one by one.
std::unordered_set<std::uint64_t> find_chunks_outside(const Source& source, const Header& header, const Extent& extent);

}  // namespace scarp::las
