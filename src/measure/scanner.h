// Finds the triangle over each sample, with one algorithm for affine frames and one for any frame.
#pragma once

#include <cstddef>
#include <memory>
#include <optional>
#include <span>

#include "measure/band.h"
#include "measure/grid_places.h"
#include "measure/plan_triangle.h"
#include "scarp/height_field.h"
#include "scarp/mesh.h"

namespace scarp::judge {

/// The triangles by which heights are judged, in plan coordinates.
struct Facets {
  FacetCorners corners;
  const Mesh* mesh = nullptr;

  /// The triangle `id`, counter-clockwise. Returns false if it has no area seen from above.
  bool get(std::uint32_t id, Facet& facet) const {
    for (std::size_t k = 0; k < 3; ++k) {
      const FacetCorner corner = corners[mesh->triangles[3 * std::size_t{id} + k]];
      facet.plan.x[k] = corner.x;
      facet.plan.y[k] = corner.y;
      facet.z[k] = corner.z;
    }
    return make_counter_clockwise(facet);
  }
  /// Prefetches triangle `id`.
  void expect(std::uint32_t id) const {
    for (std::size_t k = 0; k < 3; ++k) corners.expect(mesh->triangles[3 * std::size_t{id} + k]);
  }
};

/// Finds the error of each sample of a band, and the covered nodata cells. Immutable: several bands may be scanned at
/// once.
class Scanner {
 public:
  virtual ~Scanner() = default;
  virtual void scan(Band& band) const = 0;
};

class SpaceJudge;

/// For affine frames: `places` holds the vertices' positions in the grid; triangles are scanned row by row. `ids`:
/// triangles to judge, ascending; none: all; used during construction only. `space`: for a mesh in space, the judge of
/// its errors (`field` and `mesh` are then on the map); null: none. Everything else borrowed must outlive the scanner.
std::unique_ptr<Scanner> make_grid_scanner(const HeightField& field, const Mesh& mesh, GridPlaces places,
                                           std::optional<std::span<const std::uint32_t>> ids, double tolerance,
                                           int threads, const SpaceJudge* space = nullptr);
/// For any frame: samples are mapped to the mesh and located in a bucket grid of triangles. About ten times slower.
std::unique_ptr<Scanner> make_frame_scanner(const HeightField& field, const Mesh& mesh,
                                            std::span<const std::uint32_t> ids, double tolerance);

}  // namespace scarp::judge
