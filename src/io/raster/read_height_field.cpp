// The common reader of rasters: a file's first bytes select its format's reader.
#include <fmt/format.h>

#include <array>
#include <cmath>
#include <filesystem>
#include <fstream>
#include <span>
#include <system_error>
#include <utility>

#include "base/caught.h"
#include "grid/small_voids.h"
#include "io/commands.h"
#include "io/lent.h"
#include "io/raster/pgm.h"
#include "io/raster/raster_finish.h"
#include "io/raster/raster_source.h"
#include "io/raster/stm.h"
#include "io/spool.h"

namespace scarp::io {
namespace {

enum class Reader { kPgm, kStm, kGdal };

/// Names that are not local files, and devices, are passed to GDAL unopened.
Result<Reader> find_reader(const std::string& path, const RasterView& view) {
  if (!view.is_whole()) return Reader::kGdal;
  SCARP_TRY(const auto& name, readable_name(path));
  std::error_code ignored;
  if (!std::filesystem::is_regular_file(name, ignored)) return Reader::kGdal;
  std::ifstream file(name, std::ios::binary);
  std::array<char, 4096> bytes{};
  file.read(bytes.data(), bytes.size());
  const std::span head(reinterpret_cast<const std::uint8_t*>(bytes.data()), static_cast<std::size_t>(file.gcount()));
  if (is_pgm(head)) return Reader::kPgm;
  if (is_stm(head)) return Reader::kStm;
  return Reader::kGdal;
}

/// Fails with kInput if the whole file and its samples as floats exceed the memory limit.
Result<void> check_whole_file(const std::string& path, const ReadOptions& options) {
  std::error_code ignored;
  const std::uintmax_t bytes = std::filesystem::file_size(*readable_name(path), ignored);
  if (ignored || options.run.memory.limit == 0 || bytes <= options.run.memory.limit / 3) return {};
  return fail(ErrorKind::kInput,
              fmt::format("{}: PGM and STM are read as a whole, which needs {} of memory, but only {} are allowed for "
                          "samples: allow more, or convert it to a format that is read by windows, such as GeoTIFF",
                          path, format_memory(3 * static_cast<double>(bytes)),
                          format_memory(static_cast<double>(options.run.memory.limit))));
}

Result<void> fill_enclosed(OwnedHeightField& field, int side) {
  if (side <= 0) return {};
  RasterInfo& info = field.info;
  if (!field.source) {
    info.voids = grid::fill_small_voids(field, side);
    return {};
  }
  if (info.has_range && info.valid < static_cast<std::uint64_t>(field.cols) * static_cast<std::uint64_t>(field.rows)) {
    SCARP_TRY(info.voids, grid::count_voids(field.view(), side));
  }
  field.source = grid::without_small_voids(field.view(), side, field.source);
  return {};
}

Result<void> fill_voids(OwnedHeightField& field, const std::string& path, const ReadOptions& options) {
  const double distance = options.fill_distance;
  if (distance <= 0) return fill_enclosed(field, options.void_side);
  if (field.source) {
    const double bytes = 4.0 * field.cols * field.rows;
    return fail(ErrorKind::kInput,
                fmt::format("{}: filling its nodata needs all samples in memory, {}, which is more than is allowed for "
                            "them: allow more, or fill it first (gdal_fillnodata.py -md {:.0f} {} {})",
                            path, format_memory(bytes), std::ceil(distance), file_word(path), new_file(".tif")));
  }
  field.info.voids.filled = fill_nodata(field, distance);
  return {};
}

Result<OwnedHeightField> read_as_it_is(const std::string& path, const ReadOptions& options) {
  if (const LentRaster* lent = find_lent_raster(path)) return read_lent_raster(*lent, path, options);
  SCARP_TRY(const auto& reader, find_reader(path, options.view));
  if (reader == Reader::kGdal) return read_gdal_raster(path, options);
  SCARP_TRY(auto&& bytes, read_file(path));
  return reader == Reader::kPgm ? decode_pgm(bytes, path, options) : decode_stm(bytes, path, options);
}

Result<OwnedHeightField> open_as_it_is(const std::string& path, const ReadOptions& options) {
  if (const LentRaster* lent = find_lent_raster(path)) return read_lent_raster(*lent, path, options);
  SCARP_TRY(const auto& reader, find_reader(path, options.view));
  if (reader == Reader::kGdal) return open_gdal_raster(path, options);
  SCARP_RETURN_IF_ERROR(check_whole_file(path, options));
  ReadOptions whole = options;
  whole.run.memory.limit = 0;
  return read_as_it_is(path, whole);
}

}  // namespace

}  // namespace scarp::io

namespace scarp {

Result<OwnedHeightField> open_height_field(const std::string& path, const ReadOptions& options) try {
  SCARP_TRY(auto&& field, io::open_as_it_is(path, options));
  SCARP_RETURN_IF_ERROR(io::fill_voids(field, path, options));
  return field;
} catch (...) {
  return caught(ErrorKind::kInput, "read " + path);
}

Result<OwnedHeightField> read_height_field(const std::string& path, const ReadOptions& options) try {
  SCARP_TRY(auto&& field, io::read_as_it_is(path, options));
  SCARP_RETURN_IF_ERROR(io::fill_voids(field, path, options));
  return field;
} catch (...) {
  return caught(ErrorKind::kInput, "read " + path);
}

Result<OwnedChannels> read_channels(const std::string& path, const ReadOptions& options, bool all_bands) try {
  SCARP_TRY(const auto& reader, io::find_reader(path, options.view));
  if (reader == io::Reader::kGdal) return io::read_gdal_channels(path, options, all_bands);
  ReadOptions one_band = options;
  if (all_bands) one_band.band = 1;
  SCARP_TRY(auto&& field, read_height_field(path, one_band));
  OwnedChannels channels;
  channels.cols = field.cols;
  channels.rows = field.rows;
  channels.is_8bit = field.info.sample_type == "Byte";
  channels.bands.push_back(std::move(field.samples));
  channels.frame = std::move(field.frame);
  channels.info = std::move(field.info);
  return channels;
} catch (...) {
  return caught(ErrorKind::kInput, "read " + path);
}

}  // namespace scarp
