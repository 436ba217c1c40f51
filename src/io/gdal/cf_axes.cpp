#include "io/gdal/cf_axes.h"

#include <cpl_string.h>
#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <memory>
#include <numbers>
#include <optional>
#include <string_view>
#include <type_traits>
#include <vector>

#include "io/commands.h"
#include "io/gdal/open.h"

namespace scarp::gdal {
namespace {

template <auto kRelease>
struct Release {
  template <class T>
  void operator()(T* handle) const {
    kRelease(handle);
  }
};
template <class Handle, auto kRelease>
using Owned = std::unique_ptr<std::remove_pointer_t<Handle>, Release<kRelease>>;
using Group = Owned<GDALGroupH, GDALGroupRelease>;
using Array = Owned<GDALMDArrayH, GDALMDArrayRelease>;
using Type = Owned<GDALExtendedDataTypeH, GDALExtendedDataTypeRelease>;

constexpr double kMostUneven = 0.05;  // fraction of a cell; allows for float32 coordinates

bool is_netcdf(GDALDatasetH dataset) {
  GDALDriverH driver = GDALGetDatasetDriver(dataset);
  return driver != nullptr && EQUAL(GDALGetDriverShortName(driver), "netCDF");
}

/// The coordinates along a dimension; empty if none.
std::vector<double> read_coordinates(GDALDimensionH dimension) {
  const Array array(GDALDimensionGetIndexingVariable(dimension));
  if (!array || GDALMDArrayGetDimensionCount(array.get()) != 1) return {};
  std::vector<double> values(static_cast<std::size_t>(GDALDimensionGetSize(dimension)));
  const Type type(GDALExtendedDataTypeCreate(GDT_Float64));
  const GUInt64 start = 0;
  const std::size_t count = values.size();
  if (count == 0 ||
      GDALMDArrayRead(array.get(), &start, &count, nullptr, nullptr, type.get(), values.data(), nullptr, 0) == 0)
    return {};
  return values;
}

struct Axes1D {
  std::vector<double> x, y;
};

std::optional<Axes1D> read_axes(GDALDatasetH dataset) {
  const CPLStringList files(GDALGetFileList(dataset));
  const char* name = GDALGetMetadataItem(GDALGetRasterBand(dataset, 1), "NETCDF_VARNAME", nullptr);
  if (files.empty() || name == nullptr) return {};
  const char* drivers[] = {"netCDF", nullptr};
  const Dataset whole(GDALOpenEx(files[0], GDAL_OF_MULTIDIM_RASTER, drivers, nullptr, nullptr));
  const Group root(whole ? GDALDatasetGetRootGroup(whole.get()) : nullptr);
  const Array array(root ? GDALGroupOpenMDArray(root.get(), name, nullptr) : nullptr);
  if (!array) return {};
  std::size_t count = 0;
  GDALDimensionH* dimensions = GDALMDArrayGetDimensions(array.get(), &count);
  std::optional<Axes1D> axes;
  if (count >= 2) axes = {read_coordinates(dimensions[count - 1]), read_coordinates(dimensions[count - 2])};
  GDALReleaseDimensions(dimensions, count);
  return axes;
}

/// The largest deviation from even spacing between the first and the last value, in steps.
double unevenness(const std::vector<double>& values) {
  if (values.size() < 3) return 0;
  const double step = (values.back() - values.front()) / static_cast<double>(values.size() - 1);
  double worst = 0;
  for (std::size_t k = 0; k < values.size(); ++k)
    worst = std::max(worst, std::abs((values[k] - values.front()) / step - static_cast<double>(k)));
  return std::isfinite(worst) ? worst : HUGE_VAL;
}

std::vector<double> to_mercator(std::vector<double> latitudes) {
  for (double& y : latitudes) y = std::asinh(std::tan(y * std::numbers::pi / 180));
  return latitudes;
}

/// GDAL returns the northernmost row first if it assumes even rows. Otherwise, it returns the file's last row first.
std::string place_in_mercator(const Axes1D& axes, bool is_placed, const std::string& path) {
  constexpr double kRadius = 6378137;
  std::vector<double> x = axes.x, y = to_mercator(axes.y);
  for (double& longitude : x) longitude *= std::numbers::pi / 180;
  if (!is_placed || y.front() < y.back()) std::reverse(y.begin(), y.end());
  const double dx = (x.back() - x.front()) / static_cast<double>(x.size() - 1) / 2;
  const double dy = (y.back() - y.front()) / static_cast<double>(y.size() - 1) / 2;
  return io::translate_command(
      fmt::format("-a_srs EPSG:3857 -a_ullr {:.12g} {:.12g} {:.12g} {:.12g}", kRadius * (x.front() - dx),
                  kRadius * (y.front() - dy), kRadius * (x.back() + dx), kRadius * (y.back() + dy)),
      path);
}

}  // namespace

bool is_in_degrees(GDALDatasetH dataset) {
  if (!is_netcdf(dataset)) return false;
  bool has_north = false, has_east = false;
  for (CSLConstList item = GDALGetMetadata(dataset, nullptr); item != nullptr && *item != nullptr; ++item) {
    const std::string_view words(*item);
    const auto at = words.find("#units=degree");
    if (at == std::string_view::npos) continue;
    const std::string_view unit =
        words.substr(words.find('_', at) == std::string_view::npos ? words.size() : words.find('_', at) + 1);
    has_north |= unit == "north" || unit == "N";
    has_east |= unit == "east" || unit == "E";
  }
  return has_north && has_east;
}

Result<void> verify_axes(GDALDatasetH dataset, const std::string& path) {
  const auto axes = is_netcdf(dataset) ? read_axes(dataset) : std::nullopt;
  if (!axes) return {};
  const double across = unevenness(axes->x), down = unevenness(axes->y), worst = std::max(across, down);
  if (worst <= kMostUneven) return {};
  const bool are_degrees = is_in_degrees(dataset);
  std::array<double, 6> gt{};
  const bool is_placed = GDALGetGeoTransform(dataset, gt.data()) == CE_None;
  if (are_degrees && across <= kMostUneven && unevenness(to_mercator(axes->y)) <= kMostUneven) {
    return fail(
        ErrorKind::kInput,
        fmt::format("{}: its rows are even in Mercator, not in latitude, where they lie up to {:.3g} rows off: give it "
                    "that CRS first ({})",
                    path, down, place_in_mercator(*axes, is_placed, path)));
  }
  const char* name = across > down ? (are_degrees ? "longitudes" : "columns") : are_degrees ? "latitudes" : "rows";
  const std::string way =
      are_degrees
          ? fmt::format(" (cdo remapbil,r{:.0f}x{:.0f} {} new.nc)",
                        360 / std::abs((axes->x.back() - axes->x.front()) / static_cast<double>(axes->x.size() - 1)),
                        180 / std::abs((axes->y.back() - axes->y.front()) / static_cast<double>(axes->y.size() - 1)),
                        path)
          : "";
  return fail(
      ErrorKind::kInput,
      fmt::format(
          "{}: its {} are uneven, up to {:.3g} cells beside even ones, and a raster's are not: resample it first{}",
          path, name, worst, way));
}

}  // namespace scarp::gdal
