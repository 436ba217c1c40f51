#include "simplify_command.h"

#include <fmt/format.h>

#include <algorithm>
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

/// A file of this run and its bytes, ready to be written.
struct ReadyFile {
  std::string path;
  const char* kind;
  std::vector<std::uint8_t> bytes;
};

/// Everything that the report and the summary tell.
struct Outcome {
  OwnedHeightField field;
  RasterInfo as_read;   ///< before voids were filled
  HeightRange heights;  ///< of the samples that were judged
  std::uint64_t filled = 0;
  std::optional<double> asked;  ///< max error in z units
  Simplified simplified;
  std::uint64_t vertices = 0, triangles = 0;              ///< of the terrain
  std::uint64_t solid_vertices = 0, solid_triangles = 0;  ///< with --base
  std::vector<std::string> warnings;
  double seconds_read = 0, seconds_write = 0, seconds_total = 0;
};

Result<void> read_field(const SimplifyPlan& plan, const ProgressCallback& progress, Outcome& outcome) {
  const Clock::time_point start = Clock::now();
  ReadOptions options = plan.read;
  options.progress = progress;
  Result<OwnedHeightField> field = read_height_field(plan.input, options);
  if (!field) return tl::unexpected(std::move(field.error()));
  outcome.field = std::move(*field);
  outcome.as_read = outcome.field.info;
  if (plan.policy == NodataPolicy::kFill) outcome.filled = fill_voids(outcome.field, plan.fill_distance);
  if (plan.policy == NodataPolicy::kBackground) outcome.filled = fill_background(outcome.field, plan.background);
  outcome.heights = height_range(outcome.field);
  if (plan.error_goal) outcome.asked = plan.error_goal->absolute(outcome.as_read.max - outcome.as_read.min);
  outcome.seconds_read = seconds_since(start);
  return {};
}

/// The engine proves its own result; a mesh whose proof does not hold is never written.
Result<void> check_promise(const Outcome& outcome) {
  const Measurement& measured = outcome.simplified.measurement;
  const bool has_bound = outcome.asked && outcome.simplified.stop != StopReason::kMaxTriangles &&
                         outcome.simplified.stop != StopReason::kMaxVertices;
  const double rounding = outcome.field.sample_rounding;
  const double bound = has_bound ? *outcome.asked : measured.max_error + rounding;
  const bool too_large = !(measured.max_error + rounding <= bound + judging_allowance(bound, outcome.heights));
  if (!too_large && measured.uncovered == 0) return {};
  return fail(ErrorKind::kPromise,
              fmt::format("the mesh does not keep its promise and was not written; this is a bug in Scarp: {}",
                          find_broken_promise(measured, rounding, bound, outcome.heights).value_or("")));
}

/// simplify() leaves out the topology where it holds by construction; a report states what was looked at, not what must
/// be so.
Result<void> judge_topology(const ProgressCallback& progress, int threads, Outcome& outcome) {
  MeasureOptions options;
  options.threads = threads;
  options.progress = progress;
  const Clock::time_point start = Clock::now();
  Result<Measurement> measured = measure(outcome.field, outcome.simplified.mesh, options);
  if (!measured) return tl::unexpected(std::move(measured.error()));
  outcome.simplified.measurement = std::move(*measured);
  outcome.simplified.seconds_measure += seconds_since(start);
  return {};
}

Result<void> add_solid(const SimplifyPlan& plan, Outcome& outcome) {
  Mesh& mesh = outcome.simplified.mesh;
  outcome.vertices = mesh.vertex_count();
  outcome.triangles = mesh.triangle_count();
  if (!plan.base) return {};
  if (!add_base(mesh, *plan.base)) {
    double lowest = mesh.vertex(0)[2];
    for (std::size_t v = 1; v < mesh.vertex_count(); ++v) lowest = std::min(lowest, mesh.vertex(v)[2]);
    return fail(ErrorKind::kUsage,
                fmt::format("--base {:.10g} is not below the lowest vertex, which is at {:.10g}", *plan.base, lowest));
  }
  outcome.solid_vertices = mesh.vertex_count();
  outcome.solid_triangles = mesh.triangle_count();
  return {};
}

void add_metadata(const SimplifyPlan& plan, Outcome& outcome) {
  const Measurement& measured = outcome.simplified.measurement;
  std::map<std::string, std::string>& metadata = outcome.simplified.mesh.metadata;
  metadata["generator"] = fmt::format("Scarp {}", version());
  metadata["command"] = plan.canonical_command;
  metadata["frame"] = outcome.field.frame.description;
  if (!outcome.field.frame.crs.empty()) metadata["crs"] = outcome.field.frame.crs;
  if (!plan.read.crs.empty()) metadata["crs_option"] = plan.read.crs;
  if (!outcome.as_read.unit.empty()) metadata["unit"] = outcome.as_read.unit;
  Json error;
  error["asked"] = outcome.asked ? Json(*outcome.asked) : Json(nullptr);
  error["max_error"] = measured.max_error;
  if (outcome.field.sample_rounding > 0) error["sample_rounding"] = outcome.field.sample_rounding;
  error["rmse"] = measured.rmse;
  error["samples"] = measured.samples;
  metadata["error"] = error.dump();
}

/// The bytes of every file but the report. The preview shows the terrain, before it is closed into a solid.
Result<std::vector<ReadyFile>> encode_files(const SimplifyPlan& plan, Outcome& outcome) {
  std::vector<ReadyFile> files{{plan.output, format_name(plan.format), {}}};
  if (plan.preview) {
    Result<std::vector<std::uint8_t>> png = encode_png(draw_preview(outcome.field, outcome.simplified.mesh));
    if (!png) return tl::unexpected(std::move(png.error()));
    files.push_back({*plan.preview, "png", std::move(*png)});
  }
  const Result<void> solid = add_solid(plan, outcome);
  if (!solid) return tl::unexpected(solid.error());
  add_metadata(plan, outcome);
  Result<std::vector<std::uint8_t>> mesh = encode_mesh(outcome.simplified.mesh, plan.format);
  if (!mesh) return tl::unexpected(std::move(mesh.error()));
  files.front().bytes = std::move(*mesh);
  return files;
}

const char* stop_name(StopReason stop) {
  switch (stop) {
    case StopReason::kMaxError:
      return "max_error";
    case StopReason::kMaxTriangles:
      return "max_triangles";
    case StopReason::kMaxVertices:
      return "max_points";
    case StopReason::kExact:
      break;
  }
  return "exact";
}

Json make_report(const SimplifyPlan& plan, const Outcome& outcome, const std::vector<ReadyFile>& files,
                 const std::string& command_line) {
  Json report;
  report["scarp"] = version();
  report["command"] = command_line;
  report["input"] = describe_input(outcome.field, outcome.as_read, plan.read.band);
  report["input"]["filled"] = outcome.filled;
  report["frame"] = describe_frame(outcome.field.frame);
  Json& goal = report["goal"];
  goal["max_error"] = or_null(outcome.asked);
  goal["percent_of_relief"] =
      plan.error_goal && plan.error_goal->percent_of_relief ? Json(plan.error_goal->value) : Json(nullptr);
  goal["max_triangles"] = or_null(plan.simplify.max_triangles);
  goal["max_points"] = or_null(plan.simplify.max_vertices);
  report["stopped_by"] = stop_name(outcome.simplified.stop);
  report["vertices"] = outcome.vertices;
  report["triangles"] = outcome.triangles;
  report["full_triangles"] = full_grid_triangles(outcome.field);
  add_measurement(report, outcome.simplified.measurement, outcome.field.sample_rounding);
  if (plan.base) {
    report["solid"] =
        Json{{"base", *plan.base}, {"vertices", outcome.solid_vertices}, {"triangles", outcome.solid_triangles}};
  }
  report["seconds"] = Json{{"read", outcome.seconds_read},
                           {"refine", outcome.simplified.seconds_refine},
                           {"measure", outcome.simplified.seconds_measure},
                           {"write", outcome.seconds_write},
                           {"total", outcome.seconds_total}};
  report["outputs"] = Json::array();
  for (const ReadyFile& file : files) {
    report["outputs"].push_back(Json{{"path", file.path}, {"format", file.kind}, {"bytes", file.bytes.size()}});
  }
  report["warnings"] = outcome.warnings;
  return report;
}

/// Which goal ended the run and what the error then is: the last line of the summary.
std::string describe_end(const SimplifyPlan& plan, const Outcome& outcome) {
  const Measurement& measured = outcome.simplified.measurement;
  const bool has_asked = outcome.asked.has_value();
  const std::string numbers = fmt::format(
      "RMSE {}, {} ({} of {}), {} s", format_number(measured.rmse), format_plural(outcome.triangles, "triangle"),
      format_share(static_cast<double>(outcome.triangles), static_cast<double>(full_grid_triangles(outcome.field))),
      format_count(full_grid_triangles(outcome.field)), format_seconds(outcome.seconds_total));
  const std::string error = format_number(measured.max_error);
  switch (outcome.simplified.stop) {
    case StopReason::kMaxError:
      return fmt::format("Reached the error goal: max error {} (asked {}), {}", error,
                         format_number(outcome.asked.value_or(0)), numbers);
    case StopReason::kMaxTriangles:
      return fmt::format("Reached the triangle budget of {}: max error {}{}, {}",
                         format_count(plan.simplify.max_triangles.value_or(0)), error,
                         has_asked ? fmt::format(" (asked {}, not reached)", format_number(*outcome.asked)) : "",
                         numbers);
    case StopReason::kMaxVertices:
      return fmt::format("Reached the point budget of {}: max error {}{}, {} vertices, {}",
                         format_count(plan.simplify.max_vertices.value_or(0)), error,
                         has_asked ? fmt::format(" (asked {}, not reached)", format_number(*outcome.asked)) : "",
                         format_count(outcome.vertices), numbers);
    case StopReason::kExact:
      break;
  }
  const bool is_exact = measured.max_error == 0 && outcome.field.sample_rounding == 0;
  return fmt::format("{}: max error {}{}, {}",
                     is_exact ? "Reproduced every sample" : "No vertex more would lower the error", error,
                     has_asked ? fmt::format(" (asked {})", format_number(*outcome.asked)) : "", numbers);
}

std::string make_summary(const SimplifyPlan& plan, const Outcome& outcome, const std::vector<ReadyFile>& files) {
  const Measurement& measured = outcome.simplified.measurement;
  const RasterInfo& info = outcome.as_read;
  const std::string unit = info.unit.empty() ? "" : " " + info.unit;
  const auto line = [](const char* name, const std::string& value) { return fmt::format("  {:<14}{}\n", name, value); };

  std::string text = fmt::format("{} -> {}\n", base_name(plan.input), plan.output);
  text += line("raster",
               fmt::format("{} x {}, {} valid samples, heights {} to {}{}", outcome.field.cols, outcome.field.rows,
                           format_count(info.valid), format_number(info.min), format_number(info.max), unit));
  if (outcome.filled > 0) text += line("filled", format_plural(outcome.filled, "void sample"));
  for (const ReadyFile& file : files) {
    text += line("written", fmt::format("{}, {}", file.path, format_bytes(file.bytes.size())));
  }
  if (plan.report) text += line("written", *plan.report);
  text += line("vertices", format_count(outcome.vertices));
  const std::uint64_t full = full_grid_triangles(outcome.field);
  text += line("triangles", fmt::format("{}, {} of the full grid's {}", format_count(outcome.triangles),
                                        format_share(static_cast<double>(outcome.triangles), static_cast<double>(full)),
                                        format_count(full)));
  if (plan.base) {
    text += line("solid", fmt::format("{}, base at {}", format_plural(outcome.solid_triangles, "triangle"),
                                      format_number(*plan.base)));
  }
  text +=
      line("max error", fmt::format("{}{} at column {}, row {}{}", format_number(measured.max_error), unit,
                                    measured.max_error_at[0], measured.max_error_at[1],
                                    outcome.asked ? fmt::format(" (asked {})", format_number(*outcome.asked)) : ""));
  if (outcome.field.sample_rounding > 0) {
    text += line(
        "", fmt::format("values rounded to float32 by up to {}{}", format_number(outcome.field.sample_rounding), unit));
  }
  text += line("RMSE", fmt::format("{}{}", format_number(measured.rmse), unit));
  text += line("judged", format_plural(measured.samples, "sample") + ", none uncovered" +
                             (measured.stray > 0 ? fmt::format(", {} outside every cell of the domain left out",
                                                               format_count(measured.stray))
                                                 : ""));
  text += line("seconds",
               fmt::format("read {}, refine {}, measure {}, write {}", format_seconds(outcome.seconds_read),
                           format_seconds(outcome.simplified.seconds_refine),
                           format_seconds(outcome.simplified.seconds_measure), format_seconds(outcome.seconds_write)));
  return text + describe_end(plan, outcome) + "\n";
}

Result<void> write_report(const SimplifyPlan& plan, const Json& report) {
  const std::string text = to_text(report);
  const std::vector<std::uint8_t> bytes(text.begin(), text.end());
  return write_file(*plan.report, bytes, plan.overwrite);
}

}  // namespace

SimplifyCommand::SimplifyCommand(CLI::App& program)
    : verb_(
          program.add_subcommand("simplify", "Turn a raster of heights into a small mesh with a proven error bound")) {
  verb_->add_option("INPUT", given_.raster.path, "Raster of heights: a file or URL that GDAL opens, PGM or STM")
      ->type_name("")
      ->required();
  verb_->add_option("OUTPUT", given_.output, "Mesh to write: .glb, .obj, .ply or .stl")->type_name("")->required();

  verb_
      ->add_option(
          "-e,--max-error", given_.max_error,
          "No sample is farther than this from the mesh,\nmeasured vertically: in the units of the heights, or\n"
          "as a percentage of the relief (0.5%); 0 keeps\nevery sample exactly")
      ->type_name("M|P%")
      ->group("Goals (at least one; the first that is reached ends the run)");
  verb_->add_option("-t,--max-triangles", given_.max_triangles, "At most this many triangles")
      ->type_name("N")
      ->group("Goals (at least one; the first that is reached ends the run)");
  verb_->add_option("-p,--max-points", given_.max_points, "At most this many vertices")
      ->type_name("N")
      ->group("Goals (at least one; the first that is reached ends the run)");

  given_.raster.add_to(
      *verb_,
      "Coordinates of the mesh: source (the raster's own),\nlocal (metres around its centre), grid "
      "(columns and\nrows) or a CRS such as EPSG:32611. Default: local for\ndegrees, else source, else "
      "grid");

  points_.add_to(*verb_);
  verb_
      ->add_option(
          "--nodata-policy", given_.nodata_policy,
          "Missing samples become: hole (default; the mesh\nhas none there), fill (interpolated) or background")
      ->type_name("POLICY")
      ->group("Missing samples");
  verb_
      ->add_option(
          "--fill-distance", given_.fill_distance,
          "fill: farthest valid sample to interpolate from, in\nsamples (default 100); what is farther stays a hole")
      ->type_name("S")
      ->group("Missing samples");
  verb_->add_option("--background", given_.background, "background: the height to use, in the raster's units")
      ->type_name("V")
      ->group("Missing samples");
  verb_
      ->add_option("--outline-tolerance", given_.outline_tolerance,
                   "How far the outline of the valid data may move\noutwards to become simpler, in samples (default 0)")
      ->type_name("S")
      ->group("Missing samples");

  verb_->add_option("--of", given_.format, "Mesh format: glb, obj, ply or stl (default: by OUTPUT's\nextension)")
      ->type_name("FORMAT")
      ->group("Output");
  verb_->add_flag("--normals", given_.normals, "Vertex normals from the full-resolution raster")->group("Output");
  verb_
      ->add_option("--base", given_.base,
                   "Close the mesh into a watertight solid with a flat\nbase at this height, in the raster's units")
      ->type_name("H")
      ->group("Output");
  verb_->add_option("--preview", given_.preview, "Also draw a hillshade with the mesh over it")
      ->type_name("FILE.png")
      ->group("Output");
  verb_->add_option("--report", given_.report, "Also write the numbers of this run as JSON")
      ->type_name("FILE.json")
      ->group("Output");
  verb_->add_flag("--overwrite", given_.overwrite, "Replace files that exist (default: refuse)")->group("Output");

  verb_->add_option("-j,--num-threads", given_.threads, "Threads, 0 = all cores (default); never changes the result")
      ->type_name("N")
      ->group("Run");
  verb_->add_flag("-q,--quiet", given_.quiet, "No summary, no progress, no warnings")->group("Run");
  verb_->add_flag("--json-progress", given_.json_progress, "Progress as one JSON object a line on stderr")
      ->group("Run");
  verb_->footer(
      "Examples:\n"
      "  scarp simplify dem.tif hills.glb -e 1            every sample within 1 m\n"
      "  scarp simplify dem.tif hills.obj -e 0.5%         within half a percent of the relief\n"
      "  scarp simplify dem.tif hills.glb -t 5000 --preview hills.png --report hills.json\n"
      "  scarp simplify dem.tif print.stl -e 1 --base 0   a solid for a 3-D printer\n"
      "  scarp simplify tile.png tile.glb -e 1 --decode terrarium\n"
      "  scarp simplify survey.csv hills.glb -e 0.5       scattered points: x, y, z\n"
      "'scarp info dem.tif' suggests errors. 'scarp measure dem.tif hills.glb' checks a mesh.\n"
      "Exit codes: 0 ok, 1 usage, 2 input, 3 promise not met, 4 output, 5 interrupted, 70 internal error.");
}

Result<void> SimplifyCommand::run(const std::string& command_line) const {
  const Clock::time_point start = Clock::now();
  if (points_.are_meant(given_.raster.path)) return run_simplify_points(*verb_, given_, points_, command_line);
  if (auto unused = points_.check_unused(given_.raster.path); !unused) return unused;
  Result<SimplifyPlan> plan = plan_simplify(given_);
  if (!plan) return tl::unexpected(std::move(plan.error()));

  Outcome outcome;
  ProgressDisplay display(ProgressDisplay::choose(given_.json_progress, given_.quiet));
  const Result<void> has_field = read_field(*plan, display.callback(), outcome);
  if (!has_field) return has_field;

  SimplifyOptions options = plan->simplify;
  options.max_error = outcome.asked;
  options.progress = display.callback();
  Result<Simplified> simplified = simplify(outcome.field, options);
  if (!simplified) {
    Error error = std::move(simplified.error());
    if (error.kind == ErrorKind::kInput) error.message = fmt::format("{}: {}", plan->input, error.message);
    return tl::unexpected(std::move(error));
  }
  outcome.simplified = std::move(*simplified);
  const OwnedHeightField& field = outcome.field;
  const bool by_construction =
      options.float32_positions ? offsets_are_exact(field.frame, field.cols, field.rows) : field.frame.is_affine();
  if (plan->report && by_construction) {
    const Result<void> judged = judge_topology(display.callback(), plan->simplify.threads, outcome);
    if (!judged) return judged;
  }
  const Result<void> promise = check_promise(outcome);
  if (!promise) return promise;
  outcome.warnings = plan->warnings;
  outcome.warnings.insert(outcome.warnings.end(), outcome.as_read.warnings.begin(), outcome.as_read.warnings.end());
  if (const std::string faults = list_faults(outcome.simplified.measurement); !faults.empty()) {
    outcome.warnings.push_back("the mesh keeps its error bound but is not sound: " + faults);
  }

  const Clock::time_point write_start = Clock::now();
  const bool go_on = display.callback()(
      {"write", 0, outcome.simplified.mesh.vertex_count(), outcome.simplified.measurement.max_error});
  if (!go_on) return fail(ErrorKind::kCancelled, "interrupted");
  const Result<std::vector<ReadyFile>> files = encode_files(*plan, outcome);
  if (!files) return tl::unexpected(files.error());
  if (interrupted()) return fail(ErrorKind::kCancelled, "interrupted");

  // From here on the work is done: files appear one after the other, each whole.
  for (const ReadyFile& file : *files) {
    const Result<void> written = write_file(file.path, file.bytes, plan->overwrite);
    if (!written) return written;
  }
  outcome.seconds_write = seconds_since(write_start);
  outcome.seconds_total = seconds_since(start);
  if (plan->report) {
    const Result<void> written = write_report(*plan, make_report(*plan, outcome, *files, command_line));
    if (!written) return written;
  }
  display.finish();

  if (given_.quiet) return {};
  print_warnings(outcome.warnings);
  const std::string summary = make_summary(*plan, outcome, *files);
  const bool stdout_is_data =
      is_stdout(plan->output) || is_stdout(plan->preview.value_or("")) || is_stdout(plan->report.value_or(""));
  if (stdout_is_data) {
    print_to_stderr(summary);
    return {};
  }
  return print_to_stdout(summary);
}

}  // namespace scarp::cli
