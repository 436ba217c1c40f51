#include <algorithm>
#include <cmath>
#include <utility>

#include "scarp/tile_job.h"

namespace scarp {
struct GlobeRaster::Impl {
  OwnedHeightField field;
  RasterOnGlobe globe;
  DegreeBox covered;
  std::unique_ptr<NodeSource> samples, raised;
};

GlobeRaster::GlobeRaster(std::unique_ptr<Impl> impl) : impl_(std::move(impl)) {}

GlobeRaster::~GlobeRaster() = default;

Result<std::unique_ptr<GlobeRaster>> GlobeRaster::open(const std::string& path, ReadOptions options,
                                                       const Datum& datum) {
  auto impl = std::make_unique<Impl>();
  options.crs = "source";
  auto field = open_height_field(path, options);
  if (!field) return tl::unexpected(field.error());
  impl->field = std::move(*field);
  const OwnedHeightField& raster = impl->field;
  auto globe = place_on_globe(raster.info, raster.cols, raster.rows, datum, path);
  if (!globe) return tl::unexpected(globe.error());
  impl->globe = std::move(*globe);
  const auto covered = degrees_covered(raster, impl->globe.place.affine, impl->globe.to_degrees.get());
  if (!covered) return tl::unexpected(covered.error());
  impl->covered = *covered;
  auto nodes = make_node_source(raster, impl->globe.place);
  if (!nodes) return tl::unexpected(nodes.error());
  impl->samples = std::move(*nodes);
  if (impl->globe.zero) impl->raised = make_raised_source(*impl->samples, impl->globe.zero);
  return std::unique_ptr<GlobeRaster>(new GlobeRaster(std::move(impl)));
}

const NodeSource& GlobeRaster::nodes() const { return impl_->raised ? *impl_->raised : *impl_->samples; }

SourceFacts GlobeRaster::facts() const {
  const RasterInfo& raster = info();
  const double reserve = impl_->globe.zero_reach;
  const bool are_degrees = impl_->globe.to_degrees == nullptr;
  return {impl_->covered, std::sqrt(raster.cell_x_m * raster.cell_y_m), raster.min - reserve, raster.max + reserve,
          are_degrees ? std::sqrt(raster.cell_x * raster.cell_y) : 0};
}

const RasterInfo& GlobeRaster::info() const { return impl_->field.info; }

const RasterOnGlobe& GlobeRaster::place() const { return impl_->globe; }

}  // namespace scarp
