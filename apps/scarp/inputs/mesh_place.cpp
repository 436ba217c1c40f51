#include "inputs/mesh_place.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <utility>

#include "scarp/io.h"
#include "scarp/lines.h"
#include "terminal/text.h"

namespace scarp::cli {

void Extent::add(double x, double y) {
  if (!std::isfinite(x) || !std::isfinite(y)) return;
  low = {std::min(low[0], x), std::min(low[1], y)};
  high = {std::max(high[0], x), std::max(high[1], y)};
}

double Extent::overlap(const Extent& other) const {
  double common = 1, one = 1, two = 1;
  for (std::size_t k = 0; k < 2; ++k) {
    common *= std::max(0.0, std::min(high[k], other.high[k]) - std::max(low[k], other.low[k]));
    one *= high[k] - low[k];
    two *= other.high[k] - other.low[k];
  }
  return common > 0 ? common / (one + two - common) : 0;
}

std::string Extent::text() const {
  return fmt::format("x {:.10g} to {:.10g} and y {:.10g} to {:.10g}", low[0], high[0], low[1], high[1]);
}

Extent extent_of(const Mesh& mesh) {
  Extent extent;
  for (std::size_t v = 0; v < mesh.vertex_count(); ++v) {
    const auto at = mesh.vertex(v);
    extent.add(at[0], at[1]);
  }
  return extent;
}

Extent extent_of(const HeightField& field) {
  constexpr int kSteps = 16;  // along a side: other CRSs bend it
  std::vector<double> x, y;
  for (int k = 0; k <= kSteps; ++k) {
    const double col = (field.cols - 1.0) * k / kSteps, row = (field.rows - 1.0) * k / kSteps;
    for (const auto& [c, r] : {std::pair{col, 0.0}, {col, field.rows - 1.0}, {0.0, row}, {field.cols - 1.0, row}}) {
      const auto at = field.frame.apply_affine(c, r);
      x.push_back(at[0]);
      y.push_back(at[1]);
    }
  }
  if (field.frame.transform) field.frame.transform->apply(x, y);
  std::vector<double> z(x.size());
  if (field.frame.space) field.frame.space->to_space(x, y, z);
  Extent extent;
  for (std::size_t k = 0; k < x.size(); ++k) extent.add(x[k], y[k]);
  return extent;
}

Extent extent_of(const PointSet& points) {
  Extent extent;
  for (std::size_t k = 0; k < points.size(); ++k) extent.add(points.x[k], points.y[k]);
  return extent;
}

void fit_frame(const Mesh& mesh, OwnedHeightField& field) {
  if (field.frame.kind != Frame::Kind::kLocal) return;
  HeightField source = field.view();
  source.frame.kind = field.info.has_georeference ? Frame::Kind::kSource : Frame::Kind::kGrid;
  source.frame.affine = map_affine(field.info, field.rows);
  source.frame.crs = field.info.crs;
  source.frame.description = "the raster's own coordinates, where the mesh lies";
  const Extent of_mesh = extent_of(mesh);
  if (of_mesh.overlap(extent_of(source)) > of_mesh.overlap(extent_of(field.view()))) field.frame = source.frame;
}

std::string describe_elsewhere(const Extent& mesh, const Extent& reference, const std::string& what) {
  return fmt::format(
      "it covers no sample of {}: its vertices lie at {}, the samples at {}; give the CRS it was made in "
      "(--crs), or its own raster",
      what, mesh.text(), reference.text());
}

}  // namespace scarp::cli
