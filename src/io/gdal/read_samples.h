// From bands to float32 samples.
#pragma once

#include <gdal.h>

#include <cstdint>
#include <optional>
#include <span>
#include <string>

#include "io/gdal/session.h"
#include "scarp/io.h"

namespace scarp::gdal {

/// The band to read and what its values mean.
struct BandPlan {
  GDALRasterBandH band = nullptr;
  GDALRasterBandH mask = nullptr;  ///< bytes, 0 = void; null if there is none
  GDALDataType type = GDT_Unknown;
  bool signed_byte = false;                  ///< GDT_Byte that holds −128 … 127
  std::optional<double> nodata;              ///< compared with raw values, before scale and offset
  std::optional<std::int64_t> nodata_int64;  ///< exact, for bands of 64-bit integers
  std::optional<std::uint64_t> nodata_uint64;
  double scale = 1, offset = 0;  ///< height = scale·raw + offset
};

/// kInput if the band does not exist, or is complex.
Result<BandPlan> plan_band(GDALDatasetH dataset, const std::string& path, const ReadOptions& options, RasterInfo& info);

/// Adds what seems odd about a band of heights: that it is a colour or the number of one.
void warn_of_colours(GDALDatasetH dataset, const BandPlan& plan, RasterInfo& info);

/// Reads the band into field.samples (already allocated) by windows of a few MB that follow the file's own blocks. Void
/// samples become NaN. Sets field.sample_rounding; counts infinities and values beyond float32 in `infinities`. kInput
/// as soon as GDAL reports any failure, kCancelled if the callback says so.
Result<void> read_band(Session& session, const BandPlan& plan, const ReadOptions& options, OwnedHeightField& field,
                       std::uint64_t& infinities);

/// The same for several bands of one raster, each into the field of its number; windows are read for all bands before
/// the next, so that interleaved files are decoded once.
Result<void> read_bands(Session& session, std::span<const BandPlan> plans, const ReadOptions& options,
                        std::span<OwnedHeightField> fields, std::uint64_t& infinities);

/// The same for heights packed into bands of colour.
Result<void> read_packed(Session& session, GDALDatasetH dataset, const ReadOptions& options, OwnedHeightField& field);

/// kInput unless the dataset has 3 or 4 bands of unsigned bytes.
Result<void> verify_packed(GDALDatasetH dataset, const std::string& path);

}  // namespace scarp::gdal
