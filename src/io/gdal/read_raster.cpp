// One raster, from its name to samples in a frame.
#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <memory>
#include <mutex>
#include <sstream>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

#include "grid/height_range.h"
#include "io/commands.h"
#include "io/gdal/georeference.h"
#include "io/gdal/open.h"
#include "io/gdal/read_samples.h"
#include "io/gdal/text_grid.h"
#include "io/gdal/view.h"
#include "io/raster/height_unit.h"
#include "io/raster/raster_finish.h"
#include "io/raster/raster_source.h"

namespace scarp::gdal {
namespace {

/// An open and interpreted raster whose samples are not yet read.
struct UnreadRaster {
  Dataset dataset;
  Georeference georeference;
  BandSense band;
  RasterInfo info;
};

/// The warning includes the range, if known.
void warn_of_depths(const UnreadRaster& unread, const ReadOptions& options, RasterInfo& info) {
  const SpaceCrs& crs = unread.georeference.in_space;
  const std::string reason =
      crs.is_down ? fmt::format("its vertical CRS, {}, counts downwards", crs.vertical) : unread.band.depths;
  if (reason.empty() || options.as_values || options.z_scale < 0) return;
  info.depths = reason;
  info.warnings.push_back(
      info.has_range && info.max <= 0
          ? fmt::format("{}: {}, but no value is above 0: they are taken for heights, not for depths", info.path,
                        reason)
          : fmt::format("{}: {}: depths are taken for heights, and the mesh is upside down; turn it with a negative "
                        "--z-scale, such as -1",
                        info.path, reason));
}

Result<UnreadRaster> open_unread(Session& session, const std::string& path, const ReadOptions& options) {
  UnreadRaster unread;
  Means means;
  SCARP_TRY(unread.dataset, open_view(session, path, options.view, false, unread.info.view, &means, options.nodata));
  unread.info.path = path;
  const bool is_text = GDALGetMetadataItem(unread.dataset.get(), kTextGridKey, nullptr) != nullptr;
  if (const char* warnings = GDALGetMetadataItem(unread.dataset.get(), kTextWarningsKey, nullptr)) {
    std::istringstream lines(warnings);
    for (std::string line; std::getline(lines, line);) unread.info.warnings.push_back(line);
  }
  unread.info.format = is_text ? "XYZ" : GDALGetDriverShortName(GDALGetDatasetDriver(unread.dataset.get()));
  if (options.decode == Decode::kNone) {
    SCARP_TRY(auto&& band, find_band_sense(unread.dataset.get(), path, options, unread.info));
    unread.band = band;
    unread.info.scale = band.scale;
    unread.info.offset = band.offset;
    unread.band.means = means;
    if (means.have_holes) {
      unread.band.nodata = std::numeric_limits<double>::quiet_NaN();
      unread.info.nodata = means.nodata;
    }
    warn_of_colours(unread.dataset.get(), unread.band, options.as_values, unread.info);
  } else {
    SCARP_RETURN_IF_ERROR(verify_packed(unread.dataset.get(), path));
    unread.info.sample_type = options.decode == Decode::kTerrarium ? "Byte (terrarium)" : "Byte (mapbox)";
    unread.info.nodata = options.nodata;
    unread.info.unit.assign(1, 'm');
  }
  SCARP_TRY(auto&& geo, read_georeference(unread.dataset.get(), path));
  describe_georeference(geo, unread.info);
  if (!geo.located && GDALGetGCPCount(unread.dataset.get()) > 0) {
    unread.info.warnings.push_back(
        fmt::format("the raster is placed by ground control points, which are not used: rectify it first ({})",
                    io::warp_command("", path)));
  }
  unread.georeference = std::move(geo);
  return unread;
}

void add_gdal_warnings(const Session& session, RasterInfo& info) {
  for (const std::string& warning : session.warnings()) info.warnings.push_back("GDAL: " + warning);
}

/// A raster with all that is known before reading samples.
struct OpenedRaster {
  UnreadRaster unread;
  OwnedHeightField field;

  std::unique_ptr<WindowReader> make_reader(const ReadOptions& options) const {
    return options.decode == Decode::kNone ? make_band_reader(unread.band)
                                           : make_packed_reader(unread.dataset.get(), options);
  }
  /// Reopens a file whose blocks can be decoded independently; empty for others.
  OpenAgain again(const ReadOptions& options) const {
    const char* name = GDALGetDescription(unread.dataset.get());
    if (field.info.format != "GTiff" || std::string_view(name).starts_with("/vsi")) return {};
    return [this, &options]() -> std::optional<ReadHandle> { return open_again(options); };
  }
  GDALRasterBandH first_band(const ReadOptions& options) const {
    return options.decode == Decode::kNone ? unread.band.band : GDALGetRasterBand(unread.dataset.get(), 1);
  }

 private:
  std::optional<ReadHandle> open_again(const ReadOptions& options) const {
    constexpr const char* kDrivers[] = {"GTiff", nullptr};
    ReadHandle handle{Dataset(GDALOpenEx(GDALGetDescription(unread.dataset.get()), GDAL_OF_RASTER | GDAL_OF_READONLY,
                                         kDrivers, nullptr, nullptr)),
                      nullptr};
    if (!handle.dataset) return {};
    if (options.decode != Decode::kNone) {
      handle.reader = make_packed_reader(handle.dataset.get(), options);
      return handle;
    }
    RasterInfo said;
    auto band = find_band_sense(handle.dataset.get(), field.info.path, options, said);
    if (!band) return {};
    BandSense same = unread.band;
    same.band = band->band;
    same.mask = band->mask;
    handle.reader = make_band_reader(same);
    return handle;
  }
};

/// Changes `options` to those for reading the samples.
Result<OpenedRaster> open(Session& session, const std::string& path, ReadOptions& options) {
  SCARP_TRY(auto&& unread, open_unread(session, path, options));
  const Georeference& geo = unread.georeference;
  const auto cols = static_cast<std::uint64_t>(geo.cols), rows = static_cast<std::uint64_t>(geo.rows);
  SCARP_RETURN_IF_ERROR(io::check_raster_sides(path, cols, rows));
  SCARP_TRY(auto&& frame, choose_frame(geo, options, unread.info));
  SCARP_TRY(options, settle_heights(options, frame, unread.info, geo.in_space.unit));
  // Applied to the band's scale, so that all ways of reading include it.
  unread.band.scale *= options.z_scale;
  unread.band.offset = options.z_scale * unread.band.offset + options.z_offset;
  if (options.heights_in != HeightsIn::kMetres)
    io::warn_of_units(frame, unread.info);  // else the caller handles x and y
  OpenedRaster opened;
  opened.field.cols = geo.cols;
  opened.field.rows = geo.rows;
  opened.field.frame = std::move(frame);
  opened.field.info = std::move(unread.info);
  opened.unread = std::move(unread);
  return opened;
}

/// Rejects heights beyond float32 instead of treating them as missing.
Result<void> refuse_beyond(const Findings& findings, const std::string& path, const ReadOptions& options) {
  if (!findings.beyond || options.as_values) return {};
  return fail(
      ErrorKind::kInput,
      fmt::format("{}: the value {:.6g} at column {}, row {} is beyond what a float32 holds (3.4e38): if it means "
                  "nodata, give --nodata {:.17g}, else give the heights in a larger unit first ({})",
                  path, findings.beyond->value, findings.beyond->col, findings.beyond->row, findings.beyond->value,
                  io::translate_command("-ot Float64 -scale 0 1e10 0 1", path)));
}

Result<OwnedHeightField> read_samples(Session& session, OpenedRaster opened, const ReadOptions& options) {
  OwnedHeightField& field = opened.field;
  const std::string& path = field.info.path;
  SCARP_RETURN_IF_ERROR(io::allocate_samples(path, field, options.run.threads));
  const auto reader = opened.make_reader(options);
  SCARP_TRY(const auto& found,
            read_windows(session, opened.first_band(options), *reader, opened.again(options), options, field));
  add_gdal_warnings(session, field.info);
  doubt_colours(found, options.decode, find_loss(opened.unread.dataset.get()), field.info);
  SCARP_RETURN_IF_ERROR(io::finish_raster(field, found.infinities, options));
  warn_of_depths(opened.unread, options, field.info);
  SCARP_RETURN_IF_ERROR(refuse_beyond(found, path, options));
  return std::move(field);
}

Result<OwnedHeightField> read(const std::string& path, ReadOptions options) {
  Session session(is_remote(path));
  SCARP_TRY(auto&& opened, open(session, path, options));
  const auto cols = static_cast<std::uint64_t>(opened.field.cols), rows = static_cast<std::uint64_t>(opened.field.rows);
  SCARP_RETURN_IF_ERROR(io::check_raster_size(path, cols, rows, options));
  return read_samples(session, std::move(opened), options);
}

/// Reads samples from their file on demand.
class FileSource : public SampleSource {
 public:
  FileSource(UnreadRaster unread, std::unique_ptr<WindowReader> reader, std::string path)
      : unread_(std::move(unread)), reader_(std::move(reader)), path_(std::move(path)), is_remote_(is_remote(path_)) {}

  Result<void> read(int col, int row, int cols, int rows, float* out, std::ptrdiff_t stride) const override {
    const std::lock_guard lock(mutex_);
    Session session(is_remote_);
    return read_or_explain(session, {col, row, cols, rows}, path_, [&](const Window& window) {
      return reader_->read(window, out + (window.row - row) * stride, stride);
    });
  }
  bool is_in_memory() const override { return false; }

 private:
  UnreadRaster unread_;
  std::unique_ptr<WindowReader> reader_;
  std::string path_;
  bool is_remote_;
  mutable std::mutex mutex_;
};

/// Reads all samples once, for their range and their rounding.
Result<void> survey(Session& session, const OpenedRaster& opened, WindowReader& reader, const ReadOptions& options,
                    OwnedHeightField& field) {
  RasterInfo& info = field.info;
  HeightRange range;
  std::vector<float> heights;
  const auto look = [&](const Window& window) {
    heights.resize(static_cast<std::size_t>(window.cols) * static_cast<std::size_t>(window.rows));
    if (!reader.read(window, heights.data(), window.cols)) return false;
    range.add(grid::range_of(heights));
    return true;
  };
  const Extent extent{info.path, field.cols, field.rows};
  SCARP_RETURN_IF_ERROR(for_each_window(session, opened.first_band(options), extent, options.run.progress, look));
  grid::set_range(range, info);
  field.sample_rounding = reader.findings().rounding;
  doubt_colours(reader.findings(), options.decode, find_loss(opened.unread.dataset.get()), info);
  SCARP_RETURN_IF_ERROR(io::finish_info(field, reader.findings().infinities, options));
  return refuse_beyond(reader.findings(), info.path, options);
}

/// Makes a source of the samples' file.
Result<OwnedHeightField> keep_in_file(Session& session, OpenedRaster opened, const ReadOptions& options) {
  // Bands of rows are read in sequence. A file in blocks is decoded only once if the cache holds a row of blocks and
  // the start of the next row.
  widen_block_cache(options.run.memory.limit);
  OwnedHeightField& field = opened.field;
  field.info.has_range = false;
  auto reader = opened.make_reader(options);
  const bool may_surprise = options.decode != Decode::kNone || !is_float32(opened.unread.band);
  if (options.with_range || may_surprise || opened.unread.band.means.cells > 1) {
    SCARP_RETURN_IF_ERROR(survey(session, opened, *reader, options, field));
  }
  warn_of_depths(opened.unread, options, field.info);
  add_gdal_warnings(session, field.info);
  field.source = std::make_shared<FileSource>(std::move(opened.unread), std::move(reader), field.info.path);
  return std::move(field);
}

Result<OwnedHeightField> open_field(const std::string& path, ReadOptions options) {
  Session session(is_remote(path));
  SCARP_TRY(auto&& opened, open(session, path, options));
  OwnedHeightField& field = opened.field;
  const double samples = static_cast<double>(field.cols) * static_cast<double>(field.rows);
  const double memory = 5.0 * static_cast<double>(max_samples(options.run.memory.limit));
  if (sizeof(float) * samples <= memory) return read_samples(session, std::move(opened), options);
  const bool is_coded = options.decode == Decode::kNone && has_codes(opened.unread.band);
  if (!is_coded || 2 * samples > memory) return keep_in_file(session, std::move(opened), options);
  std::uint64_t infinities = 0;
  SCARP_RETURN_IF_ERROR(read_codes(session, opened.unread.band, options, field, infinities));
  add_gdal_warnings(session, field.info);
  SCARP_RETURN_IF_ERROR(io::finish_info(field, infinities, options));
  warn_of_depths(opened.unread, options, field.info);
  return std::move(field);
}

}  // namespace
}  // namespace scarp::gdal

namespace scarp::io {

Result<OwnedHeightField> read_gdal_raster(const std::string& path, const ReadOptions& options) {
  return gdal::read(path, options);
}

Result<OwnedHeightField> open_gdal_raster(const std::string& path, const ReadOptions& options) {
  return gdal::open_field(path, options);
}

}  // namespace scarp::io
