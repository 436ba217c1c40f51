// Additions to a mesh for hydraulic models: materials by polygon, and strings of nodes.
#pragma once

#include <array>
#include <cstdint>
#include <vector>

#include "scarp/io.h"
#include "scarp/lines.h"
#include "scarp/mesh.h"

#pragma GCC visibility push(default)

namespace scarp::run {

/// A polygon and the number of its material, for example a roughness or a soil.
struct Zone {
  std::vector<Line> rings;  ///< in map coordinates, the outer one first, then its holes
  std::uint32_t material = 1;
};

/// The material of each triangle: that of the first zone that holds its centre, else `elsewhere`. If the rings are
/// breaklines of the mesh, no triangle is on both sides of a ring. `to_map`: from the mesh's x and y to the coordinates
/// of the rings, like Frame::affine. Cost: O(triangles + those in the zones' boxes × vertices of their rings).
std::vector<std::uint32_t> find_materials(const Mesh& mesh, const std::vector<Zone>& zones,
                                          const std::array<double, 6>& to_map, std::uint32_t elsewhere = 1);

/// The vertices along each line, joined by edges of the mesh, in the order of the line. If the lines are breaklines of
/// the mesh, a string covers all of its line within the surface; a line with parts outside the surface becomes a string
/// for each part inside. `reach`: largest distance of vertices from the line, in its units: a hundredth of a sample.
/// Cost: O(n log n).
std::vector<NodeString> find_node_strings(const Mesh& mesh, const std::vector<Line>& lines,
                                          const std::array<double, 6>& to_map, double reach);

}  // namespace scarp::run

#pragma GCC visibility pop
