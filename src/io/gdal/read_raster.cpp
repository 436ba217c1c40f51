// One raster, from its name to samples in a frame.
#include <fmt/format.h>

#include <algorithm>
#include <string_view>

#include "io/gdal/georeference.h"
#include "io/gdal/open.h"
#include "io/gdal/read_samples.h"
#include "io/raster_finish.h"
#include "io/raster_source.h"

namespace scarp {
namespace gdal {
namespace {

/// A raster that is open and understood, its samples not yet read.
struct Plan {
  Dataset dataset;
  Georeference georeference;
  BandPlan band;
  RasterInfo info;
};

bool is_foot(const std::string& unit) {
  return unit == "ft" || unit.find("foot") != std::string::npos || unit.find("feet") != std::string::npos;
}

/// x and y in one unit, z in another: the promise holds, the shape does not.
void warn_of_units(const Frame& frame, const Georeference& geo, RasterInfo& info) {
  if (frame.kind == Frame::Kind::kGrid || info.unit.empty()) return;
  const bool feet_up = is_foot(info.unit);
  const bool feet_across = frame.kind == Frame::Kind::kSource && !geo.geographic && is_foot(geo.unit_name);
  if (feet_up == feet_across) return;
  info.warnings.push_back(fmt::format("z is in {} but x and y are in {}: scale the heights first if the shape matters",
                                      info.unit, feet_across ? geo.unit_name : "metres"));
}

Result<Plan> plan_raster(Session& session, const std::string& path, const ReadOptions& options) {
  auto dataset = open_raster(session, path);
  if (!dataset) return tl::unexpected(dataset.error());
  Plan plan;
  plan.dataset = std::move(*dataset);
  plan.info.path = path;
  plan.info.format = GDALGetDriverShortName(GDALGetDatasetDriver(plan.dataset.get()));
  if (options.decode == Decode::kNone) {
    auto band = plan_band(plan.dataset.get(), path, options, plan.info);
    if (!band) return tl::unexpected(band.error());
    plan.band = *band;
    warn_of_colours(plan.dataset.get(), plan.band, plan.info);
  } else {
    if (auto packed = verify_packed(plan.dataset.get(), path); !packed) return tl::unexpected(packed.error());
    plan.info.sample_type = options.decode == Decode::kTerrarium ? "Byte (terrarium)" : "Byte (mapbox)";
    plan.info.nodata = options.nodata;
    plan.info.unit.assign(1, 'm');
  }
  auto geo = read_georeference(plan.dataset.get(), path);
  if (!geo) return tl::unexpected(geo.error());
  describe_georeference(*geo, plan.info);
  if (!geo->located && GDALGetGCPCount(plan.dataset.get()) > 0) {
    plan.info.warnings.push_back(
        "the raster is placed by ground control points, which are not used: rectify it first (gdalwarp)");
  }
  plan.georeference = std::move(*geo);
  return plan;
}

void add_gdal_warnings(const Session& session, RasterInfo& info) {
  for (const std::string& warning : session.warnings()) info.warnings.push_back("GDAL: " + warning);
}

Result<OwnedHeightField> read(const std::string& path, const ReadOptions& options) {
  Session session(is_remote(path));
  auto plan = plan_raster(session, path, options);
  if (!plan) return tl::unexpected(plan.error());
  const Georeference& geo = plan->georeference;
  if (auto fits =
          check_raster_size(path, static_cast<std::uint64_t>(geo.cols), static_cast<std::uint64_t>(geo.rows), options);
      !fits) {
    return tl::unexpected(fits.error());
  }
  auto frame = choose_frame(geo, options.crs, plan->info);
  if (!frame) return tl::unexpected(frame.error());
  warn_of_units(*frame, geo, plan->info);

  OwnedHeightField field;
  field.cols = geo.cols;
  field.rows = geo.rows;
  field.frame = std::move(*frame);
  field.info = std::move(plan->info);
  if (auto allocated = allocate_samples(path, field); !allocated) return tl::unexpected(allocated.error());
  std::uint64_t infinities = 0;
  auto samples = options.decode == Decode::kNone ? read_band(session, plan->band, options, field, infinities)
                                                 : read_packed(session, plan->dataset.get(), options, field);
  if (!samples) return tl::unexpected(samples.error());
  add_gdal_warnings(session, field.info);
  if (auto finished = finish_raster(field, infinities); !finished) return tl::unexpected(finished.error());
  return field;
}

}  // namespace
}  // namespace gdal

Result<OwnedHeightField> read_gdal_raster(const std::string& path, const ReadOptions& options) {
  return gdal::read(path, options);
}

}  // namespace scarp
