// Compares the grids of two rasters.
#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "io/raster/raster_source.h"
#include "scarp/io.h"

namespace scarp {
namespace {

/// Corners closer than this, in cells, are equal: the distance is below any effect of resampling.
constexpr double kNearCorner = 0.01;

struct Corner {
  double x = 0, y = 0;
};

Corner corner_of(const RasterInfo& info, double col, double row) {
  const auto& gt = info.geotransform;
  return {gt[0] + gt[1] * col + gt[2] * row, gt[3] + gt[4] * col + gt[5] * row};
}

/// "EPSG:4326", or the name in the WKT: short enough for a sentence.
std::string short_name(const std::string& crs) {
  const std::size_t first = crs.find('"'), second = crs.find('"', first + 1);
  if (second == std::string::npos) return crs;
  return crs.substr(first + 1, second - first - 1);
}

}  // namespace

std::optional<std::string> find_grid_difference(const RasterInfo& raster, int cols, int rows, const RasterInfo& other,
                                                int other_cols, int other_rows) {
  if (other_cols != cols || other_rows != rows) {
    return fmt::format("is {} x {} samples instead of {} x {}", other_cols, other_rows, cols, rows);
  }
  if (!raster.has_georeference || !other.has_georeference) return {};
  if (!raster.crs.empty() && !other.crs.empty() && !io::is_same_crs(raster.crs, other.crs)) {
    const std::string wanted = short_name(raster.crs), found = short_name(other.crs);
    return found == wanted ? fmt::format("is in another CRS that is also called {}", found)
                           : fmt::format("is in {} instead of {}", found, wanted);
  }
  const double width = std::hypot(raster.geotransform[1], raster.geotransform[4]);
  const double height = std::hypot(raster.geotransform[2], raster.geotransform[5]);
  const double allowed = kNearCorner * std::min(width, height);
  const auto is_apart = [&](double col, double row) {
    const Corner a = corner_of(raster, col, row), b = corner_of(other, col, row);
    return !(std::hypot(a.x - b.x, a.y - b.y) <= allowed);
  };
  const auto differ = [&](const char* verb, double col, double row) {
    const Corner a = corner_of(raster, col, row), b = corner_of(other, col, row);
    return fmt::format("{} at {}, {} instead of {}, {}", verb, b.x, b.y, a.x, a.y);
  };
  if (is_apart(0, 0)) return differ("begins", 0, 0);
  if (is_apart(cols, rows)) return differ("ends", cols, rows);
  if (is_apart(cols, 0)) return differ("has its first row end", cols, 0);
  return {};
}

}  // namespace scarp
