// Judging in space: which triangle a sample's vertical meets, and where.
//
// The mesh is brought back to the map, where everything but heights is judged. An error is the way along the vertical
// of a sample, the straight line of all heights there, from the sample to the triangle that it meets. The border of a
// mesh is a chord of a curved line of samples, so some verticals there meet no triangle: then the nearest point of the
// triangle that covers the sample on the map decides how high the mesh is.
//
// Edges are straight in space and slightly bent on the map, so a triangle may be met by samples that lie outside it
// there. The middle of its edges shows how far.
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

/// A mesh in space as seen on the map: positions in the raster's x, y and heights. A coordinate that comes as near to a
/// 256th of a sample as rounding in the file may have moved it is put onto it. kInput for a vertex that has no place on
/// the map.
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
  /// Judges the triangles `ids` of `mesh`. All outlive this.
  SpaceJudge(const HeightField& field, const Mesh& mesh, const Mesh& on_map, std::span<const std::uint32_t> ids);

  Verticals verticals(const Band& band) const { return {frame_, mesh_.origin, band}; }
  /// Triangles that face down in space though not on the map, or the other way round: an edge bends on the map by more
  /// than the third corner is away from it.
  std::uint64_t folds() const { return folded_.size(); }
  /// A sample near the middle of the longest edge of each, where that is no corner: as a vertex it may unfold it.
  std::vector<Offender> unfolding() const;
  /// By how many samples a triangle's edges bend on the map, at most.
  double bend(std::uint32_t id) const { return bends_[id]; }
  /// Offers the errors of the samples whose verticals meet the triangle, which `facet` is on the map.
  void judge_met(const Facet& facet, std::uint32_t id, const Verticals& verticals, Band& band) const;
  /// mesh − sample of a sample whose vertical meets no triangle: at the point of the triangle's border that is nearest,
  /// seen along the vertical.
  double error_beside(std::uint32_t id, int col, int row, const Verticals& verticals) const;

 private:
  using Vector = Verticals::Vector;
  struct Corners {
    std::array<Vector, 3> at;
  };
  Corners corners(std::uint32_t id) const;
  void find_bends(std::span<const std::uint32_t> ids);
  void find_folds(std::span<const std::uint32_t> ids);

  const HeightField& field_;
  const Frame& frame_;
  const Mesh& mesh_;
  const Mesh& on_map_;
  std::vector<float> bends_;  // by triangle
  std::vector<std::uint32_t> folded_;
};

}  // namespace scarp::judge
