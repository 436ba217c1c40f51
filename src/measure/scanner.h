// Which triangle lies over which sample: two ways to find out, one for affine frames and one for all.
#pragma once

#include <cstddef>
#include <memory>
#include <vector>

#include "measure/band.h"
#include "measure/plan_triangle.h"
#include "scarp/height_field.h"
#include "scarp/mesh.h"

namespace scarp::judge {

/// The triangles to judge heights on, in some plan coordinates.
struct Facets {
  std::vector<double> x, y;  ///< by vertex
  const Mesh* mesh = nullptr;
  std::vector<std::uint32_t> ids;  ///< of the mesh's triangles, ascending

  /// The triangle `id`, counter-clockwise. Returns false if it has no area seen from above.
  bool get(std::uint32_t id, Facet& facet) const {
    for (std::size_t k = 0; k < 3; ++k) {
      const std::size_t v = mesh->triangles[3 * std::size_t{id} + k];
      facet.plan.x[k] = x[v];
      facet.plan.y[k] = y[v];
      facet.z[k] = mesh->origin[2] + mesh->positions[3 * v + 2];
    }
    return make_counter_clockwise(facet);
  }
};

/// Finds the error of each sample of a band and the nodata cells that are covered. Immutable: bands may be scanned at
/// once.
class Scanner {
 public:
  virtual ~Scanner() = default;
  virtual void scan(Band& band) const = 0;
};

class SpaceJudge;

/// For affine frames: vertices are mapped back to the grid, triangles are scanned row by row. `space`: who says the
/// errors of a mesh in space, which `field` and `mesh` then are on the map; null: there is none.
std::unique_ptr<Scanner> make_grid_scanner(const HeightField& field, const Mesh& mesh, std::vector<std::uint32_t> ids,
                                           double tolerance, const SpaceJudge* space = nullptr);
/// For any frame: samples are mapped to the mesh, where a grid of buckets knows the triangles. About ten times slower.
std::unique_ptr<Scanner> make_frame_scanner(const HeightField& field, const Mesh& mesh, std::vector<std::uint32_t> ids,
                                            double tolerance);

}  // namespace scarp::judge
