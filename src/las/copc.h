// The octree of a COPC file: which chunks may hold points of a rectangle (COPC specification 1.0, copc.io).
#pragma once

#include <array>
#include <cstdint>
#include <unordered_set>

#include "las/bytes.h"
#include "las/header.h"

namespace scarp::las {

/// xmin, ymin, xmax, ymax, the ends included.
using Extent = std::array<double, 4>;

/// The offsets of chunks that lie outside. Empty for other files, and if the octree cannot be read: the points are
/// then chosen one by one.
std::unordered_set<std::uint64_t> find_chunks_outside(const Source& source, const Header& header, const Extent& extent);

}  // namespace scarp::las
