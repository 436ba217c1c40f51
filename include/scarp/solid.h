// From a terrain to a printable solid: closed, and placed in millimetres.
#pragma once

#include <array>
#include <cstdint>
#include <string>

#include "scarp/mesh.h"
#include "scarp/result.h"

#pragma GCC visibility push(default)

namespace scarp {

/// Placement of a solid: position = (position in the frame of the raster − origin) · scale. Scales are above 0.
struct Placement {
  std::array<double, 3> origin{0, 0, 0};
  std::array<double, 3> scale{1, 1, 1};
};

/// Places the mesh: origin becomes 0, positions are rounded to float32, metadata["placement"] holds the numbers.
/// Normals are dropped. STL, and every format with metadata, stores the numbers.
void place_mesh(Mesh& mesh, const Placement& placement);

/// The inverse, by metadata["placement"]: maps the rounded positions back to the raster's frame. Returns false, and
/// does not change the mesh, if it was not placed.
bool undo_placement(Mesh& mesh);

/// Closes a terrain into a solid as add_base() does, for readers that identify vertices by float32 positions. Positions
/// are rounded to float32 offsets. Where parts of the terrain meet in a single point, all but the first move back from
/// it by a few units in the last place. Attributes and normals are dropped.
/// Fails with kUsage if the base is not below the lowest vertex (names its height), with kPromise if the result is no
/// closed 2-manifold: rounding has merged vertices, and the mesh is too fine for its size.
/// REQUIRES: as add_base(). Cost: O(n log n).
Result<Mesh> build_solid(Mesh terrain, double base);

/// Facts for a reader that rounds positions to float32 and merges vertices at the same position, as STL readers do.
struct SolidFacts {
  std::uint64_t triangles = 0;
  std::uint64_t degenerate = 0;    ///< triangles without area
  std::uint64_t faulty_edges = 0;  ///< edges without exactly two triangles that run along them in opposite directions
  std::uint64_t pinched_vertices = 0;  ///< vertices with more than one fan of triangles
  std::uint64_t parts = 0;             ///< parts not connected by edges
  std::uint64_t inside_out = 0;        ///< parts whose volume is not positive
  double volume = 0;
  std::array<double, 3> low{}, high{};  ///< box of all vertices, the mesh's origin included

  /// Closed, each edge and each vertex as on a surface, facing outward.
  bool is_solid() const {
    return triangles > 0 && degenerate == 0 && faulty_edges == 0 && pinched_vertices == 0 && inside_out == 0;
  }
  /// "2 degenerate triangles, 4 faulty edges"; empty if it is a solid.
  std::string list_faults() const;
};
/// Exact but for volume and size. Cost: O(n log n).
SolidFacts measure_solid(const Mesh& mesh);

}  // namespace scarp

#pragma GCC visibility pop
