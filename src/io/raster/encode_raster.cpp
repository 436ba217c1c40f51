// Encodes rasters: PGM here, GeoTIFF by GDAL.
#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "base/caught.h"
#include "io/raster/raster_source.h"
#include "scarp/io.h"

namespace scarp {
namespace {

constexpr double kPgmMost = 65535;

Result<std::vector<std::uint8_t>> encode_pgm(const RasterImage& raster) {
  const std::string header = fmt::format("P5\n{} {}\n65535\n", raster.cols, raster.rows);
  std::vector<std::uint8_t> bytes(header.begin(), header.end());
  bytes.reserve(header.size() + 2 * raster.samples.size());
  const auto cols = static_cast<std::size_t>(raster.cols);
  bool has_nodata = false;
  std::size_t brightest = raster.samples.size();  // the first sample that readers could mistake for nodata
  for (std::size_t i = 0; i < raster.samples.size(); ++i) {
    const float sample = raster.samples[i];
    double value = kPgmMost;
    if (std::isnan(sample)) {
      has_nodata = true;
    } else {
      value = std::floor(double{sample} + 0.5);
      if (!(value >= 0 && value <= kPgmMost)) {
        return fail(ErrorKind::kOutput,
                    fmt::format("sample ({}, {}) is {}, and a PGM holds whole numbers from 0 to 65535; write GeoTIFF",
                                i % cols, i / cols, sample));
      }
      if (value == kPgmMost && brightest == raster.samples.size()) brightest = i;
    }
    const auto number = static_cast<std::uint16_t>(value);
    bytes.push_back(static_cast<std::uint8_t>(number >> 8));
    bytes.push_back(static_cast<std::uint8_t>(number & 255));
  }
  if (has_nodata && brightest < raster.samples.size()) {
    return fail(ErrorKind::kOutput,
                fmt::format("sample ({}, {}) is 65535, which stands for nodata in the PGM of a raster "
                            "with missing samples; write GeoTIFF",
                            brightest % cols, brightest / cols));
  }
  return bytes;
}

}  // namespace

Result<std::vector<std::uint8_t>> encode_raster(const RasterImage& raster, RasterFormat format) try {
  const auto count =
      static_cast<std::size_t>(std::max(raster.cols, 0)) * static_cast<std::size_t>(std::max(raster.rows, 0));
  if (count == 0 || raster.samples.size() != count) {
    return fail(ErrorKind::kOutput, fmt::format("a raster of {} x {} samples cannot be made of {} values", raster.cols,
                                                raster.rows, raster.samples.size()));
  }
  return format == RasterFormat::kPgm ? encode_pgm(raster) : io::encode_geotiff(raster);
} catch (...) {
  return caught(ErrorKind::kOutput, "encode the raster");
}

}  // namespace scarp
