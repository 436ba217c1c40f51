#include "points_command.h"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <string_view>
#include <utility>

#include "clock.h"
#include "progress_display.h"
#include "report.h"
#include "scarp/picture.h"
#include "scarp/version.h"
#include "signals.h"
#include "text.h"
#include "verdict.h"

namespace scarp::cli {
namespace {

constexpr std::pair<const char*, DuplicatePolicy> kPolicies[] = {{"first", DuplicatePolicy::kFirst},
                                                                 {"last", DuplicatePolicy::kLast},
                                                                 {"highest", DuplicatePolicy::kHighest},
                                                                 {"lowest", DuplicatePolicy::kLowest},
                                                                 {"mean", DuplicatePolicy::kMean}};

const char* policy_name(DuplicatePolicy policy) {
  for (const auto& [name, value] : kPolicies) {
    if (value == policy) return name;
  }
  return "first";
}

Result<DuplicatePolicy> parse_policy(const Given& text) {
  if (!text) return DuplicatePolicy::kFirst;
  for (const auto& [name, value] : kPolicies) {
    if (*text == name) return value;
  }
  return fail(ErrorKind::kUsage, fmt::format("--duplicates {} is unknown: choose first, last, highest, lowest or mean",
                                             shell_word(*text)));
}

/// Points have no use for many of the verb's options; silence would be a lie.
Result<void> refuse_raster_options(const CLI::App& verb, const std::string& path) {
  constexpr std::array<std::string_view, 17> kMeant{
      "--max-error",     "--max-triangles", "--max-points",  "--crs",        "--of",     "--base",
      "--report",        "--overwrite",     "--num-threads", "--quiet",      "--points", "--layer",
      "--json-progress", "--duplicates",    "--z-field",     "--fail-above", "--json"};
  for (const CLI::Option* option : verb.get_options()) {
    const std::string name = option->get_name();
    const bool is_meant = option->get_positional() || std::find(kMeant.begin(), kMeant.end(), name) != kMeant.end();
    if (option->count() > 0 && !is_meant)
      return fail(ErrorKind::kUsage, fmt::format("{} is for rasters, and {} holds points: leave it out", name,
                                                 shell_word(base_name(path))));
  }
  return {};
}

Result<PointSet> read(const std::string& path, const PointsArguments& arguments, const Given& crs,
                      const ProgressCallback& progress) {
  if (path.empty()) return fail(ErrorKind::kUsage, "the name of the points is empty");
  for (const auto& [name, value] :
       {std::pair{"--crs", &crs}, std::pair{"--layer", &arguments.layer}, std::pair{"--z-field", &arguments.z_field}}) {
    if (*value && (*value)->empty()) return fail(ErrorKind::kUsage, fmt::format("{} is empty: leave it out", name));
  }
  return read_points(path, {.layer = arguments.layer.value_or(""),
                            .z_field = arguments.z_field.value_or(""),
                            .crs = crs.value_or(""),
                            .progress = progress});
}

HeightRange height_range(const PointSet& points) {
  const auto [least, most] = std::minmax_element(points.z.begin(), points.z.end());
  return {points.size(), *least, *most};
}

std::string describe_place(const PointSet& points, const Measurement& measured) {
  if (measured.max_error_at[0] < 0) return "no point";
  const auto i = static_cast<std::size_t>(measured.max_error_at[0]);
  return fmt::format("{:.12g}, {:.12g}", points.x[i], points.y[i]);
}

/// As find_broken_promise(), with a point's place.
std::optional<std::string> find_broken(const PointSet& points, const Measurement& measured, double bound) {
  if (!(measured.max_error <= bound + judging_allowance(bound, height_range(points))))
    return fmt::format("max error {:.10g} at {} exceeds {:.10g}", measured.max_error, describe_place(points, measured),
                       bound);
  if (measured.uncovered > 0)
    return fmt::format("{} covered by no triangle",
                       measured.uncovered == 1 ? "1 point is" : format_count(measured.uncovered) + " points are");
  if (!measured.is_sound()) return "the mesh is not sound: " + list_faults(measured);
  return std::nullopt;
}

Json describe_points(const PointSet& points, DuplicatePolicy policy, std::uint64_t duplicates) {
  const HeightRange heights = height_range(points);
  return Json{{"path", points.path},
              {"format", points.format},
              {"points", points.size()},
              {"duplicates", duplicates},
              {"duplicate_policy", policy_name(policy)},
              {"min", heights.min},
              {"max", heights.max},
              {"crs", points.crs}};
}

void add_point_measurement(Json& report, const PointSet& points, const Measurement& measured) {
  add_errors(report, measured, 0);
  add_coverage(report, measured);
  Json at = nullptr;
  if (const auto i = static_cast<std::size_t>(measured.max_error_at[0]); measured.max_error_at[0] >= 0)
    at = Json::array({points.x[i], points.y[i]});
  report["max_error_at"] = at;
}

struct Outcome {
  PointSet points;
  DuplicatePolicy policy = DuplicatePolicy::kFirst;
  std::optional<double> asked;
  SimplifiedPoints result;
  std::uint64_t vertices = 0, triangles = 0, solid_vertices = 0, solid_triangles = 0;
  std::vector<std::string> warnings;
  std::vector<std::uint8_t> bytes;
  double seconds_read = 0, seconds_write = 0, seconds_total = 0;

  const Simplified& simplified() const { return result.simplified; }
};

std::string canonical_command(const SimplifyPlan& plan, const PointsArguments& arguments) {
  return plan.canonical_command + (arguments.points ? " --points" : "") +
         canonical_option("--duplicates", arguments.duplicates) + canonical_option("--layer", arguments.layer) +
         canonical_option("--z-field", arguments.z_field);
}

void add_metadata(const SimplifyPlan& plan, const PointsArguments& arguments, Outcome& outcome) {
  const Measurement& measured = outcome.simplified().measurement;
  std::map<std::string, std::string>& metadata = outcome.result.simplified.mesh.metadata;
  metadata["generator"] = fmt::format("Scarp {}", version());
  metadata["command"] = canonical_command(plan, arguments);
  metadata["frame"] = outcome.points.description;
  metadata["duplicates"] = policy_name(outcome.policy);
  if (!outcome.points.crs.empty()) metadata["crs"] = outcome.points.crs;
  if (!plan.read.crs.empty()) metadata["crs_option"] = plan.read.crs;
  metadata["error"] = Json{
      {"asked", or_null(outcome.asked)},
      {"max_error", measured.max_error},
      {"rmse", measured.rmse},
      {"samples",
       measured.samples}}.dump();
}

Result<void> encode(const SimplifyPlan& plan, const PointsArguments& arguments, Outcome& outcome) {
  Mesh& mesh = outcome.result.simplified.mesh;
  outcome.vertices = mesh.vertex_count();
  outcome.triangles = mesh.triangle_count();
  if (plan.base) {
    if (auto closed = close_with_base(mesh, *plan.base); !closed) return closed;
  }
  outcome.solid_vertices = mesh.vertex_count();
  outcome.solid_triangles = mesh.triangle_count();
  add_metadata(plan, arguments, outcome);
  auto bytes = encode_as(plan.format, mesh);
  if (!bytes) return tl::unexpected(std::move(bytes.error()));
  outcome.bytes = std::move(*bytes);
  return {};
}

std::string make_report(const SimplifyPlan& plan, const Outcome& outcome, const std::string& command_line) {
  Json report;
  report["scarp"] = version();
  report["command"] = command_line;
  report["input"] = describe_points(outcome.points, outcome.policy, outcome.result.duplicates);
  report["input"]["on_hull"] = outcome.result.on_hull;
  report["input"]["lattice_step"] = outcome.result.lattice_step;
  report["frame"] = Json{{"crs", outcome.points.crs}, {"description", outcome.points.description}};
  Json& goal = report["goal"];
  goal["max_error"] = or_null(outcome.asked);
  goal["percent_of_relief"] =
      plan.error_goal && plan.error_goal->percent_of_relief ? Json(plan.error_goal->value) : Json(nullptr);
  goal["max_triangles"] = or_null(plan.simplify.max_triangles);
  goal["max_points"] = or_null(plan.simplify.max_vertices);
  report["stopped_by"] = stop_name(outcome.simplified().stop);
  report["vertices"] = outcome.vertices;
  report["triangles"] = outcome.triangles;
  add_point_measurement(report, outcome.points, outcome.simplified().measurement);
  if (plan.base) {
    report["solid"] =
        Json{{"base", *plan.base}, {"vertices", outcome.solid_vertices}, {"triangles", outcome.solid_triangles}};
  }
  report["seconds"] = Json{{"read", outcome.seconds_read},
                           {"refine", outcome.simplified().seconds_refine},
                           {"measure", outcome.simplified().seconds_measure},
                           {"write", outcome.seconds_write},
                           {"total", outcome.seconds_total}};
  report["outputs"] =
      Json::array({Json{{"path", plan.output}, {"format", plan.format.name()}, {"bytes", outcome.bytes.size()}}});
  report["warnings"] = outcome.warnings;
  return to_text(report);
}

std::string describe_end(const Outcome& outcome) {
  const std::string error = format_number(outcome.simplified().measurement.max_error);
  const std::string asked = outcome.asked ? format_number(*outcome.asked) : "";
  const std::string missed = outcome.asked ? fmt::format(" (asked {}, not reached)", asked) : "";
  switch (outcome.simplified().stop) {
    case StopReason::kMaxError:
      return fmt::format("Reached the error goal: max error {} (asked {})", error, asked);
    case StopReason::kMaxTriangles:
      return fmt::format("Reached the triangle budget: max error {}{}", error, missed);
    case StopReason::kMaxVertices:
      return fmt::format("Reached the point budget: max error {}{}", error, missed);
    case StopReason::kExact:
      break;
  }
  return fmt::format("No vertex more would lower the error: max error {}", error);
}

std::string make_summary(const SimplifyPlan& plan, const Outcome& outcome) {
  const Measurement& measured = outcome.simplified().measurement;
  const HeightRange heights = height_range(outcome.points);
  const auto line = [](const char* name, const std::string& value) { return fmt::format("  {:<14}{}\n", name, value); };
  std::string text = fmt::format("{} -> {}\n", base_name(plan.input), plan.output);
  text += line("points", fmt::format("{}, heights {} to {}", format_count(outcome.result.points),
                                     format_number(heights.min), format_number(heights.max)));
  text += line("duplicates", outcome.result.duplicates == 0
                                 ? "none"
                                 : fmt::format("{}, the {} of each place counts",
                                               format_count(outcome.result.duplicates), policy_name(outcome.policy)));
  text += line("lattice step", format_number(outcome.result.lattice_step));
  text += line("written", fmt::format("{}, {}", plan.output, format_bytes(outcome.bytes.size())));
  if (plan.report) text += line("written", *plan.report);
  text +=
      line("vertices",
           fmt::format("{}, {} of the points, {} on the hull", format_count(outcome.vertices),
                       format_share(static_cast<double>(outcome.vertices), static_cast<double>(outcome.result.points)),
                       format_count(outcome.result.on_hull)));
  text += line("triangles", format_count(outcome.triangles));
  if (plan.base) {
    text += line("solid", fmt::format("{}, base at {}", format_plural(outcome.solid_triangles, "triangle"),
                                      format_number(*plan.base)));
  }
  text += line("max error",
               fmt::format("{} at {}{}", format_number(measured.max_error), describe_place(outcome.points, measured),
                           outcome.asked ? fmt::format(" (asked {})", format_number(*outcome.asked)) : ""));
  text += line("RMSE", format_number(measured.rmse));
  text += line("judged", format_plural(measured.samples, "point") + ", none uncovered");
  text += line("seconds", fmt::format("read {}, refine {}, measure {}, write {}", format_seconds(outcome.seconds_read),
                                      format_seconds(outcome.simplified().seconds_refine),
                                      format_seconds(outcome.simplified().seconds_measure),
                                      format_seconds(outcome.seconds_write)));
  return text + fmt::format("{}, RMSE {}, {}, {} s\n", describe_end(outcome), format_number(measured.rmse),
                            format_plural(outcome.triangles, "triangle"), format_seconds(outcome.seconds_total));
}

/// A frame that the mesh file names and the points cannot have.
Error explain_frame(Error error, const std::string& crs, const std::string& mesh, const std::string& path) {
  if (error.kind != ErrorKind::kUsage) return error;
  if (crs != "grid") {
    error.message += fmt::format("; {} names that CRS as its own, --crs overrides it", mesh);
    return error;
  }
  error.message = fmt::format(
      "{} says of itself that its coordinates are the columns and rows of a raster ('grid'), which the points of {} do "
      "not have: judge it by its raster, or say with --crs source that x and y of the points count the same",
      mesh, path);
  return error;
}

/// Library errors about the points themselves do not know the file.
Error with_path(Error error, const std::string& path) {
  if (error.kind == ErrorKind::kInput) error.message = fmt::format("{}: {}", path, error.message);
  return error;
}

/// What measure found, for its table and report.
struct Judged {
  PointSet points;
  DuplicatePolicy policy = DuplicatePolicy::kFirst;
  Mesh mesh;
  Measurement measured;
  std::optional<double> fail_above;
  std::optional<std::string> broken;
  double seconds_read = 0, seconds_measure = 0, seconds_total = 0;

  std::uint64_t duplicates() const { return points.size() - measured.samples - measured.uncovered; }
};

std::string make_report(const Judged& judged, const std::string& mesh_path, const std::string& command_line) {
  Json report;
  report["scarp"] = version();
  report["command"] = command_line;
  report["input"] = describe_points(judged.points, judged.policy, judged.duplicates());
  report["frame"] = Json{{"crs", judged.points.crs}, {"description", judged.points.description}};
  report["mesh"] = Json{{"path", mesh_path}, {"metadata", judged.mesh.metadata}};
  report["vertices"] = judged.measured.vertices;
  report["triangles"] = judged.measured.triangles;
  add_point_measurement(report, judged.points, judged.measured);
  report["fail_above"] = or_null(judged.fail_above);
  report["passed"] = judged.fail_above ? Json(!judged.broken) : Json(nullptr);
  report["seconds"] =
      Json{{"read", judged.seconds_read}, {"measure", judged.seconds_measure}, {"total", judged.seconds_total}};
  report["warnings"] = judged.points.warnings;
  return to_text(report);
}

std::string make_table(const Judged& judged, const std::string& mesh_path) {
  const Measurement& m = judged.measured;
  const auto line = [](const char* name, const std::string& value) { return fmt::format("  {:<20}{}\n", name, value); };
  std::string text = fmt::format("{} judged by {}, {}\n", base_name(mesh_path), base_name(judged.points.path),
                                 format_plural(judged.points.size(), "point"));
  text += line("max error", fmt::format("{} at {}", format_number(m.max_error), describe_place(judged.points, m)));
  text += line("RMSE", format_number(m.rmse));
  text += line("mean error", format_number(m.mean_error));
  text += line("mean |error|", format_number(m.mean_abs_error));
  text += line("P50, P95", fmt::format("{}, {}", format_number(m.p50), format_number(m.p95)));
  text += line("P99, P99.9", fmt::format("{}, {}", format_number(m.p99), format_number(m.p999)));
  text += line("points judged", format_count(m.samples));
  text += line("points uncovered", format_count(m.uncovered));
  text += line("duplicates",
               fmt::format("{} left out ({})", format_count(judged.duplicates()), policy_name(judged.policy)));
  text += line("vertices", format_count(m.vertices));
  text += line("triangles", format_count(m.triangles));
  text += line("smallest angle",
               fmt::format("{:.3g} degrees; of each triangle P1 {:.3g}, P5 {:.3g}, P50 {:.3g}", m.min_angle,
                           m.angle_percentiles[0], m.angle_percentiles[1], m.angle_percentiles[2]));
  const std::string faults = list_faults(m);
  text += line("topology", faults.empty() ? "sound" : faults);
  if (judged.fail_above) {
    text += line("verdict", fmt::format("{} {}", judged.broken ? "FAILS" : "keeps", format_number(*judged.fail_above)));
  }
  return text;
}

}  // namespace

Result<void> run_simplify_points(const CLI::App& verb, const SimplifyArguments& given, const PointsArguments& arguments,
                                 const std::string& command_line) {
  const Clock::time_point start = Clock::now();
  if (auto meant = refuse_raster_options(verb, given.raster.path); !meant) return meant;
  if (!given.max_error && !given.max_triangles && !given.max_points)
    return fail(ErrorKind::kUsage,
                "no goal is given: say how good the mesh must be, such as -e 1 for heights within 1 unit, or how small "
                "with -t or -p");
  Result<SimplifyPlan> plan = plan_simplify(given);
  if (!plan) return tl::unexpected(std::move(plan.error()));
  if (plan->format.kind == OutputKind::kDem)
    return fail(ErrorKind::kUsage,
                fmt::format("{} is a raster, and {} holds points, which lie on no grid: choose .glb, .obj, .ply, .stl "
                            "or .tin",
                            given.output, shell_word(base_name(given.raster.path))));
  const auto policy = parse_policy(arguments.duplicates);
  if (!policy) return tl::unexpected(policy.error());

  Outcome outcome;
  outcome.policy = *policy;
  ProgressDisplay display(ProgressDisplay::choose(given.json_progress, given.quiet));
  Result<PointSet> points = read(given.raster.path, arguments, given.raster.crs, display.callback());
  if (!points) return tl::unexpected(std::move(points.error()));
  outcome.points = std::move(*points);
  outcome.warnings = plan->warnings;
  outcome.warnings.insert(outcome.warnings.end(), outcome.points.warnings.begin(), outcome.points.warnings.end());
  const HeightRange heights = height_range(outcome.points);
  if (plan->error_goal) outcome.asked = plan->error_goal->absolute(heights.max - heights.min);
  outcome.seconds_read = seconds_since(start);

  SimplifyOptions options = plan->simplify;
  options.max_error = outcome.asked;
  options.progress = display.callback();
  Result<SimplifiedPoints> simplified = simplify_points(outcome.points, options, outcome.policy);
  if (!simplified) return tl::unexpected(with_path(std::move(simplified.error()), given.raster.path));
  outcome.result = std::move(*simplified);
  // The engine proves its own result; a mesh whose proof does not hold is never written.
  const bool has_bound = outcome.simplified().stop == StopReason::kMaxError;
  const auto broken = find_broken(outcome.points, outcome.simplified().measurement,
                                  has_bound ? *outcome.asked : outcome.simplified().measurement.max_error);
  if (broken)
    return fail(ErrorKind::kPromise,
                "the mesh does not keep its promise and was not written; this is a bug in Scarp: " + *broken);

  const Clock::time_point write_start = Clock::now();
  const Result<void> encoded = encode(*plan, arguments, outcome);
  if (!encoded) return encoded;
  if (interrupted()) return fail(ErrorKind::kCancelled, "interrupted");
  const Result<void> written = write_file(plan->output, outcome.bytes, plan->overwrite);
  if (!written) return written;
  outcome.seconds_write = seconds_since(write_start);
  outcome.seconds_total = seconds_since(start);
  if (plan->report) {
    const std::string text = make_report(*plan, outcome, command_line);
    const Result<void> reported =
        write_file(*plan->report, std::vector<std::uint8_t>(text.begin(), text.end()), plan->overwrite);
    if (!reported) return reported;
  }
  display.finish();

  if (given.quiet) return {};
  print_warnings(outcome.warnings);
  const std::string summary = make_summary(*plan, outcome);
  if (!is_stdout(plan->output) && !is_stdout(plan->report.value_or(""))) return print_to_stdout(summary);
  print_to_stderr(summary);
  return {};
}

Result<void> run_measure_points(const CLI::App& verb, const MeasurePointsArguments& given,
                                const PointsArguments& arguments, const std::string& command_line) {
  const Clock::time_point start = Clock::now();
  if (auto meant = refuse_raster_options(verb, given.path); !meant) return meant;
  const Result<int> threads = parse_threads(given.threads);
  if (!threads) return tl::unexpected(threads.error());
  Judged judged;
  if (given.fail_above) {
    const Result<double> bound = parse_non_negative("--fail-above", *given.fail_above);
    if (!bound) return tl::unexpected(bound.error());
    judged.fail_above = *bound;
  }
  ProgressDisplay display(ProgressDisplay::choose(given.json_progress, given.quiet));
  Result<Mesh> mesh = read_mesh(given.mesh);
  if (!mesh) return tl::unexpected(std::move(mesh.error()));
  judged.mesh = std::move(*mesh);
  // What was asked of the mesh holds for its judge, unless it is told otherwise.
  const auto remembered = [&](const Given& option, const char* key) -> Given {
    const auto entry = judged.mesh.metadata.find(key);
    return option || entry == judged.mesh.metadata.end() ? option : Given(entry->second);
  };
  const auto policy = parse_policy(remembered(arguments.duplicates, "duplicates"));
  if (!policy) return tl::unexpected(policy.error());
  judged.policy = *policy;
  const Given crs = remembered(given.crs, "crs_option");
  Result<PointSet> points = read(given.path, arguments, crs, display.callback());
  if (!points && !given.crs && crs)
    return tl::unexpected(explain_frame(std::move(points.error()), *crs, given.mesh, given.path));
  if (!points) return tl::unexpected(std::move(points.error()));
  judged.points = std::move(*points);
  judged.seconds_read = seconds_since(start);

  const Clock::time_point measure_start = Clock::now();
  MeasureOptions options;
  options.threads = *threads;
  options.progress = display.callback();
  Result<Measurement> measured = measure_points(judged.points, judged.mesh, judged.policy, options);
  if (!measured) return tl::unexpected(std::move(measured.error()));
  judged.measured = std::move(*measured);
  judged.seconds_measure = seconds_since(measure_start);
  if (judged.fail_above) judged.broken = find_broken(judged.points, judged.measured, *judged.fail_above);
  if (judged.measured.samples == 0)
    judged.points.warnings.push_back(fmt::format(
        "no point of {} is covered by {}: do they have the same coordinates (--crs)?", given.path, given.mesh));
  if (interrupted()) return fail(ErrorKind::kCancelled, "interrupted");
  display.finish();
  judged.seconds_total = seconds_since(start);

  if (!given.quiet) print_warnings(judged.points.warnings);
  if (given.json) {
    const Result<void> printed = print_to_stdout(make_report(judged, given.mesh, command_line));
    if (!printed) return printed;
  } else if (!given.quiet) {
    const Result<void> printed = print_to_stdout(make_table(judged, given.mesh));
    if (!printed) return printed;
  }
  if (judged.broken) return fail(ErrorKind::kPromise, fmt::format("{}: {}", given.mesh, *judged.broken));
  return {};
}

}  // namespace scarp::cli
