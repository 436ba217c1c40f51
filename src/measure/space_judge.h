// Judging in space: which triangle a sample's vertical meets, and where.
//
// The mesh is brought back to the map, where everything but heights is judged. An error is the way along the vertical
// of a sample, the straight line of all heights there, from the sample to the plane of a triangle. The triangle is the
// one that the vertical meets; where it meets none, because the mesh's border is a chord of a curved line of samples,
// the one that covers the sample on the map.
//
// Edges are straight in space and slightly bent on the map, so a triangle may be met by samples that lie beside it
// there. How far is told by the middle of its edges.
#pragma once

#include <array>
#include <cstdint>
#include <span>
#include <vector>

#include "measure/band.h"
#include "measure/plan_triangle.h"
#include "scarp/height_field.h"
#include "scarp/mesh.h"
#include "scarp/result.h"

namespace scarp::judge {

/// A mesh in space as seen on the map: positions in the raster's x, y and heights. What comes as near to a 256th of a
/// sample as rounding in the file may have moved it is put onto it. kInput for a vertex that has no place on the map.
Result<Mesh> bring_to_map(const HeightField& field, const Mesh& mesh);

/// The field without its frame in space.
HeightField on_map(const HeightField& field);

/// The mesh seen along the vertical of the raster's centre.
Mesh seen_from_above(const HeightField& field, const Mesh& mesh);

/// The verticals of a band's samples.
class Verticals {
 public:
  using Vector = std::array<double, 3>;

  Verticals(const Frame& frame, const Vector& origin, const Band& band);

  struct Line {
    Vector sample, up;  ///< relative to the mesh's origin; `up` is of unit length
  };
  const Line& at(int col, int row) const {
    return lines_[static_cast<std::size_t>(row - first_) * cols_ + static_cast<std::size_t>(col)];
  }

 private:
  int first_;
  std::size_t cols_;
  std::vector<Line> lines_;
};

class SpaceJudge {
 public:
  /// Of the triangles `ids` of `mesh`. All outlive this.
  SpaceJudge(const HeightField& field, const Mesh& mesh, const Mesh& on_map, std::span<const std::uint32_t> ids);

  Verticals verticals(const Band& band) const { return {frame_, mesh_.origin, band}; }
  /// By how many samples a triangle's edges bend on the map, at most.
  double bend(std::uint32_t id) const { return bends_[id]; }
  /// Offers the errors of the samples whose verticals meet the triangle, which `facet` is on the map.
  void judge_met(const Facet& facet, std::uint32_t id, const Verticals& verticals, Band& band) const;
  /// mesh − sample, on the triangle's plane; along a triangle thinner than `tolerance` on the map at the nearest point
  /// of it.
  double error_beside(const Facet& facet, std::uint32_t id, int col, int row, double tolerance,
                      const Verticals& verticals) const;

 private:
  using Vector = Verticals::Vector;
  struct Corners {
    std::array<Vector, 3> at;
  };
  Corners corners(std::uint32_t id) const;

  const Frame& frame_;
  const Mesh& mesh_;
  std::vector<float> bends_;  // by triangle
};

}  // namespace scarp::judge
