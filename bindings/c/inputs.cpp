#include "inputs.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <limits>

#include "door.h"
#include "mesh.h"
#include "settings.h"

namespace scarp::door {
namespace {

io::LentRaster raster_of(const scarp_field& field) {
  io::LentRaster raster;
  raster.samples = field.samples;
  raster.cols = field.cols;
  raster.rows = field.rows;
  if (!std::isnan(field.nodata)) raster.nodata = static_cast<float>(field.nodata);
  if (field.frame != SCARP_FRAME_GRID) raster.geotransform.emplace(std::to_array(field.geotransform));
  if (field.crs != nullptr) raster.crs = field.crs;
  if (field.unit != nullptr) raster.unit = field.unit;
  raster.is_geographic = field.frame == SCARP_FRAME_DEGREES;
  raster.sample_rounding = field.sample_rounding;
  return raster;
}

constexpr std::uint64_t kLargestArray = std::numeric_limits<std::ptrdiff_t>::max();  // bytes

/// The reason why the struct's contents are invalid; empty if valid.
std::string find_fault(const scarp_field& field) {
  if (field.samples == nullptr) return "the pointer to the samples is null";
  if (field.frame < SCARP_FRAME_GRID || field.frame > SCARP_FRAME_DEGREES)
    return fmt::format(
        "the field's frame is {}: it is SCARP_FRAME_GRID (0), SCARP_FRAME_SOURCE (1) or "
        "SCARP_FRAME_DEGREES (2)",
        field.frame);
  if (!(field.sample_rounding >= 0) || std::isinf(field.sample_rounding))
    return "the field's sample_rounding must be a finite number of at least 0";
  const auto cols = static_cast<std::uint64_t>(std::max(field.cols, 0)),
             rows = static_cast<std::uint64_t>(std::max(field.rows, 0));
  if (cols * rows > kLargestArray / sizeof(float))
    return fmt::format("the field has {} x {} samples: no array is so large", field.cols, field.rows);
  return "";
}

std::string find_fault(const scarp_points& points) {
  if (points.x == nullptr || points.y == nullptr || points.z == nullptr) return "a pointer to the coordinates is null";
  if (points.frame < SCARP_FRAME_GRID || points.frame > SCARP_FRAME_DEGREES)
    return fmt::format("the points' frame is {}: it is 0, or SCARP_FRAME_DEGREES (2)", points.frame);
  if (points.stride == 0)
    return "the points' stride is 0: it is 1 for arrays of x, of y and of z, and 3 for points in turn";
  if (points.count > kMostVertices)
    return fmt::format("the points' count is {}: at most {} are possible", points.count, kMostVertices);
  if (points.count > 1 && points.stride > kLargestArray / sizeof(double) / points.count)
    return fmt::format("the points' stride is {}: no array is so large", points.stride);
  return "";
}

/// The reason why the bounds of points are invalid; empty if valid.
std::string find_fault(const float* tolerance, std::uint64_t count) {
  for (std::uint64_t k = 0; k < count; ++k) {
    if (!(tolerance[k] >= 0))
      return fmt::format("tolerance[{}] is {}: it must be at least 0, and infinity is no bound", k, tolerance[k]);
  }
  return "";
}

/// A raster of other values on the grid of `raster`.
io::LentRaster beside(const io::LentRaster& raster, const float* values) {
  io::LentRaster other = raster;
  other.samples = values;
  other.nodata.reset();
  other.sample_rounding = 0;
  return other;
}

}  // namespace

LentInputs::LentInputs(const scarp_field* given, const scarp_options& asked) {
  const scarp_field field = known(given, scarp_field_init);
  name_ = field.name != nullptr && *field.name != '\0' ? field.name : "heights";
  unfit_ = given == nullptr ? "the field is null" : find_fault(field);
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

LentInputs::LentInputs(const scarp_points* given, const scarp_options& asked) {
  const scarp_points points = known(given, scarp_points_init);
  name_ = points.name != nullptr && *points.name != '\0' ? points.name : "points";
  unfit_ = given == nullptr ? "the points are null" : find_fault(points);
  const bool has_bounds = asked.tolerance != nullptr && !has_setting(asked, "--tolerance");
  if (unfit_.empty() && has_bounds) unfit_ = find_fault(asked.tolerance, points.count);
  points_.path = name_;
  points_.format = "memory";
  if (points.crs != nullptr) points_.crs = points.crs;
  points_.is_geographic = points.frame == SCARP_FRAME_DEGREES;
  for (std::size_t k = 0; unfit_.empty() && k < points.count; ++k) {
    points_.x.push_back(points.x[k * points.stride]);
    points_.y.push_back(points.y[k * points.stride]);
    points_.z.push_back(points.z[k * points.stride]);
  }
  if (unfit_.empty() && has_bounds) points_.tolerances.assign(asked.tolerance, asked.tolerance + points.count);
  lent_.emplace(name_, points_);
}

Result<void> LentInputs::check() const {
  if (!unfit_.empty()) return fail(ErrorKind::kUsage, unfit_);
  return {};
}

}  // namespace scarp::door

extern "C" double scarp_round_samples(const double* values, uint64_t count, float* samples) {
  double largest = 0;
  for (uint64_t k = 0; k < count; ++k) {
    samples[k] = static_cast<float>(values[k]);
    const double rounding = std::abs(values[k] - static_cast<double>(samples[k]));  // NaN if one is infinite
    if (rounding > largest && rounding <= std::numeric_limits<double>::max()) largest = rounding;
  }
  return largest;
}
