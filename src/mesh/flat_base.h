// The floor under a terrain: the same outline, as few triangles as the outline's own vertices allow.
#pragma once

#include <cstdint>
#include <span>
#include <vector>

namespace scarp {

/// Triangulates the region that `triangles` cover seen from above, with the same border edges and without its inner
/// vertices: n border vertices and h holes make n + 2h − 2 triangles for each part. Counter-clockwise, like the input.
/// `positions` holds 3 doubles a vertex, of which x and y are used; `twins` is build_twins(triangles).
/// Decisions are exact. If any triangle given is not counter-clockwise, the input comes back as it is.
/// Cost: O(n log n).
std::vector<std::uint32_t> build_flat_base(std::span<const double> positions, std::vector<std::uint32_t> triangles,
                                           std::vector<std::uint32_t> twins);

}  // namespace scarp
