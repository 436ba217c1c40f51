// The floor under a terrain: the same outline, as few triangles as the outline's own vertices allow.
#pragma once

#include <cstdint>
#include <span>
#include <vector>

namespace scarp {

/// Triangulates the region that `triangles` cover seen from above without its inner vertices, and without those of its
/// border that lie between their neighbours on a line along x or y: c corners and h holes make c + 2h − 2 triangles
/// for each part. Counter-clockwise, like the input.
/// `positions` holds 3 doubles a vertex, of which x and y are used; `twins` is build_twins(triangles).
/// Decisions are exact. If any triangle given is not counter-clockwise, the input comes back as it is.
/// REQUIRES: each border vertex has one border edge in and one out.
/// Cost: O(n log n).
std::vector<std::uint32_t> build_flat_base(std::span<const double> positions, std::vector<std::uint32_t> triangles,
                                           std::vector<std::uint32_t> twins);

}  // namespace scarp
