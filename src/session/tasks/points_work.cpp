#include "session/tasks/points_work.h"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <limits>
#include <utility>
#include <vector>

#include "scarp/point_blocks.h"
#include "scarp/points.h"
#include "session/inputs/memory.h"
#include "session/inputs/mesh_place.h"
#include "session/inputs/point_features.h"
#include "session/options/error_goal.h"
#include "session/options/memory_options.h"
#include "session/options/option_rules.h"
#include "session/options/raster_options.h"
#include "session/options/region_options.h"
#include "session/reports/shape_report.h"
#include "session/table/option_table.h"
#include "session/tasks/measure_work.h"
#include "session/tasks/mesh_output.h"
#include "session/tasks/points_files.h"
#include "session/tasks/with_level.h"
#include "session/text/clock.h"
#include "session/text/json_text.h"
#include "session/text/text.h"

namespace scarp::cli {
namespace {

using enum OptionId;

/// An option that a mesh file stores for its judge.
struct Remembered {
  OptionId option;
  const char* key;             ///< in the metadata
  bool is_of_content = false;  ///< depends on the kind of the file of points
};
constexpr Remembered kRemembered[] = {
    {kDuplicates, "duplicates"}, {kDespike, "despike"},       {kBoundary, "boundary"}, {kLayer, "layer", true},
    {kZField, "z_field", true},  {kColumns, "columns", true}, {kClass, "class", true}, {kReturns, "returns", true}};

/// `as`: options for reading a raster.
Result<PointSet> read(const GivenOptions& given, const ReadOptions& as, const ProgressCallback& progress) {
  SCARP_TRY(auto&& options, parse_points(given, as));
  options.progress = progress;
  SCARP_TRY(PointSet points, read_inputs(given, options));
  sort_points(points);
  SCARP_TRY(const auto& despike, given.number(kDespike));
  SCARP_TRY(const int threads, given.threads());
  if (despike) drop_spikes(*despike, threads, points);
  if (points.size() == 0)
    return fail(
        ErrorKind::kInput,
        fmt::format("{}: {} {} omits all {} points: each differs by more from its neighbours; choose a larger one",
                    points.path, kDespike, *given[kDespike], points.spikes));
  return points;
}

/// Sorts the points into blocks on disk. `limit`: of the memory.
Result<SpooledPoints> read_in_parts(const GivenOptions& given, const ReadOptions& as, DuplicatePolicy policy,
                                    std::uint64_t limit, const ProgressCallback& progress) {
  constexpr std::uint64_t kBytesPerPoint = 120, kFewest = 1 << 15, kMost = 1 << 20;
  SCARP_TRY(auto&& options, parse_points(given, as));
  options.progress = progress;
  const std::uint64_t most = std::clamp((limit - kProgramBytes) / 4 / kBytesPerPoint, kFewest, kMost);
  auto spooled = spool_points(given.inputs(), options, policy, most);
  if (!spooled) return tl::unexpected(name_limit(given, std::move(spooled.error())));
  name_others(given.inputs().size(), spooled->facts);
  return spooled;
}

/// The value of --crs; empty: local for degrees, else the points' own.
std::string crs_option(const SimplifyPlan& plan) {
  if (!plan.read.crs.empty()) return plan.read.crs;
  return plan.read.default_frame == DefaultFrame::kSource ? "source" : "";
}

/// Adds texture coordinates of an image over the extent, from its top left corner.
void add_uvs(const Extent& extent, Mesh& mesh) {
  mesh.uvs.clear();
  for (std::size_t v = 0; v < mesh.vertex_count(); ++v) {
    const auto p = mesh.vertex(v);
    mesh.uvs.push_back(static_cast<float>((p[0] - extent.low[0]) / (extent.high[0] - extent.low[0])));
    mesh.uvs.push_back(static_cast<float>((extent.high[1] - p[1]) / (extent.high[1] - extent.low[1])));
  }
}

void move(double sign, const std::array<double, 2>& way, Mesh& mesh) {
  for (std::size_t k = 0; k < 2; ++k) mesh.origin[k] += sign * way[k];
}

/// The offset of a mesh from the source's coordinates, if its metadata hold one and no other change.
std::optional<std::array<double, 2>> way_to_source(const Mesh& mesh) {
  const auto said = mesh.metadata.find("to_source");
  if (said == mesh.metadata.end()) return std::nullopt;
  const Json affine = Json::parse(said->second, nullptr, false);
  if (!affine.is_array() || affine.size() != 6 || !affine[0].is_number() || !affine[3].is_number()) return std::nullopt;
  if (affine[1] != 1 || affine[2] != 0 || affine[4] != 0 || affine[5] != 1) return std::nullopt;
  return std::array{affine[0].get<double>(), affine[3].get<double>()};
}

/// Options for reading the points, by the mesh's metadata, unless `given` sets them.
Result<ReadOptions> remember_reading(const GivenOptions& given, const Mesh& mesh, const std::string& path) {
  const auto find = [&](const char* key) {
    const auto entry = mesh.metadata.find(key);
    return entry == mesh.metadata.end() ? Given() : Given(entry->second);
  };
  GivenOptions asked = find("duplicates") ? remember_options(given, mesh) : given;  // a raster's own scale
  asked.set(kCellSize, given[kCellSize]);
  if (!given.has(kCrs)) asked.set(kCrs, find("crs_option"));
  if (!given.has(kCrs) && asked[kCrs] == "local" && way_to_source(mesh)) asked.set(kCrs, "source");
  if (!given.has(kNodata)) asked.set(kNodata, find("nodata"));
  SCARP_TRY(auto&& options, parse_reading(asked));
  const Json extent = Json::parse(find("te").value_or("null"), nullptr, false);
  if (!options.view.extent && extent.is_array() && extent.size() == 4 &&
      std::all_of(extent.begin(), extent.end(), [](const Json& side) { return side.is_number(); }))
    options.view.extent = extent.get<std::array<double, 4>>();
  options.heights_in = find("unit") == Given("m") ? HeightsIn::kMetres : heights_in(path);
  options.default_frame = default_frame(path) == DefaultFrame::kLocal ? DefaultFrame::kLocal : DefaultFrame::kMetric;
  return options;
}

/// Moves a mesh from a local frame back to the points: by its metadata or, in a format that cannot hold metadata, if
/// mesh and points would not meet otherwise.
void put_back(const PointSet& points, Mesh& mesh) {
  if (const auto way = way_to_source(mesh)) return move(1, *way, mesh);
  if (points.is_local || mesh.metadata.contains("frame")) return;
  Mesh moved = mesh;
  move(1, local_origin(points), moved);
  const Extent extent = extent_of(points);
  if (extent.overlap(extent_of(moved)) > extent.overlap(extent_of(mesh))) mesh.origin = moved.origin;
}

void add_metadata(const SimplifyPlan& plan, PointsOutcome& outcome) {
  Mesh& mesh = outcome.simplified.mesh;
  // The judge moves the mesh back and reads the points in their own coordinates.
  add_origin(plan.canonical_command, outcome.frame(), outcome.centre ? "" : outcome.points.crs,
             outcome.centre ? "source" : crs_option(plan), mesh);
  if (outcome.centre) {
    const auto [x, y] = *outcome.centre;
    mesh.metadata["origin"] = Json(*outcome.centre).dump();
    if (!outcome.points.crs.empty()) mesh.metadata["origin_crs"] = outcome.points.crs;
    mesh.metadata["to_source"] = Json(std::array<double, 6>{x, 1, 0, y, 0, 1}).dump();
  } else if (outcome.points.is_local) {
    mesh.metadata["origin"] = Json{outcome.points.to_source[0], outcome.points.to_source[3]}.dump();
    mesh.metadata["to_source"] = Json(outcome.points.to_source).dump();
    if (!outcome.points.source_crs.empty()) mesh.metadata["origin_crs"] = outcome.points.source_crs;
  }
  mesh.metadata["duplicates"] = policy_name(outcome.policy);
  for (const Remembered& of : kRemembered) {
    if (plan.given.has(of.option)) mesh.metadata[of.key] = *plan.given[of.option];
  }
  if (plan.given.has(kWater)) mesh.metadata["water"] = Json(plan.given.all(kWater)).dump();
  if (plan.read.view.extent) mesh.metadata["te"] = Json(*plan.read.view.extent).dump();
  if (plan.read.nodata) mesh.metadata["nodata"] = fmt::format("{}", *plan.read.nodata);
  const RasterInfo& heights = outcome.points.heights;
  if (heights.z_scale != 1) mesh.metadata["z_scale"] = Json(heights.z_scale).dump();
  if (heights.z_offset != 0) mesh.metadata["z_offset"] = Json(heights.z_offset).dump();
  if (!heights.unit.empty()) mesh.metadata["unit"] = heights.unit;
  const Measurement& measured = outcome.simplified.measurement;
  const Json error{{"asked", or_null(outcome.asked)},
                   {"max_error", outcome.print ? outcome.print->max_error : measured.max_error},
                   {"rmse", measured.rmse},
                   {"samples", measured.samples}};
  mesh.metadata["error"] = error.dump();
}

/// The error for a frame that the mesh file names and the points cannot have.
Error explain_frame(Error error, const std::string& crs, const std::string& mesh, const std::string& path) {
  if (error.kind != ErrorKind::kUsage || error.message.find(crs) == std::string::npos) return error;
  if (crs != "grid") {
    error.message += fmt::format("; {} names that CRS as its own, {} overrides it", mesh, kCrs);
    return error;
  }
  error.message = fmt::format(
      "{} says of itself that its coordinates are the columns and rows of a raster ('grid'), which the points of {} do "
      "not have: judge it by its raster, or give {} source if x and y of the points count the same",
      mesh, path, kCrs);
  return error;
}

/// Adds the path to the library's errors about points, which lack it, and the option to those about memory.
Error with_path(const GivenOptions& given, Error error) {
  const std::string& path = given.input();
  error = name_limit(given, std::move(error));
  if (error.kind == ErrorKind::kInput && !error.message.starts_with(path))
    error.message = fmt::format("{}: {}", path, error.message);
  return error;
}

/// The engine proves its own result; a mesh whose proof does not hold is never written.
Result<void> check_promise(const PointsOutcome& outcome) {
  const bool has_bound = outcome.simplified.stop == StopReason::kMaxError;
  const auto broken = find_broken(outcome.points, outcome.simplified.measurement,
                                  has_bound ? *outcome.asked : outcome.simplified.measurement.max_error);
  if (!broken) return {};
  return fail(ErrorKind::kPromise,
              "the mesh does not keep its promise and was not written; this is a bug in Scarp: " + *broken);
}

/// Half the requested max error or, with a budget, a fraction of the relief.
double tolerance_along_boundary(const SimplifyPlan& plan, const PointSet& points) {
  constexpr double kShareOfRelief = 1.0 / 400;
  const HeightRange heights = height_range(points);
  const double relief = heights.max - heights.min;
  return plan.error_goal ? plan.error_goal->absolute(relief) / 2 : kShareOfRelief * relief;
}

/// Simplifies all points of the outcome, which then has those that the run used.
Result<SimplifiedPoints> make_from_blocks(const PointOptions& options, PointsOutcome& outcome) {
  SCARP_TRY(auto&& simplified, simplify_points(*outcome.blocks, options));
  outcome.points.x = std::move(simplified.kept.x);
  outcome.points.y = std::move(simplified.kept.y);
  outcome.points.z = std::move(simplified.kept.z);
  simplified.made.duplicates = outcome.duplicates;
  return std::move(simplified.made);
}

Result<SimplifiedPoints> make_level(const PointOptions& options, bool has_normals, PointsOutcome& outcome) {
  SCARP_TRY(auto&& made,
            outcome.blocks ? make_from_blocks(options, outcome) : simplify_points(outcome.points, options));
  if (has_normals) {
    SCARP_TRY(made.simplified.mesh.normals, point_normals(outcome.points, made.simplified.mesh, options.duplicates));
  }
  return std::move(made);
}

Result<SimplifiedPoints> make_print(const SimplifyPlan& plan, const PointOptions& options, PointsOutcome& outcome) {
  auto printed = simplify_for_print(outcome.points, *plan.solid, options);
  if (!printed) return tl::unexpected(name_print(std::move(printed.error())));
  take_print(plan, std::move(printed->print), outcome);
  return std::move(printed->made);
}

/// Judges the mesh at all blocks; the worst point becomes the last of `judged.points`.
Result<Measurement> measure_blocks(const MeasureOptions& options, JudgedPoints& judged) {
  SCARP_TRY(auto&& made, measure_points(*judged.blocks, judged.mesh, options));
  if (made.worst.size() > 0) {
    made.measured.max_error_at = {static_cast<std::int32_t>(judged.points.size()), 0};
    for (const auto& [values, worst] :
         {std::pair{&judged.points.x, &made.worst.x}, std::pair{&judged.points.y, &made.worst.y},
          std::pair{&judged.points.z, &made.worst.z}})
      values->push_back(worst->front());
  }
  return std::move(made.measured);
}

/// For points, --cutline is another name for --boundary.
Result<GivenOptions> boundary_of_cutline(const GivenOptions& given) {
  if (!given.has(kCutline)) return given;
  const std::vector<std::string> files = given.all(kCutline);
  if (given.has(kBoundary))
    return fail(ErrorKind::kUsage,
                fmt::format("{} and {} both end the surface of points: give one of them", kCutline, kBoundary));
  if (files.size() > 1)
    return fail(ErrorKind::kUsage,
                fmt::format("{} of points takes one file, and {} are given: join them first", kCutline, files.size()));
  if (const std::string& file = files.front(); file.find('.') == std::string::npos || file.starts_with("concave:"))
    return fail(ErrorKind::kUsage,
                fmt::format("{} {} is no file of polygons, such as site.geojson; {} takes other ends "
                            "of the surface, too",
                            kCutline, shell_word(file), kBoundary));
  GivenOptions asked = given;
  asked.set(kBoundary, Given(files.front()));
  asked.set(kCutline, GivenOptions::Texts());
  return asked;
}

/// The given option that bounds the surface, for messages.
OptionId end_option(const GivenOptions& stated) { return stated.has(kCutline) ? kCutline : kBoundary; }

/// Warns where the convex hull bridges bays or has slivers.
void suggest_boundary(const HullFit& fit, PointsOutcome& outcome) {
  if (fit.boundary_length == 0) return;
  outcome.suggested_boundary = fmt::format("concave:{:.6g}", fit.boundary_length);
  outcome.warnings.push_back(fmt::format(
      "{}: {} {} ends the mesh at the points instead ({} hull: no warning)",
      fit.slivers == 0
          ? fmt::format("{} of the mesh lies across bays of the convex hull, where no points are",
                        format_share(fit.bridged, 1))
          : fmt::format("the points end along nearly straight lines, where the convex hull makes {} steeper "
                        "than 80 degrees",
                        format_plural(fit.slivers, "sliver")),
      kBoundary, outcome.suggested_boundary, kBoundary));
}

}  // namespace

Result<void> make_points_mesh(const GivenOptions& stated, const Runner& runner, SimplifyPlan& plan,
                              PointsOutcome& outcome) {
  const Clock::time_point start = Clock::now();
  SCARP_TRY(const auto& given, boundary_of_cutline(stated));
  if (const auto bounds = find_tolerance(given); bounds && !given[kMaxError])
    return fail(ErrorKind::kUsage, fmt::format("{} of points needs {}, the error of all others", *bounds, kMaxError));
  if (!given.first_of({kMaxError, kMaxTriangles, kMaxPoints}))
    return fail(ErrorKind::kUsage,
                "no goal is given: say how good the mesh must be, such as -e 1 for heights within 1 unit, or how small "
                "with -t or -p");
  SCARP_TRY(plan, plan_simplify(given, given.files_read()));
  if (runner.on_plan) runner.on_plan(plan.read);
  SCARP_RETURN_IF_ERROR(check_cell_size(plan, given));
  SCARP_TRY(const auto& policy, parse_policy(given));
  SCARP_TRY(const auto& boundary, parse_boundary(given));

  outcome.policy = policy;
  outcome.boundary = given[kBoundary].value_or("hull");
  ReadOptions as = plan.read;
  as.crs = crs_option(plan);
  PointSet points;
  if (plan.memory) {
    SCARP_TRY(auto&& spooled, read_in_parts(given, as, policy, *plan.memory, runner.progress));
    points = std::move(spooled.facts);
    outcome.blocks = std::move(spooled.blocks);
    outcome.duplicates = spooled.duplicates;
  } else {
    SCARP_TRY(points, read(given, as, runner.progress));
  }
  if (points.is_local && plan.read.crs.empty()) plan.read.crs = "local";
  SCARP_RETURN_IF_ERROR(check_unit_of_frame(plan.format, points.unit_in_metres));
  SCARP_RETURN_IF_ERROR(add_breaklines(given, policy, runner.progress, points));
  SCARP_TRY(outcome.lakes, add_lakes(given, policy, runner.progress, points));
  if (plan.error_goal) {
    SCARP_RETURN_IF_ERROR(settle_goal(kMaxError, points.heights, *plan.error_goal, points.warnings));
  }
  SCARP_TRY(outcome.cut, cut_to_boundary(given, end_option(stated), policy, tolerance_along_boundary(plan, points),
                                         runner.progress, points));
  outcome.points = std::move(points);
  if (!outcome.points.lines.empty() && boundary.length) {
    const auto option = given.first_of({kWater, kBreaklines});
    const std::string lines = option ? std::string(name_of(*option))
                                     : fmt::format("lines, and {} holds them", shell_word(base_name(given.input())));
    return fail(ErrorKind::kUsage,
                fmt::format("{} {} cannot be combined with {}: it may take away what lines cross; leave it out",
                            kBoundary, *given[kBoundary], lines));
  }
  SCARP_RETURN_IF_ERROR(check_crs_of(plan.format, outcome.points.crs, outcome.points.heights.unit));
  const bool is_placed = plan.solid && plan.solid->is_placed();  // a print has an origin of its own
  if (plan.read.crs.empty() && plan.read.default_frame == DefaultFrame::kLocal && !outcome.points.is_local &&
      !is_placed)
    outcome.centre = local_origin(outcome.points);
  SCARP_TRY(outcome.projections, plan_projection_files(plan, outcome.points.crs));
  const HeightRange heights = height_range(outcome.points);
  if (plan.error_goal) outcome.asked = plan.error_goal->absolute(heights.max - heights.min);
  if (plan.error_goal && plan.error_goal->is_on_print) {
    SCARP_TRY(const double scale, estimate_print_scale(outcome.points, *plan.solid));
    outcome.asked = plan.error_goal->value / scale;
  }
  std::vector<float> tolerances;
  if (outcome.asked) {
    SCARP_TRY(tolerances, read_tolerances(given, *outcome.asked, runner.progress, outcome.points));
    outcome.with_tolerance = static_cast<std::uint64_t>(std::count_if(
        tolerances.begin(), tolerances.end(), [&](float bound) { return double{bound} < *outcome.asked; }));
  }
  outcome.warnings = plan.warnings;
  outcome.warnings.insert(outcome.warnings.end(), outcome.points.warnings.begin(), outcome.points.warnings.end());
  outcome.seconds_read = seconds_since(start);

  PointOptions options;
  options.max_error = outcome.asked;
  options.max_triangles = plan.simplify.goals.max_triangles;
  options.max_vertices = plan.simplify.goals.max_vertices;
  options.objective = plan.simplify.goals.objective;
  options.float32_positions = plan.format.is_float32();  // float32 does not hold the places of points exactly
  options.duplicates = outcome.policy;
  options.boundary_length = boundary.length;
  options.quality = plan.simplify.quality;
  options.tolerances = tolerances;
  options.run.is_time_up = plan.simplify.run.is_time_up;
  options.run.threads = plan.simplify.run.threads;
  options.run.progress = runner.progress;
  if (plan.memory) options.run.memory = {.limit = *plan.memory, .taken = kProgramBytes};
  const bool has_normals = plan.simplify.output.normals;
  Result<SimplifiedPoints> simplified =
      plan.solid ? make_print(plan, options, outcome) : make_level(options, has_normals, outcome);
  if (!simplified) return tl::unexpected(with_path(given, std::move(simplified.error())));
  outcome.simplified = std::move(simplified->simplified);
  outcome.duplicates = simplified->duplicates;
  outcome.on_hull = simplified->on_hull;
  outcome.lattice_step = simplified->lattice_step;
  outcome.flat = simplified->flat;
  outcome.loose = simplified->loose;
  if (!given.has(kBoundary)) suggest_boundary(simplified->hull_fit, outcome);
  if (outcome.loose > 0)
    outcome.warnings.push_back(
        fmt::format("{} of lines are no edges of the mesh, since other lines of their height "
                    "cross them",
                    format_plural(outcome.loose, "piece")));
  warn_of_shapes(plan.simplify.quality.shape, outcome.simplified, outcome.warnings);
  for (int k = 1; plan.levels && k < plan.levels->count; ++k) {
    *options.max_error *= plan.levels->ratio;
    Result<SimplifiedPoints> level = make_level(options, has_normals, outcome);
    if (!level) return tl::unexpected(with_path(given, std::move(level.error())));
    outcome.coarser.push_back({options.max_error, std::move(level->simplified)});
  }
  Result<void> promise = check_promise(outcome);
  for (Level& level : outcome.coarser) {
    if (promise) promise = with_level(outcome, level, [&] { return check_promise(outcome); });
  }
  return promise;
}

void place_mesh(const SimplifyPlan& plan, PointsOutcome& outcome) {
  if (plan.images.drape) add_uvs(extent_of(outcome.points), outcome.simplified.mesh);
  if (outcome.centre) {
    move(-1, *outcome.centre, outcome.simplified.mesh);
    if (outcome.print) move(-1, *outcome.centre, outcome.print->tiles.front().mesh);
  }
  add_metadata(plan, outcome);
}

Result<void> complete_mesh(const SimplifyPlan& plan, PointsOutcome& outcome) {
  SCARP_RETURN_IF_ERROR(finish_mesh(plan, outcome));
  place_mesh(plan, outcome);
  return {};
}

Result<void> judge_points(const GivenOptions& stated, const Runner& runner, JudgedPoints& judged) {
  const Clock::time_point start = Clock::now();
  SCARP_TRY(const auto& given, boundary_of_cutline(stated));
  SCARP_TRY(const int threads, given.threads());
  std::optional<ErrorGoal> goal;
  if (given[kFailAbove]) {
    SCARP_TRY(ErrorGoal parsed, parse_error_goal(kFailAbove, *given[kFailAbove]));
    SCARP_RETURN_IF_ERROR(refuse_print(kFailAbove, parsed));
    goal = std::move(parsed);
  }
  SCARP_RETURN_IF_ERROR(check_measure_outputs(given));
  SCARP_TRY(judged.mesh, read_mesh(*given[kMesh]));
  undo_placement(judged.mesh);
  // The judge uses the settings of the mesh, unless options set others.
  GivenOptions asked = given, of_other_file = given;
  for (const Remembered& of : kRemembered) {
    const auto entry = judged.mesh.metadata.find(of.key);
    if (given.has(of.option) || entry == judged.mesh.metadata.end()) continue;
    asked.set(of.option, Given(entry->second));
    if (!of.is_of_content) of_other_file.set(of.option, Given(entry->second));
  }
  if (const auto entry = judged.mesh.metadata.find("water");
      !given.has(kWater) && entry != judged.mesh.metadata.end()) {
    const Json files = Json::parse(entry->second, nullptr, false);
    if (files.is_array() && std::all_of(files.begin(), files.end(), [](const Json& file) { return file.is_string(); }))
      asked.set(kWater, files.get<GivenOptions::Texts>());
  }
  SCARP_TRY(judged.policy, parse_policy(asked));
  SCARP_TRY(const auto& boundary, parse_boundary(asked));
  const std::string path = given.input();
  SCARP_TRY(const auto as, remember_reading(given, judged.mesh, *given[kMesh]));
  SCARP_TRY(const auto& limit, parse_memory(given));
  SCARP_RETURN_IF_ERROR(check_rules(given.command(), asked, true));
  const auto read_as = [&](const GivenOptions& options) -> Result<PointSet> {
    if (!limit) return read(options, as, runner.progress);
    SCARP_TRY(auto&& spooled, read_in_parts(options, as, judged.policy, *limit, runner.progress));
    judged.blocks = std::move(spooled.blocks);
    judged.dropped_from_blocks = spooled.duplicates;
    return std::move(spooled.facts);
  };
  Result<PointSet> points = read_as(asked);
  if (!points && points.error().kind == ErrorKind::kUsage) points = read_as(of_other_file);
  if (!points && !given[kCrs] && !as.crs.empty())
    return tl::unexpected(explain_frame(std::move(points.error()), as.crs, *given[kMesh], path));
  SCARP_RETURN_IF_ERROR(points);
  Cutline ends;
  SCARP_TRY(ends.rings, read_boundary(asked, end_option(stated), runner.progress, *points));
  if (!ends.rings.empty()) drop_outside(ends.rings, *points);
  SCARP_RETURN_IF_ERROR(drop_lakes(asked, runner.progress, *points));
  judged.points = std::move(*points);
  if (!given[kCrs]) put_back(judged.points, judged.mesh);
  if (given[kErrorRaster]) judged.errors = ReadyFile{*given[kErrorRaster], "csv", {}};
  if (goal) {
    SCARP_RETURN_IF_ERROR(settle_goal(kFailAbove, judged.points.heights, *goal, judged.points.warnings));
    const HeightRange heights = height_range(judged.points);
    judged.fail_above = goal->absolute(heights.max - heights.min);
  }
  judged.seconds_read = seconds_since(start);

  const Clock::time_point measure_start = Clock::now();
  MeasureOptions options;
  options.run.threads = threads;
  options.run.progress = runner.progress;
  options.inlets = boundary.length.has_value();
  if (!ends.rings.empty()) options.cutline = &ends;
  const double beyond = judged.fail_above.value_or(std::numeric_limits<double>::infinity());
  SCARP_TRY(const auto& tolerances, read_tolerances(given, beyond, runner.progress, judged.points));
  options.tolerance = tolerances;
  if (!tolerances.empty()) options.collect_above = std::numeric_limits<double>::infinity();
  judged.has_tolerances = find_tolerance(given).has_value();
  if (judged.errors) collect_errors(judged.points, judged.errors->bytes, options);
  SCARP_TRY(judged.measured, judged.blocks ? measure_blocks(options, judged)
                                           : measure_points(judged.points, judged.mesh, judged.policy, options));
  judged.seconds_measure = seconds_since(measure_start);
  if (judged.fail_above) judged.broken = find_broken(judged.points, judged.measured, *judged.fail_above);
  if (!judged.broken && judged.measured.over_tolerance > 0)
    judged.broken = describe_over_tolerance(judged.points, judged.measured);
  if (judged.measured.samples == 0)
    judged.broken = describe_elsewhere(extent_of(judged.mesh), extent_of(judged.points), path);
  return {};
}

}  // namespace scarp::cli
