// The locked border of a raster: lines along its edges, and a copy of the samples with edge samples moved onto the
// lines.
//
//     edge     o──·──·──o──·──o      o  vertices of the line, which exist before refinement and are never removed
//              │╲       │   ╱ │      ·  samples that get the line's values, so that every triangle fits them and needs
//              │  ╲     │ ╱   │         no vertex there
#pragma once

#include <cstdint>
#include <span>
#include <vector>

#include "base/point.h"
#include "grid/raster.h"
#include "scarp/height_field.h"
#include "scarp/options.h"
#include "scarp/result.h"
#include "tin/triangulation.h"

namespace scarp::pieces {

class LockedBorder {
 public:
  /// `raster`: the field's samples, nodata as NaN. Fails with kUsage where a given line leaves the raster, touches
  /// nodata or breaks a bound. REQUIRES: options.domain.border is locked and has a max error, unless samples have
  /// tolerances.
  static Result<LockedBorder> make(const HeightField& field, const SimplifyOptions& options,
                                   const grid::Raster& raster);

  /// The samples at the lines' vertices, edge by edge; corners twice.
  const std::vector<Point>& vertices() const { return vertices_; }
  /// Fails with kUsage if a point, in steps between samples, lies on a side but is not one of the vertices.
  Result<void> check(std::span<const Point> points, std::int32_t steps) const;
  grid::Raster raster() const { return {samples_.data(), cols_, rows_}; }
  /// `field` with this border's copies of the channels.
  HeightField with_channels(HeightField field) const;

 private:
  struct Edge;

  std::size_t index_of(Point p) const {
    return static_cast<std::size_t>(p.y) * static_cast<std::size_t>(cols_) + static_cast<std::size_t>(p.x);
  }
  Result<void> add(const Edge& edge, const HeightField& field, const SimplifyOptions& options,
                   const grid::Raster& raster);

  std::vector<float> samples_;
  std::vector<std::vector<float>> channels_;
  std::int32_t cols_ = 0, rows_ = 0;
  std::vector<Point> vertices_;
};

/// The vertices on the sides of the rectangle without its corners, sorted. `steps`: lattice steps between two samples.
std::vector<Point> find_side_vertices(const tin::Triangulation& tin, const grid::Raster& raster, std::int32_t steps);

}  // namespace scarp::pieces
