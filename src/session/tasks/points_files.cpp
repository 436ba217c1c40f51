#include "session/tasks/points_files.h"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <iterator>
#include <utility>

#include "scarp/io.h"
#include "scarp/picture.h"
#include "session/inputs/mesh_place.h"
#include "session/reports/pictures.h"
#include "session/tasks/mesh_output.h"
#include "session/tasks/points_work.h"
#include "session/tasks/run_files.h"
#include "session/text/text.h"

namespace scarp::cli {
namespace {

using enum OptionId;

constexpr double kMostCells = 1 << 30;

/// Cells along an axis that cover its values.
struct Cells {
  double first = 0;  ///< lower edge, a multiple of the size
  int count = 0;
};

Result<Cells> cells_over(const std::vector<double>& values, double size) {
  const auto [least, most] = std::minmax_element(values.begin(), values.end());
  const double first = std::floor(*least / size), last = std::ceil(*most / size);
  if (!(last - first < kMostCells))
    return fail(ErrorKind::kUsage,
                fmt::format("cells of {:g} give a raster of {:.3g} columns or rows: choose larger ones with {}", size,
                            last - first, kCellSize));
  return Cells{first * size, static_cast<int>(std::max(last - first, 2.0))};
}

/// Sets the place of a raster by its north-western corner and cell size, in coordinates of the points.
void place_in_file(const PointSet& points, const std::array<double, 2>& corner, const std::array<double, 2>& cell,
                   RasterInfo& info) {
  const auto& [west, east_by_x, unused, south, unused_too, north_by_y] = points.to_source;
  info.crs = points.is_local ? points.source_crs : points.crs;
  info.geotransform = {west + east_by_x * corner[0], east_by_x * cell[0], 0, south + north_by_y * corner[1], 0,
                       -north_by_y * cell[1]};
  info.has_georeference = true;
}

/// The mean distance of neighbouring points, rounded down to 1, 2 or 5 times a power of 10.
double find_cell_size(const PointsOutcome& outcome) {
  const Mesh& mesh = outcome.simplified.mesh;
  double area = 0;
  for (std::size_t t = 0; t < mesh.triangle_count(); ++t) {
    const auto a = mesh.vertex(mesh.triangles[3 * t]), b = mesh.vertex(mesh.triangles[3 * t + 1]),
               c = mesh.vertex(mesh.triangles[3 * t + 2]);
    area += std::abs((b[0] - a[0]) * (c[1] - a[1]) - (b[1] - a[1]) * (c[0] - a[0])) / 2;
  }
  const Extent extent = extent_of(outcome.points);
  const double length = std::hypot(extent.high[0] - extent.low[0], extent.high[1] - extent.low[1]);
  const auto count = static_cast<double>(outcome.count());
  const double distance = std::max(std::sqrt(area / count), length / count);  // points may follow a line
  const double power = std::pow(10, std::floor(std::log10(distance)));
  return power * (distance >= 5 * power ? 5 : distance >= 2 * power ? 2 : 1);
}

/// The mesh's heights at the centres of cells, whose corners are multiples of `size`; NaN outside the mesh. REQUIRES:
/// the mesh is where the points are. Fails with kUsage for more cells than a raster may have.
Result<OwnedHeightField> draw_raster(const PointsOutcome& outcome, double size, int threads) {
  const PointSet& points = outcome.points;
  SCARP_TRY(const auto& across, cells_over(points.x, size));
  SCARP_TRY(const auto& down, cells_over(points.y, size));
  if (double{1} * across.count * down.count > kMostCells)
    return fail(ErrorKind::kUsage,
                fmt::format("cells of {:g} give a raster of {} x {} cells: choose larger ones with {}", size,
                            across.count, down.count, kCellSize));
  const double north = down.first + down.count * size;
  OwnedHeightField field;
  field.cols = across.count;
  field.rows = down.count;
  field.samples.resize(static_cast<std::size_t>(field.cols) * static_cast<std::size_t>(field.rows));
  field.frame.kind = Frame::Kind::kSource;
  field.frame.affine = {across.first + size / 2, size, 0, north - size / 2, 0, -size};
  field.info = points.heights;
  place_in_file(points, {across.first, north}, {size, size}, field.info);
  SCARP_TRY(field.samples, resample(field, outcome.simplified.mesh, threads));
  return field;
}

Result<void> add_preview(const SimplifyPlan& plan, const PointsOutcome& outcome, std::vector<ReadyFile>& files) {
  constexpr double kPixels = 1400;
  const PointSet& points = outcome.points;
  const Extent extent = extent_of(points);
  const double size = std::max(extent.high[0] - extent.low[0], extent.high[1] - extent.low[1]) / (kPixels - 2);
  SCARP_TRY(const auto& field, draw_raster(outcome, size, plan.simplify.run.threads));
  PreviewOptions options{static_cast<int>(kPixels), {}, short_unit(points.heights.unit), {}};
  options.cell.fill(size * points.unit_in_metres);
  const auto mark = [&](MarkKind kind, const std::vector<std::uint32_t>& along) {
    Mark& added = options.marks.emplace_back(Mark{kind, {}});
    for (const std::uint32_t i : along)
      added.points.push_back(
          {(points.x[i] - field.frame.affine[0]) / size, (field.frame.affine[3] - points.y[i]) / size});
  };
  for (const PointLine& line : points.lines) mark(MarkKind::kBreakline, line.points);
  for (std::vector<std::uint32_t> ring : points.boundary) {
    ring.push_back(ring.front());
    mark(MarkKind::kCutline, ring);
  }
  SCARP_TRY(const Picture& picture, draw_preview(field, outcome.simplified.mesh, options));
  return add_picture(*plan.preview, picture, files);
}

Result<void> add_errors(const SimplifyPlan& plan, const Runner& runner, const PointsOutcome& outcome,
                        std::vector<ReadyFile>& files) {
  ReadyFile file{*plan.error_raster, "csv", {}};
  MeasureOptions options;
  options.topology = false;
  options.run.threads = plan.simplify.run.threads;
  options.run.progress = runner.progress;
  collect_errors(outcome.points, file.bytes, options);
  SCARP_RETURN_IF_ERROR(measure_points(outcome.points, outcome.simplified.mesh, outcome.policy, options));
  files.push_back(std::move(file));
  return {};
}

Result<void> read_draped_image(const SimplifyPlan& plan, const Runner& runner, PointsOutcome& outcome) {
  if (!plan.images.drape) return {};
  const PointSet& points = outcome.points;
  const Extent extent = extent_of(points);
  RasterInfo info;  // one cell over all points
  info.path = points.path;
  place_in_file(points, {extent.low[0], extent.high[1]},
                {extent.high[0] - extent.low[0], extent.high[1] - extent.low[1]}, info);
  Run run;
  run.progress = runner.progress;
  SCARP_TRY(Drape drape, read_drape(*plan.images.drape, info, 1, 1, plan.images.drape_size, run));
  outcome.drape = std::move(drape.picture);
  std::move(drape.warnings.begin(), drape.warnings.end(), std::back_inserter(outcome.warnings));
  return {};
}

Result<void> encode_output(const SimplifyPlan& plan, const PointsOutcome& outcome, ReadyFile& file) {
  GlbOptions glb{.compress = plan.compress, .threads = plan.simplify.run.threads};
  SCARP_RETURN_IF_ERROR(add_drape(plan, outcome.drape, glb));
  SCARP_TRY(file.bytes, outcome.print
                            ? encode_3mf(named_solids(plan, outcome))
                            : encode_as(plan.format, outcome.simplified.mesh, glb, {.double_positions = plan.doubles}));
  return {};
}

}  // namespace

Result<void> check_cell_size(const SimplifyPlan& plan, const GivenOptions& given) {
  if (plan.format.kind == OutputKind::kDem || !given.has(kCellSize)) return {};
  return fail(
      ErrorKind::kUsage,
      fmt::format("{} is for rasters, and {} holds points: omit it, or choose a raster as OUTPUT, such as {}",
                  kCellSize, shell_word(base_name(given.input())), shell_word(base_name(given.input()) + ".tif")));
}

Result<OwnedHeightField> draw_surface(const SimplifyPlan& plan, PointsOutcome& outcome) {
  const double size = plan.read.cell_size ? *plan.read.cell_size : find_cell_size(outcome);
  outcome.cell_size = size;
  SCARP_TRY(OwnedHeightField field, draw_raster(outcome, size, plan.simplify.run.threads));
  const bool is_empty = std::all_of(field.samples.begin(), field.samples.end(), [](float z) { return std::isnan(z); });
  if (is_empty)
    return fail(ErrorKind::kUsage,
                fmt::format("no cell of {:g} has its centre on the surface through the points: choose "
                            "smaller ones with {}",
                            size, kCellSize));
  return field;
}

void collect_errors(const PointSet& points, std::vector<std::uint8_t>& file, MeasureOptions& options) {
  options.on_row = [&](int, std::span<const float> errors) {
    std::string text = "x,y,z,error\n";
    for (std::size_t i = 0; i < errors.size(); ++i) {
      const auto [x, y] = points.place_in_file(i);
      fmt::format_to(std::back_inserter(text), "{},{},{},", x, y, points.z[i]);
      if (!std::isnan(errors[i])) fmt::format_to(std::back_inserter(text), "{}", errors[i]);
      text += '\n';
    }
    file.assign(text.begin(), text.end());
  };
}

Result<std::vector<ReadyFile>> encode_files(const SimplifyPlan& plan, const Runner& runner, PointsOutcome& outcome) {
  std::vector<ReadyFile> files{{plan.output, plan.format.name(), {}}};
  Result<void> added = read_draped_image(plan, runner, outcome);
  if (added && plan.preview) added = add_preview(plan, outcome, files);
  if (added && plan.error_raster) added = add_errors(plan, runner, outcome, files);
  SCARP_RETURN_IF_ERROR(added);
  if (plan.format.kind == OutputKind::kDem) {
    SCARP_TRY(const auto& field, draw_surface(plan, outcome));
    SCARP_TRY(files.front().bytes,
              encode_raster({field.samples, field.cols, field.rows, &field.info}, plan.format.raster));
  }
  SCARP_RETURN_IF_ERROR(complete_mesh(plan, outcome));
  if (plan.given.has(kContoursOut)) {
    SCARP_RETURN_IF_ERROR(add_contours(plan, outcome, outcome.centre ? "" : outcome.points.crs, files));
  }
  turn_as_planned(plan, outcome.simplified.mesh);
  if (outcome.print && plan.format.mesh != MeshFormat::k3mf) {
    SCARP_RETURN_IF_ERROR(encode_print_tiles(plan, outcome, files));
  } else if (plan.format.kind != OutputKind::kDem) {
    SCARP_RETURN_IF_ERROR(encode_output(plan, outcome, files.front()));
  }
  const auto encode = [&](ReadyFile& file) -> Result<void> {
    place_mesh(plan, outcome);
    turn_as_planned(plan, outcome.simplified.mesh);
    return encode_output(plan, outcome, file);
  };
  SCARP_RETURN_IF_ERROR(finish_files(plan, encode, nullptr, outcome, files));
  return files;
}

}  // namespace scarp::cli
