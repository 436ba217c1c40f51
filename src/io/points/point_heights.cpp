#include "io/points/point_heights.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <vector>

#include "grid/keep_points.h"
#include "io/commands.h"
#include "io/points/point_source.h"

namespace scarp::io {
namespace {

double middle_of_axis(const std::vector<double>& values) {
  const auto [least, most] = std::minmax_element(values.begin(), values.end());
  return *least + (*most - *least) / 2;
}

}  // namespace

std::array<double, 2> middle_of(const PointSet& points) { return {middle_of_axis(points.x), middle_of_axis(points.y)}; }

Result<void> leave_out_nodata(double nodata, PointSet& points) {
  if (!points.lines.empty())
    return fail(ErrorKind::kUsage,
                points.path + ": nodata cannot be combined with lines: leave their points out first");
  const std::size_t given = points.size();
  grid::keep_points(points, [&](std::size_t i) { return std::isfinite(points.z[i]) && points.z[i] != nodata; });
  points.without_height = given - points.size();
  if (points.size() > 0) return {};
  return refuse_no_heights(points);
}

tl::unexpected<Error> refuse_no_heights(const PointSet& points) {
  return fail(ErrorKind::kInput, points.path + ": no point has a height other than that of --nodata");
}

tl::unexpected<Error> refuse_empty_extent(const PointSet& points) {
  return fail(ErrorKind::kInput, fmt::format("{}: none of its {} points lies in the rectangle of --te, which is in the "
                                             "coordinates of the file",
                                             points.path, points.outside));
}

Result<void> crop(const ReadPointsOptions& options, PointSet& points) {
  if (!options.extent) return {};
  if (!points.lines.empty())
    return fail(ErrorKind::kUsage,
                points.path + ": --te cannot be combined with lines: cut them to a boundary instead");
  const std::array<double, 4>& box = *options.extent;
  const std::size_t given = points.size();
  grid::keep_points(points, [&](std::size_t i) {
    return points.x[i] >= box[0] && points.x[i] <= box[2] && points.y[i] >= box[1] && points.y[i] <= box[3];
  });
  points.outside = given - points.size();
  if (points.size() == 0) return refuse_empty_extent(points);
  return {};
}

bool becomes_local(const ReadPointsOptions& options, double unit_in_metres) {
  return options.crs.empty() && options.default_frame == DefaultFrame::kLocal && unit_in_metres != 0 &&
         unit_in_metres != 1;
}

void make_local_metres(const std::array<double, 2>& metres, const std::string& whose, PointSet& points) {
  const auto [x, y] = middle_of(points);
  for (double& value : points.x) value = (value - x) * metres[0];
  for (double& value : points.y) value = (value - y) * metres[1];
  points.description = fmt::format("local metres east and north of {:.9g}, {:.9g} ({})", x, y, whose);
  points.source_crs = std::exchange(points.crs, "");
  points.to_source = {x, 1 / metres[0], 0, y, 0, 1 / metres[1]};
  points.is_local = true;
  points.unit_in_metres = 1;
}

std::string crs_command(const PointSet& points, const std::string& crs) {
  const std::string file = file_word(points.path);
  if (points.las) return fmt::format("pdal translate {} {} --writers.las.a_srs={}", file, new_file(".laz"), crs);
  if (is_text_of_columns(points.path)) return declare_crs_command(points.path, crs);
  return fmt::format("ogr2ogr -a_srs {} {} {}", crs, new_file(".gpkg"), file);
}

Result<void> place_without_crs(const ReadPointsOptions& options, PointSet& points) {
  const bool is_local = options.crs == "local";
  if ((is_local && points.unit_in_metres == 0) || (!is_local && !options.crs.empty() && options.crs != "source"))
    return fail(ErrorKind::kUsage,
                fmt::format("{} does not declare its CRS, so its coordinates cannot be given in '{}': ask for "
                            "'source', or declare it in a file next to it ({})",
                            points.path, options.crs, declare_crs_command(points.path, "EPSG:CODE")));
  points.description = "the points' own coordinates (no CRS)";
  if (is_local || becomes_local(options, points.unit_in_metres))
    make_local_metres({points.unit_in_metres, points.unit_in_metres}, "the points' own coordinates", points);
  return {};
}

Result<void> settle_point_heights(const ReadPointsOptions& options, const HeightUnit& vertical, PointSet& points) {
  RasterInfo& info = points.heights;
  info.path = points.path;
  ReadOptions wanted;
  wanted.z_scale = options.z_scale;
  wanted.z_offset = options.z_offset;
  wanted.z_unit = options.z_unit;
  wanted.heights_in = options.heights_in;
  Frame frame;
  const bool is_moved = options.crs.empty() && options.default_frame == DefaultFrame::kLocal;
  const bool is_projected = !points.is_local && !options.crs.empty() && options.crs != "source";
  frame.kind = points.is_local || is_moved ? Frame::Kind::kLocal
               : is_projected              ? Frame::Kind::kProjected
                                           : Frame::Kind::kSource;
  frame.unit_in_metres = points.unit_in_metres;
  SCARP_TRY(const auto& settled, settle_heights(wanted, frame, info, vertical));
  if (options.heights_in != HeightsIn::kMetres) warn_of_units(frame, info);
  if (settled.z_scale != 1 || settled.z_offset != 0) {
    for (double& z : points.z) z = settled.z_scale * z + settled.z_offset;
  }
  points.warnings.insert(points.warnings.end(), info.warnings.begin(), info.warnings.end());
  if (settled.z_scale != options.z_scale && points.unit_in_metres == 0 && points.crs.empty())
    points.warnings.push_back(fmt::format(
        "x and y have no CRS and stay as they are, while heights become metres: give the points their CRS first ({})",
        crs_command(points, "EPSG:CODE")));
  return {};
}

}  // namespace scarp::io
