// The meaning of a band's values.
#include <cpl_string.h>
#include <fmt/format.h>

#include <cmath>
#include <string_view>

#include "io/gdal/read_samples.h"
#include "scarp/commands.h"

namespace scarp::gdal {
namespace {

/// A mask that holds more than "not the declared nodata value": a mask band, an alpha band, nodata by colour.
GDALRasterBandH find_mask(GDALDatasetH dataset, GDALRasterBandH band, const ReadOptions& options) {
  const int flags = GDALGetMaskFlags(band);
  const bool by_value = (flags & GMF_NODATA) != 0;
  const bool by_dataset_value = by_value && (flags & GMF_PER_DATASET) != 0;
  if (by_dataset_value && !options.nodata) return GDALGetMaskBand(band);
  if ((flags & GMF_ALL_VALID) == 0 && !by_value) return GDALGetMaskBand(band);
  if (!by_value) return nullptr;
  // A declared value hides the alpha band from GDAL's mask.
  for (int k = 1; k <= GDALGetRasterCount(dataset); ++k) {
    GDALRasterBandH other = GDALGetRasterBand(dataset, k);
    if (other != band && GDALGetRasterColorInterpretation(other) == GCI_AlphaBand) return other;
  }
  return nullptr;
}

void plan_nodata(const ReadOptions& options, BandPlan& plan, RasterInfo& info) {
  int declared = 0;
  if (plan.type == GDT_Int64) {
    const std::int64_t value = GDALGetRasterNoDataValueAsInt64(plan.band, &declared);
    if (declared) plan.nodata_int64 = value;
    if (declared) plan.nodata = static_cast<double>(value);
  } else if (plan.type == GDT_UInt64) {
    const std::uint64_t value = GDALGetRasterNoDataValueAsUInt64(plan.band, &declared);
    if (declared) plan.nodata_uint64 = value;
    if (declared) plan.nodata = static_cast<double>(value);
  } else {
    const double value = GDALGetRasterNoDataValue(plan.band, &declared);
    if (declared) plan.nodata = value;
  }
  if (options.nodata) {
    const double wanted = *options.nodata;
    const bool whole = std::floor(wanted) == wanted;
    plan.nodata = wanted;
    plan.nodata_int64.reset();
    plan.nodata_uint64.reset();
    if (whole && std::abs(wanted) < 0x1p63) plan.nodata_int64 = static_cast<std::int64_t>(wanted);
    if (whole && wanted >= 0 && wanted < 0x1p64) plan.nodata_uint64 = static_cast<std::uint64_t>(wanted);
  }
  info.nodata = plan.nodata;
}

/// The attributes of a netCDF variable that declare depths; empty unless its values count downwards.
std::string find_depths(GDALRasterBandH band) {
  const auto attribute = [&](const char* name) {
    const char* value = GDALGetMetadataItem(band, name, nullptr);
    return std::string(value != nullptr ? value : "");
  };
  const std::string positive = attribute("positive"), name = attribute("standard_name");
  if (EQUAL(positive.c_str(), "down")) return "the positive of its variable is down";
  if (!positive.empty()) return "";
  const bool is_depth = name == "depth" || name.starts_with("sea_floor_depth_below");
  return is_depth ? "the standard_name of its variable is " + name : "";
}

}  // namespace

Result<BandPlan> plan_band(GDALDatasetH dataset, const std::string& path, const ReadOptions& options,
                           RasterInfo& info) {
  const int count = GDALGetRasterCount(dataset);
  if (options.band < 1 || options.band > count) {
    return fail(ErrorKind::kInput,
                fmt::format("{} has {} band{}; there is no band {}", path, count, count == 1 ? "" : "s", options.band));
  }
  BandPlan plan;
  plan.band = GDALGetRasterBand(dataset, options.band);
  plan.type = GDALGetRasterDataType(plan.band);
  info.sample_type = GDALGetDataTypeName(plan.type);
  if (GDALDataTypeIsComplex(plan.type)) {
    return fail(
        ErrorKind::kInput,
        fmt::format("{}: band {} holds complex numbers ({}), which are no heights; take their real parts first ({})",
                    path, options.band, info.sample_type,
                    translate_command(fmt::format("-ot Float64 -b {}", options.band), path)));
  }
  const char* pixel_type = GDALGetMetadataItem(plan.band, "PIXELTYPE", "IMAGE_STRUCTURE");
  plan.signed_byte = plan.type == GDT_Byte && pixel_type != nullptr && EQUAL(pixel_type, "SIGNEDBYTE");
  if (plan.signed_byte) info.sample_type = "Int8";
  plan_nodata(options, plan, info);
  plan.mask = find_mask(dataset, plan.band, options);

  int given = 0;
  plan.scale = GDALGetRasterScale(plan.band, &given);
  if (!given) plan.scale = 1;
  plan.offset = GDALGetRasterOffset(plan.band, &given);
  if (!given) plan.offset = 0;
  if (plan.scale == 0 || !std::isfinite(plan.scale) || !std::isfinite(plan.offset)) {
    info.warnings.push_back(
        fmt::format("band {} declares scale {} and offset {}, which make no heights and are ignored", options.band,
                    plan.scale, plan.offset));
    plan.scale = 1;
    plan.offset = 0;
  }
  info.unit = GDALGetRasterUnitType(plan.band);
  plan.depths = find_depths(plan.band);
  return plan;
}

void warn_of_colours(GDALDatasetH dataset, const BandPlan& plan, bool as_values, RasterInfo& info) {
  const GDALColorInterp meaning = GDALGetRasterColorInterpretation(plan.band);
  if (as_values) {
    if (meaning == GCI_RedBand && GDALGetRasterCount(dataset) >= 3)
      info.warnings.push_back(info.path +
                              ": this is a colour picture, and its first band alone, red, is taken for the values");
    if (meaning == GCI_PaletteIndex)
      info.warnings.push_back(
          info.path + ": this is a picture with a palette, and the numbers of its colours are taken for the values");
    return;
  }
  if (plan.type == GDT_Byte && GDALGetRasterCount(dataset) >= 3 && meaning == GCI_RedBand) {
    info.warnings.push_back(
        "this is a colour picture, and its red is taken as height: heights packed into colours need to be "
        "decoded as terrarium or mapbox");
  }
  if (meaning == GCI_PaletteIndex) {
    info.warnings.push_back("this is a picture with a palette, and the numbers of its colours are taken as heights");
  }
}

}  // namespace scarp::gdal
