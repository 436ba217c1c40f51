#include "inputs.h"

#include <cmath>
#include <limits>

#include "door.h"

namespace scarp::door {
namespace {

LentRaster raster_of(const scarp_field& field) {
  LentRaster raster;
  raster.samples = field.samples;
  raster.cols = field.cols;
  raster.rows = field.rows;
  if (!std::isnan(field.nodata)) raster.nodata = static_cast<float>(field.nodata);
  if (field.frame != SCARP_FRAME_GRID) raster.geotransform.emplace(std::to_array(field.geotransform));
  if (field.crs != nullptr) raster.crs = field.crs;
  raster.is_geographic = field.frame == SCARP_FRAME_DEGREES;
  raster.sample_rounding = field.sample_rounding;
  return raster;
}

/// Values on the grid of the field.
LentRaster beside(const LentRaster& raster, const float* values) {
  LentRaster other = raster;
  other.samples = values;
  other.nodata.reset();
  other.sample_rounding = 0;
  return other;
}

}  // namespace

LentInputs::LentInputs(const scarp_field* given, const scarp_options& asked) {
  const scarp_field field = known(given, scarp_field_init);
  name_ = field.name != nullptr && *field.name != '\0' ? field.name : "heights";
  if (given == nullptr) missing_ = "the field";
  if (given != nullptr && field.samples == nullptr) missing_ = "the pointer to the samples";
  raster_ = raster_of(field);
  lent_.emplace(name_, raster_);
  if (asked.mask != nullptr) {
    mask_ = beside(raster_, asked.mask);
    lent_mask_.emplace("mask", mask_);
  }
  if (asked.tolerance != nullptr) {
    tolerance_ = beside(raster_, asked.tolerance);
    lent_tolerance_.emplace("tolerance", tolerance_);
  }
}

LentInputs::LentInputs(const scarp_points* given) {
  const scarp_points points = known(given, scarp_points_init);
  name_ = points.name != nullptr && *points.name != '\0' ? points.name : "points";
  if (given == nullptr) missing_ = "the points";
  if (given != nullptr && (points.x == nullptr || points.y == nullptr || points.z == nullptr))
    missing_ = "a pointer to the coordinates";
  points_.path = name_;
  points_.format = "memory";
  if (points.crs != nullptr) points_.crs = points.crs;
  points_.description = points_.crs.empty() ? "coordinates as given" : "coordinates in " + points_.crs;
  const std::size_t stride = points.stride == 0 ? 1 : points.stride;
  if (missing_ == nullptr) {
    for (std::size_t k = 0; k < points.count; ++k) {
      points_.x.push_back(points.x[k * stride]);
      points_.y.push_back(points.y[k * stride]);
      points_.z.push_back(points.z[k * stride]);
    }
  }
  lent_.emplace(name_, points_);
}

Result<void> LentInputs::check() const {
  if (missing_ != nullptr) return fail(ErrorKind::kUsage, std::string(missing_) + " is null");
  if (!(raster_.sample_rounding >= 0) || std::isinf(raster_.sample_rounding))
    return fail(ErrorKind::kUsage, "the field's sample_rounding must be a finite number of at least 0");
  return {};
}

}  // namespace scarp::door

extern "C" double scarp_round_samples(const double* values, uint64_t count, float* samples) {
  double largest = 0;
  for (uint64_t k = 0; k < count; ++k) {
    samples[k] = static_cast<float>(values[k]);
    const double rounding = std::abs(values[k] - static_cast<double>(samples[k]));  // no number where one is infinite
    if (rounding > largest && rounding <= std::numeric_limits<double>::max()) largest = rounding;
  }
  return largest;
}
