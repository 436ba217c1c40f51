// Replacements for functions that need GDAL, in a build without it.
#ifndef SCARP_WITH_GDAL

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <filesystem>
#include <system_error>
#include <vector>

#include "grid/local_frame.h"
#include "io/globe_image.h"
#include "io/globe_place.h"
#include "io/lent.h"
#include "io/line_heights.h"
#include "io/mesh/mesh_file.h"
#include "io/points/point_heights.h"
#include "io/points/point_source.h"
#include "io/raster/crs_description.h"
#include "io/raster/raster_finish.h"
#include "io/raster/raster_source.h"
#include "scarp/height_field.h"
#include "scarp/io.h"
#include "scarp/lines.h"

namespace scarp::io {

Result<std::vector<std::uint8_t>> encode_gpkg(const Mesh&) {
  return fail(ErrorKind::kOutput, "GeoPackage cannot be written: this build of Scarp has no GDAL, which encodes it");
}

}  // namespace scarp::io

namespace scarp {
namespace {

tl::unexpected<Error> refuse(const std::string& path) {
  std::error_code error;
  if (path != "-" && !std::filesystem::exists(path, error)) return fail(ErrorKind::kInput, path + ": no such file");
  return fail(ErrorKind::kInput,
              path + ": neither PGM nor STM, and this build of Scarp reads nothing else: it was built without GDAL");
}

}  // namespace

Result<OwnedHeightField> io::read_gdal_raster(const std::string& path, const ReadOptions&) { return refuse(path); }

Result<OwnedHeightField> io::open_gdal_raster(const std::string& path, const ReadOptions&) { return refuse(path); }

Result<OwnedChannels> io::read_gdal_channels(const std::string& path, const ReadOptions&, bool) { return refuse(path); }

Result<std::vector<std::uint8_t>> io::encode_geotiff(const RasterImage&) {
  return fail(ErrorKind::kOutput,
              "GeoTIFF cannot be written: this build of Scarp has no GDAL, which encodes it; write PGM");
}

Result<std::unique_ptr<io::GeoTiff>> io::create_geotiff(const std::string&, int, int, const RasterInfo*) {
  return fail(ErrorKind::kOutput, "GeoTIFF cannot be written: this build of Scarp has no GDAL, which encodes it");
}

Result<RasterOnGlobe> io::place_on_globe(const RasterInfo&, int, int, const Datum&, const std::string& path) {
  return fail(ErrorKind::kInput, path + ": this build of Scarp knows no place on the globe: it was built without GDAL");
}

bool io::is_local_crs(const RasterInfo&) { return false; }

Result<PlaneOnGlobe> io::find_plane_on_globe(const RasterInfo& info, const LocalRaster&, const RasterOnGlobe&) {
  return fail(ErrorKind::kInput,
              info.path + ": this build of Scarp knows no place on the globe: it was built without GDAL");
}

Result<Frame> io::place_lent_raster(const LentRaster& raster, const ReadOptions& options, RasterInfo& info) {
  const std::string& wanted = options.crs;
  const int cols = raster.cols, rows = raster.rows;
  if (wanted == "grid") return grid_or_cells(info.path, cols, rows, options);
  if (!wanted.empty() && wanted != "local" && wanted != "source") {
    return fail(ErrorKind::kUsage, info.path + ": this build of Scarp knows no CRS such as '" + wanted +
                                       "': it was built without GDAL; ask for the frame 'source', 'local' or 'grid'");
  }
  const auto& gt = *raster.geotransform;
  const std::array<double, 6> samples{gt[0] + gt[1] / 2 + gt[2] / 2, gt[1], gt[2],
                                      gt[3] + gt[4] / 2 + gt[5] / 2, gt[4], gt[5]};
  const bool is_local =
      wanted == "local" || (wanted.empty() && (options.default_frame == DefaultFrame::kLocal ||
                                               (options.default_frame == DefaultFrame::kMetric && info.is_geographic)));
  if (is_local && info.is_geographic) return frame_of_degrees(samples, cols, rows);
  if (is_local) {
    return grid::local_frame(samples, {1, 1}, cols, rows, raster.crs);
  }
  if (info.is_geographic) {
    info.warnings.push_back(
        "x and y are degrees while z is a length: the mesh is no shape in space; the frame 'local' is in metres");
  }
  Frame frame;
  frame.kind = Frame::Kind::kSource;
  frame.affine = samples;
  frame.crs = raster.crs;
  frame.description = raster.crs.empty() ? "the raster's own coordinates (no CRS)" : "coordinates in " + raster.crs;
  return frame;
}

Result<io::HeightUnit> io::place_lent_points(const ReadPointsOptions& options, PointSet& points) {
  const std::string& wanted = options.crs;
  if (wanted == "grid")
    return fail(ErrorKind::kUsage, points.path + ": scattered points have no grid: ask for 'source' or 'local'");
  if (!wanted.empty() && wanted != "local" && wanted != "source")
    return fail(ErrorKind::kUsage, points.path + ": this build of Scarp knows no CRS such as '" + wanted +
                                       "': it was built without GDAL; ask for the frame 'source' or 'local'");
  points.description = points.crs.empty() ? "the points' own coordinates (no CRS)" : "coordinates in " + points.crs;
  if (wanted == "source" && points.is_geographic)
    points.warnings.push_back(
        "x and y are degrees while z is a length: the mesh is no shape in space; the frame 'local' is in metres");
  if (wanted == "source" || (wanted.empty() && !points.is_geographic)) return {};
  const auto [x, y] = middle_of(points);
  const auto [east, north] = points.is_geographic ? metres_of_unit(y) : std::array{1.0, 1.0};
  if (!(east > 1e-3 * north))
    return fail(ErrorKind::kUsage,
                fmt::format("{}: the middle of the points lies at {:.9g}, {:.9g}, at or beyond a pole, where no local "
                            "frame exists",
                            points.path, x, y));
  make_local_metres({east, north}, points.crs.empty() ? "degrees" : points.crs, points);
  return {};
}

bool io::can_describe_crs() { return false; }

std::string io::describe_geo_keys(const GeoKeys&) { return ""; }

std::optional<io::CrsDescription> io::describe_crs(const std::string&) { return {}; }

std::optional<std::array<double, 2>> find_degrees(const std::string&, double, double) { return {}; }

std::optional<std::string> projection_text(const std::string&) { return {}; }

bool is_in_space(const std::string&) { return false; }

bool io::is_same_crs(const std::string& a, const std::string& b) { return a == b; }

Result<PointSet> io::read_gdal_points(const std::string& path, const ReadPointsOptions&) {
  return fail(ErrorKind::kInput,
              path + ": not text of columns, and this build of Scarp reads no other points: it was built without GDAL");
}

Result<LineSet> io::read_lines_in(const std::string& path, const ReadLinesOptions&, double) {
  return fail(ErrorKind::kInput, path + ": this build of Scarp reads no vector data: it was built without GDAL");
}

Result<std::vector<Line>> inset_polygons(std::span<const Line>, double, const std::array<double, 2>&, double) {
  return fail(ErrorKind::kUsage,
              "polygons cannot be moved inwards: this build of Scarp has no GDAL, whose GEOS does that");
}

bool io::opens_as_raster(const std::string&) { return false; }

bool io::is_text_grid(const std::string&) { return false; }

std::vector<std::vector<std::string>> find_mosaics(const std::vector<std::string>& paths) {
  std::vector<std::vector<std::string>> alone;
  for (const std::string& path : paths) alone.push_back({path});
  return alone;
}

std::vector<std::string> list_files(const std::string&) { return {}; }

Result<std::vector<std::uint8_t>> encode_image(const Picture&, ImageFormat) {
  return fail(ErrorKind::kOutput, "pictures cannot be written: this build of Scarp has no GDAL, which encodes PNG");
}

Result<std::vector<std::uint8_t>> encode_png(const Picture& picture) {
  return encode_image(picture, ImageFormat::kPng);
}

Result<std::shared_ptr<const io::GlobeImage>> io::open_globe_image(const std::string& path, const Geodetic&) {
  return fail(ErrorKind::kInput, path + ": this build of Scarp drapes no image: it was built without GDAL");
}

Result<Drape> read_drape(const std::string& path, const RasterInfo&, int, int, int, const Run&) {
  return fail(ErrorKind::kInput, path + ": this build of Scarp drapes no image: it was built without GDAL");
}

}  // namespace scarp

#endif
