#include "io/gdal/text_grid.h"

#include <cpl_vsi.h>
#include <fmt/format.h>

#include <array>
#include <limits>
#include <map>
#include <mutex>
#include <optional>
#include <utility>

#include "io/gdal/crs.h"
#include "io/gdal/memory_file.h"
#include "io/gdal/open.h"
#include "io/points/point_columns.h"
#include "io/points/point_grid.h"
#include "io/points/point_source.h"
#include "io/spool.h"
#include "scarp/io.h"

namespace scarp::gdal {
namespace {

/// The CRS in the .aux.xml file that gdal_edit.py wrote next to the text.
Crs find_crs_beside(const std::string& path) {
  VSIStatBufL status{};
  if (VSIStatL((path + ".aux.xml").c_str(), &status) != 0) return nullptr;
  const Dataset dataset(GDALOpenEx(path.c_str(), GDAL_OF_RASTER | GDAL_OF_READONLY, nullptr, nullptr, nullptr));
  return dataset ? copy_crs(GDALGetSpatialRef(dataset.get())) : nullptr;
}

Result<std::string> keep_as_geotiff(const io::PointGrid& grid, const std::string& unit, const std::string& warnings,
                                    const std::string& path) {
  const auto refuse = [&] { return fail(ErrorKind::kOutput, path + ": GDAL cannot make a GeoTIFF of its nodes"); };
  const MemoryFile file("tif");
  {
    Dataset made(GDALCreate(GDALGetDriverByName("GTiff"), file.name(), grid.cols, grid.rows, 1, GDT_Float64, nullptr));
    if (!made) return refuse();
    std::array<double, 6> place{grid.west - grid.dx / 2, grid.dx, 0, grid.north + grid.dy / 2, 0, -grid.dy};
    GDALRasterBandH band = GDALGetRasterBand(made.get(), 1);
    GDALSetGeoTransform(made.get(), place.data());
    GDALSetRasterNoDataValue(band, std::numeric_limits<double>::quiet_NaN());
    if (!unit.empty()) GDALSetRasterUnitType(band, unit.c_str());
    if (const Crs crs = find_crs_beside(path)) GDALSetSpatialRef(made.get(), crs.get());
    const std::string nodes =
        fmt::format("{} x {} nodes{}", grid.cols, grid.rows,
                    grid.missing == 0 ? std::string() : fmt::format(", {} of them missing", grid.missing));
    GDALSetMetadataItem(made.get(), kTextGridKey, nodes.c_str(), nullptr);
    if (!warnings.empty()) GDALSetMetadataItem(made.get(), kTextWarningsKey, warnings.c_str(), nullptr);
    auto* heights = const_cast<double*>(grid.heights.data());
    if (GDALRasterIO(band, GF_Write, 0, 0, grid.cols, grid.rows, heights, grid.cols, grid.rows, GDT_Float64, 0, 0) !=
        CE_None)
      return refuse();
  }
  return io::spool_bytes(file.bytes());
}

Result<std::string> make_text_grid(const std::string& name, const std::string& path) {
  const auto bytes = read_file(name);
  if (!bytes) return std::string();
  ReadPointsOptions options;
  options.nodata = std::numeric_limits<double>::quiet_NaN();  // a node without a number is nodata
  options.heights_in = HeightsIn::kFile;
  std::optional<io::PointGrid> grid;
  std::string unit;
  {
    const auto points = io::decode_columns(*bytes, path, options);
    if (points) grid = io::find_grid(*points);
    if (points) unit = points->heights.unit;
  }
  if (!grid) return std::string();
  const auto columns = io::find_columns({reinterpret_cast<const char*>(bytes->data()), bytes->size()}, path, options);
  return keep_as_geotiff(*grid, unit, columns ? fmt::format("{}", fmt::join(columns->warnings, "\n")) : "", path);
}

}  // namespace

Result<std::string> find_text_grid(const std::string& path) {
  if (is_remote(path)) return std::string();
  const auto name = io::readable_name(path);
  VSIStatBufL status{};
  if (!name || VSIStatL(name->c_str(), &status) != 0 || !VSI_ISREG(status.st_mode)) return std::string();
  if (!io::is_text_of_columns(path) || !io::holds_plain_text(path) || io::begins_as_grid(path)) return std::string();
  struct Kept {
    std::pair<long long, long long> state;  // size and time
    std::string name;
  };
  static std::mutex mutex;
  static std::map<std::string, Kept> all;
  const std::pair<long long, long long> state{status.st_size, status.st_mtime};
  const std::lock_guard lock(mutex);
  if (const auto found = all.find(path); found != all.end() && found->second.state == state) return found->second.name;
  auto made = make_text_grid(*name, path);
  if (made) all[path] = {state, *made};
  return made;
}

}  // namespace scarp::gdal

namespace scarp::io {

bool is_text_grid(const std::string& path) {
  const gdal::Session session;
  const auto name = gdal::find_text_grid(path);
  return name && !name->empty();
}

}  // namespace scarp::io
