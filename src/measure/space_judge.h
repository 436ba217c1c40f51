// Judging in space: the triangle and the point where a sample's vertical meets the mesh.
//
// The mesh is converted to the map, where everything except heights is judged. An error is measured along the vertical
// of a sample (the straight line of all heights there), from the sample to the triangle that the vertical meets. A
// border edge of a mesh is a chord of a curved line of samples, so some verticals there meet no triangle. For such a
// sample, the mesh's height is that of the nearest point of the triangle that covers the sample on the map.
//
// Edges are straight in space and slightly bent on the map, so a triangle may meet verticals of samples outside it on
// the map. The bend at the middle of its edges gives the margin.
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

/// A mesh in space converted to the map: positions in the raster's x, y and heights. A coordinate is snapped to a
/// multiple of 1/256 sample if rounding in the file may have moved it that far. Fails with kInput for a vertex without
/// a position on the map.
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
    Vector sample, up;  ///< relative to the mesh's origin; `up` is a unit vector
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
  /// Judges the triangles `ids` of `mesh`. All arguments must outlive it.
  SpaceJudge(const HeightField& field, const Mesh& mesh, const Mesh& on_map, std::span<const std::uint32_t> ids);

  Verticals verticals(const Band& band) const { return {frame_, mesh_.origin, band}; }
  /// Number of triangles that face down in space but not on the map, or vice versa. On the map, an edge of such a
  /// triangle bends beyond the third corner.
  std::uint64_t folds() const { return folded_.size(); }
  /// For each fold, a sample near the middle of its longest edge, unless that is a corner. If this sample becomes a
  /// vertex, the triangle may unfold.
  std::vector<Offender> unfolding() const;
  /// The largest bend of a triangle's edges on the map, in samples.
  double bend(std::uint32_t id) const { return bends_[id]; }
  /// Offers the errors of the samples whose verticals meet the triangle; `facet` is the triangle on the map.
  void judge_met(const Facet& facet, std::uint32_t id, const Verticals& verticals, Band& band) const;
  /// The error mesh − sample of a sample whose vertical meets no triangle. Uses the point of the triangle's border that
  /// is nearest as seen along the vertical.
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
