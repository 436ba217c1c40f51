#include "session/tasks/points_dem.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "scarp/io.h"
#include "scarp/measure.h"
#include "session/text/text.h"

namespace scarp::cli {
namespace {

using enum OptionId;

constexpr double kMostCells = 1 << 30;

/// Cells along an axis that cover its values.
struct Cells {
  double first = 0;  ///< edge, a multiple of the size
  int count = 0;
};

Result<Cells> cells_over(const std::vector<double>& values, double size) {
  const auto [least, most] = std::minmax_element(values.begin(), values.end());
  const double first = std::floor(*least / size), last = std::ceil(*most / size);
  if (!(last - first < kMostCells))
    return fail(ErrorKind::kUsage, fmt::format("{} {:g} gives a raster of {:.3g} columns or rows: choose larger cells",
                                               kCellSize, size, last - first));
  return Cells{first * size, static_cast<int>(std::max(last - first, 2.0))};
}

}  // namespace

Result<void> check_cell_size(const SimplifyPlan& plan, const GivenOptions& given) {
  const bool is_dem = plan.format.kind == OutputKind::kDem;
  if (is_dem == given.has(kCellSize)) return {};
  const std::string input = shell_word(base_name(given.input()));
  return fail(ErrorKind::kUsage,
              is_dem
                  ? fmt::format("{} is a raster, and {} holds points, which lie on no grid: give the size of its "
                                "cells with {}, in the unit of x and y",
                                *given[kOutput], input, kCellSize)
                  : fmt::format("{} is for rasters, and {} holds points: omit it, or choose a raster as OUTPUT, such "
                                "as {}",
                                kCellSize, input, shell_word(base_name(given.input()) + ".tif")));
}

Result<std::vector<std::uint8_t>> encode_points_dem(const SimplifyPlan& plan, const PointsOutcome& outcome) {
  const PointSet& points = outcome.points;
  const double size = *plan.read.cell_size;
  SCARP_TRY(const auto& across, cells_over(points.x, size));
  SCARP_TRY(const auto& down, cells_over(points.y, size));
  if (double{1} * across.count * down.count > kMostCells)
    return fail(ErrorKind::kUsage, fmt::format("{} {:g} gives a raster of {} x {} cells: choose larger ones", kCellSize,
                                               size, across.count, down.count));
  const double north = down.first + down.count * size;
  HeightField field;
  field.cols = across.count;
  field.rows = down.count;
  const std::vector<float> level(static_cast<std::size_t>(field.cols) * static_cast<std::size_t>(field.rows), 0);
  field.samples = level.data();
  field.frame.kind = Frame::Kind::kSource;
  field.frame.affine = {across.first + size / 2, size, 0, north - size / 2, 0, -size};
  SCARP_TRY(const auto& heights, resample(field, outcome.simplified.mesh, plan.simplify.run.threads));
  RasterInfo info = points.heights;
  info.crs = points.crs;
  info.geotransform = {across.first, size, 0, north, 0, -size};
  info.has_georeference = true;
  return encode_raster({heights, field.cols, field.rows, &info}, plan.format.raster);
}

}  // namespace scarp::cli
