// The floor of a terrain: the same outline, with as few triangles as its vertices allow.
#pragma once

#include <cstdint>
#include <span>
#include <vector>

namespace scarp::mesh {

/// Triangulates the region that `triangles` cover seen from above. Omits inner vertices, and border vertices that lie
/// between their neighbours on a line along x or y. c corners and h holes give c + 2h − 2 triangles per part. Triangles
/// are counter-clockwise, like the input. `positions` holds 3 doubles per vertex, of which x and y are used; `twins` is
/// build_twins(triangles). Decisions are exact. Returns the input if any triangle is not counter-clockwise. REQUIRES:
/// each border vertex has one incoming and one outgoing border edge. Cost: O(n log n).
std::vector<std::uint32_t> build_flat_base(std::span<const double> positions, std::vector<std::uint32_t> triangles,
                                           std::vector<std::uint32_t> twins);

}  // namespace scarp::mesh
