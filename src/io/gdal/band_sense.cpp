// The meaning of a band's values.
#include <cpl_string.h>
#include <fmt/format.h>

#include <cmath>
#include <string_view>

#include "io/commands.h"
#include "io/gdal/read_samples.h"

namespace scarp::gdal {
namespace {

/// A mask that marks more than the declared nodata value: a mask band, an alpha band, nodata by colour.
GDALRasterBandH find_mask(GDALDatasetH dataset, GDALRasterBandH band, const ReadOptions& options) {
  const int flags = GDALGetMaskFlags(band);
  const bool by_value = (flags & GMF_NODATA) != 0;
  const bool by_dataset_value = by_value && (flags & GMF_PER_DATASET) != 0;
  if (by_dataset_value && !options.nodata) return GDALGetMaskBand(band);
  if ((flags & GMF_ALL_VALID) == 0 && !by_value) return GDALGetMaskBand(band);
  if (!by_value) return nullptr;
  // A declared nodata value hides the alpha band from GDAL's mask.
  for (int k = 1; k <= GDALGetRasterCount(dataset); ++k) {
    GDALRasterBandH other = GDALGetRasterBand(dataset, k);
    if (other != band && GDALGetRasterColorInterpretation(other) == GCI_AlphaBand) return other;
  }
  return nullptr;
}

void find_nodata(const ReadOptions& options, BandSense& sense, RasterInfo& info) {
  int declared = 0;
  if (sense.type == GDT_Int64) {
    const std::int64_t value = GDALGetRasterNoDataValueAsInt64(sense.band, &declared);
    if (declared) sense.nodata_int64 = value;
    if (declared) sense.nodata = static_cast<double>(value);
  } else if (sense.type == GDT_UInt64) {
    const std::uint64_t value = GDALGetRasterNoDataValueAsUInt64(sense.band, &declared);
    if (declared) sense.nodata_uint64 = value;
    if (declared) sense.nodata = static_cast<double>(value);
  } else {
    const double value = GDALGetRasterNoDataValue(sense.band, &declared);
    if (declared) sense.nodata = value;
  }
  if (options.nodata) {
    const double wanted = *options.nodata;
    const bool whole = std::floor(wanted) == wanted;
    sense.nodata = wanted;
    sense.nodata_int64.reset();
    sense.nodata_uint64.reset();
    if (whole && std::abs(wanted) < 0x1p63) sense.nodata_int64 = static_cast<std::int64_t>(wanted);
    if (whole && wanted >= 0 && wanted < 0x1p64) sense.nodata_uint64 = static_cast<std::uint64_t>(wanted);
  }
  info.nodata = sense.nodata;
}

/// The attributes of a netCDF variable that declare depths; empty unless its values increase downwards.
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

Result<BandSense> find_band_sense(GDALDatasetH dataset, const std::string& path, const ReadOptions& options,
                                  RasterInfo& info) {
  const int count = GDALGetRasterCount(dataset);
  if (options.band < 1 || options.band > count) {
    return fail(ErrorKind::kInput,
                fmt::format("{} has {} band{}; there is no band {}", path, count, count == 1 ? "" : "s", options.band));
  }
  BandSense sense;
  sense.band = GDALGetRasterBand(dataset, options.band);
  sense.type = GDALGetRasterDataType(sense.band);
  info.sample_type = GDALGetDataTypeName(sense.type);
  if (GDALDataTypeIsComplex(sense.type)) {
    return fail(
        ErrorKind::kInput,
        fmt::format("{}: band {} holds complex numbers ({}), which are no heights; take their real parts first ({})",
                    path, options.band, info.sample_type,
                    io::translate_command(fmt::format("-ot Float64 -b {}", options.band), path)));
  }
  const char* pixel_type = GDALGetMetadataItem(sense.band, "PIXELTYPE", "IMAGE_STRUCTURE");
  sense.signed_byte = sense.type == GDT_Byte && pixel_type != nullptr && EQUAL(pixel_type, "SIGNEDBYTE");
  if (sense.signed_byte) info.sample_type = "Int8";
  find_nodata(options, sense, info);
  sense.mask = find_mask(dataset, sense.band, options);

  int given = 0;
  sense.scale = GDALGetRasterScale(sense.band, &given);
  if (!given) sense.scale = 1;
  sense.offset = GDALGetRasterOffset(sense.band, &given);
  if (!given) sense.offset = 0;
  if (sense.scale == 0 || !std::isfinite(sense.scale) || !std::isfinite(sense.offset)) {
    info.warnings.push_back(
        fmt::format("band {} declares scale {} and offset {}, which make no heights and are ignored", options.band,
                    sense.scale, sense.offset));
    sense.scale = 1;
    sense.offset = 0;
  }
  info.unit = GDALGetRasterUnitType(sense.band);
  sense.depths = find_depths(sense.band);
  return sense;
}

void warn_of_colours(GDALDatasetH dataset, const BandSense& sense, bool as_values, RasterInfo& info) {
  const GDALColorInterp meaning = GDALGetRasterColorInterpretation(sense.band);
  if (as_values) {
    int count = 0;
    for (int k = 1; k <= GDALGetRasterCount(dataset); ++k)
      count += GDALGetRasterColorInterpretation(GDALGetRasterBand(dataset, k)) != GCI_AlphaBand ? 1 : 0;
    if (meaning == GCI_RedBand && GDALGetRasterCount(dataset) >= 3)
      info.warnings.push_back(info.path +
                              ": this is a colour picture, and its first band alone, red, is taken for the values");
    else if (count > 1)
      info.warnings.push_back(
          fmt::format("{}: has {} bands, and its first alone is taken for the values: select another "
                      "({})",
                      info.path, count, io::translate_command("-b 2", info.path)));
    if (meaning == GCI_PaletteIndex)
      info.warnings.push_back(
          info.path + ": this is a picture with a palette, and the numbers of its colours are taken for the values");
    return;
  }
  if (sense.type == GDT_Byte && GDALGetRasterCount(dataset) >= 3 && meaning == GCI_RedBand) {
    info.warnings.push_back(
        "this is a colour picture, and its red is taken as height: heights packed into colours need to be "
        "decoded as terrarium or mapbox");
  }
  if (meaning == GCI_PaletteIndex) {
    info.warnings.push_back("this is a picture with a palette, and the numbers of its colours are taken as heights");
  }
}

}  // namespace scarp::gdal
