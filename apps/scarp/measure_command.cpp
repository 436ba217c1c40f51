#include "measure_command.h"

#include <fmt/format.h>

#include <cmath>
#include <limits>
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

/// Watches the rows that the judge hands out: keeps the errors for the map, and finds the first uncovered sample.
class RowWatcher {
 public:
  RowWatcher(const HeightField& field, bool keep_errors) : field_(field) {
    if (keep_errors) {
      errors_.resize(static_cast<std::size_t>(field.cols) * static_cast<std::size_t>(field.rows),
                     std::numeric_limits<float>::quiet_NaN());
    }
  }

  void on_row(int row, std::span<const float> errors) {
    const std::size_t start = static_cast<std::size_t>(row) * static_cast<std::size_t>(field_.cols);
    if (!errors_.empty()) std::copy(errors.begin(), errors.end(), errors_.begin() + static_cast<std::ptrdiff_t>(start));
    if (uncovered_col_ >= 0) return;
    for (int col = 0; col < field_.cols; ++col) {
      if (std::isnan(errors[static_cast<std::size_t>(col)]) && is_in_domain(col, row)) {
        uncovered_col_ = col;
        uncovered_row_ = row;
        return;
      }
    }
  }

  /// "the first at column 3, row 7", or nothing.
  std::string uncovered_sample() const {
    return uncovered_col_ < 0 ? "" : fmt::format("the first at column {}, row {}", uncovered_col_, uncovered_row_);
  }
  std::span<const float> errors() const { return errors_; }

 private:
  bool is_valid(int col, int row) const {
    if (col < 0 || row < 0 || col >= field_.cols || row >= field_.rows) return false;
    const std::size_t at = static_cast<std::size_t>(row) * static_cast<std::size_t>(field_.cols);
    return std::isfinite(field_.samples[at + static_cast<std::size_t>(col)]);
  }
  /// A corner of a cell that has at least three valid corners.
  bool is_in_domain(int col, int row) const {
    if (!is_valid(col, row)) return false;
    for (const int dc : {-1, 1}) {
      for (const int dr : {-1, 1}) {
        const int others = is_valid(col + dc, row) + is_valid(col, row + dr) + is_valid(col + dc, row + dr);
        const bool inside = col + dc >= 0 && col + dc < field_.cols && row + dr >= 0 && row + dr < field_.rows;
        if (inside && others >= 2) return true;
      }
    }
    return false;
  }

  const HeightField& field_;
  std::vector<float> errors_;
  int uncovered_col_ = -1, uncovered_row_ = -1;
};

struct Judged {
  OwnedHeightField field;
  Mesh mesh;
  Measurement measured;
  std::optional<double> fail_above;
  std::optional<std::string> broken;  ///< why the mesh fails; nothing if it passes or nothing was asked
  int band = 1;
  std::vector<std::string> warnings;
  double seconds_read = 0, seconds_measure = 0, seconds_total = 0;
};

Json make_report(const Judged& judged, const std::string& mesh_path, const std::string& command_line) {
  Json report;
  report["scarp"] = version();
  report["command"] = command_line;
  report["input"] = describe_input(judged.field, judged.field.info, judged.band);
  report["frame"] = describe_frame(judged.field.frame);
  report["mesh"] = Json{{"path", mesh_path}, {"metadata", judged.mesh.metadata}};
  report["vertices"] = judged.measured.vertices;
  report["triangles"] = judged.measured.triangles;
  report["full_triangles"] = full_grid_triangles(judged.field);
  add_measurement(report, judged.measured, judged.field.sample_rounding);
  report["fail_above"] = judged.fail_above ? Json(*judged.fail_above) : Json(nullptr);
  report["passed"] = judged.fail_above ? Json(!judged.broken) : Json(nullptr);
  report["seconds"] =
      Json{{"read", judged.seconds_read}, {"measure", judged.seconds_measure}, {"total", judged.seconds_total}};
  report["warnings"] = judged.warnings;
  return report;
}

std::string make_table(const Judged& judged, const std::string& raster_path, const std::string& mesh_path) {
  const Measurement& m = judged.measured;
  const std::string unit = judged.field.info.unit.empty() ? "" : " " + judged.field.info.unit;
  const auto line = [](const char* name, const std::string& value) { return fmt::format("  {:<20}{}\n", name, value); };
  std::string text = fmt::format("{} judged by {}, {} x {}\n", base_name(mesh_path), base_name(raster_path),
                                 judged.field.cols, judged.field.rows);
  text += line("max error", fmt::format("{}{} at column {}, row {}", format_number(m.max_error), unit,
                                        m.max_error_at[0], m.max_error_at[1]));
  if (judged.field.sample_rounding > 0) {
    text += line(
        "", fmt::format("values rounded to float32 by up to {}{}", format_number(judged.field.sample_rounding), unit));
  }
  text += line("RMSE", format_number(m.rmse) + unit);
  text += line("mean error", format_number(m.mean_error) + unit);
  text += line("mean |error|", format_number(m.mean_abs_error) + unit);
  text += line("P50, P95", fmt::format("{}, {}", format_number(m.p50), format_number(m.p95)));
  text += line("P99, P99.9", fmt::format("{}, {}", format_number(m.p99), format_number(m.p999)));
  text += line("samples judged", format_count(m.samples));
  text += line("samples uncovered", format_count(m.uncovered));
  if (m.stray > 0) text += line("samples stray", format_count(m.stray) + ", outside every cell of the domain");
  text += line("void cells covered", format_count(m.void_cells_covered));
  text += line("vertices", format_count(m.vertices));
  const std::uint64_t full = full_grid_triangles(judged.field);
  text += line("triangles", fmt::format("{}, {} of the full grid's {}", format_count(m.triangles),
                                        format_share(static_cast<double>(m.triangles), static_cast<double>(full)),
                                        format_count(full)));
  text += line("smallest angle",
               fmt::format("{:.3g} degrees; of each triangle P1 {:.3g}, P5 {:.3g}, P50 {:.3g}", m.min_angle,
                           m.angle_percentiles[0], m.angle_percentiles[1], m.angle_percentiles[2]));
  const std::string faults = list_faults(m);
  const std::string border = m.closed ? "closed solid"
                                      : fmt::format("{} in {}", format_plural(m.open_edges, "open edge"),
                                                    format_plural(m.border_loops, "border loop"));
  text += line("topology", (faults.empty() ? "sound" : faults) + "; " + border);
  if (judged.fail_above) {
    text += judged.broken
                ? fmt::format("Failed: {}\n", *judged.broken)
                : fmt::format("Passed: max error {}{} is within {}, every sample is covered, the mesh is sound\n",
                              format_number(m.max_error), describe_rounding(judged.field.sample_rounding),
                              format_number(*judged.fail_above));
  }
  return text;
}

}  // namespace

MeasureCommand::MeasureCommand(CLI::App& program)
    : verb_(program.add_subcommand("measure", "Judge a mesh file against its raster, sample by sample")) {
  verb_->add_option("RASTER", raster_.path, "Raster of heights: a file or URL that GDAL opens, PGM or STM")
      ->type_name("")
      ->required();
  verb_->add_option("MESH", mesh_, "Mesh to judge: GLB, OBJ, PLY or STL, recognised by content")
      ->type_name("")
      ->required();
  raster_.add_to(
      *verb_,
      "Coordinates of the mesh: source, local, grid or a CRS\nsuch as EPSG:32611. Default: what the mesh file "
      "says of\nitself, else what simplify does by default");
  points_.add_to(*verb_);
  verb_
      ->add_option("--fail-above", fail_above_,
                   "End with exit code 3 if any error is above this (units\nof the heights), a sample is uncovered or "
                   "the mesh is\nnot sound")
      ->type_name("E")
      ->group("Verdict");
  verb_->add_flag("--json", json_, "The report as JSON on stdout")->group("Output");
  verb_->add_option("--map", map_, "Draw the signed errors in diverging colours")
      ->type_name("FILE.png")
      ->group("Output");
  verb_->add_flag("--overwrite", overwrite_, "Replace a map that exists (default: refuse)")->group("Output");
  verb_->add_option("-j,--num-threads", threads_, "Threads, 0 = all cores (default); never changes the result")
      ->type_name("N")
      ->group("Run");
  verb_->add_flag("-q,--quiet", quiet_, "No table, no progress, no warnings")->group("Run");
  verb_->add_flag("--json-progress", json_progress_, "Progress as one JSON object a line on stderr")->group("Run");
  verb_->footer(
      "Examples:\n"
      "  scarp measure dem.tif hills.glb                   a table of errors and faults\n"
      "  scarp measure dem.tif hills.glb --fail-above 1    exit code 3 unless every error is within 1 m\n"
      "  scarp measure dem.tif hills.obj --json --map error.png\n"
      "Errors are vertical, mesh minus sample, in the units of the heights.\n"
      "Exit codes: 0 ok, 1 usage, 2 input, 3 promise not met, 4 output, 5 interrupted, 70 internal error.");
}

Result<void> MeasureCommand::run(const std::string& command_line) const {
  const Clock::time_point start = Clock::now();
  if (points_.are_meant(raster_.path)) {
    return run_measure_points(*verb_,
                              {raster_.path, mesh_, raster_.crs, fail_above_, threads_, json_, quiet_, json_progress_},
                              points_, command_line);
  }
  if (auto unused = points_.check_unused(raster_.path); !unused) return unused;
  Judged judged;
  Result<ReadOptions> read = raster_.parse();
  if (!read) return tl::unexpected(std::move(read.error()));
  judged.band = read->band;
  const Result<int> threads = parse_threads(threads_);
  if (!threads) return tl::unexpected(threads.error());
  if (fail_above_) {
    const Result<double> bound = parse_non_negative("--fail-above", *fail_above_);
    if (!bound) return tl::unexpected(bound.error());
    judged.fail_above = *bound;
  }
  if (map_) {
    const PlannedOutput map{"--map", *map_};
    const Result<void> named = check_png_name(map);
    if (!named) return named;
    const Result<void> checked = check_outputs({map}, {raster_.path, mesh_}, overwrite_);
    if (!checked) return checked;
    if (json_ && is_stdout(*map_)) {
      return fail(ErrorKind::kUsage, "--json and --map /dev/stdout both write to standard output");
    }
  }

  ProgressDisplay display(ProgressDisplay::choose(json_progress_, quiet_));
  Result<Mesh> mesh = read_mesh(mesh_);
  if (!mesh) return tl::unexpected(std::move(mesh.error()));
  judged.mesh = std::move(*mesh);
  const auto crs_of_mesh = judged.mesh.metadata.find("crs_option");
  const bool crs_from_mesh = !raster_.crs && crs_of_mesh != judged.mesh.metadata.end();
  if (crs_from_mesh) read->crs = crs_of_mesh->second;
  read->progress = display.callback();
  Result<OwnedHeightField> field = read_height_field(raster_.path, *read);
  if (!field) {
    if (crs_from_mesh && field.error().kind == ErrorKind::kUsage) {
      field.error().message += fmt::format("; {} names that CRS as its own, --crs overrides it", mesh_);
    }
    return tl::unexpected(std::move(field.error()));
  }
  judged.field = std::move(*field);
  judged.warnings = judged.field.info.warnings;
  judged.seconds_read = seconds_since(start);

  const Clock::time_point measure_start = Clock::now();
  const HeightField view = judged.field.view();
  RowWatcher watcher(view, map_.has_value());
  MeasureOptions options;
  options.threads = *threads;
  options.progress = display.callback();
  options.on_row = [&watcher](int row, std::span<const float> errors) { watcher.on_row(row, errors); };
  Result<Measurement> measured = measure(view, judged.mesh, options);
  if (!measured) return tl::unexpected(std::move(measured.error()));
  judged.measured = std::move(*measured);
  judged.seconds_measure = seconds_since(measure_start);
  if (judged.fail_above) {
    judged.broken = find_broken_promise(judged.measured, view.sample_rounding, *judged.fail_above, height_range(view),
                                        watcher.uncovered_sample());
  }
  if (judged.measured.samples == 0) {
    judged.warnings.push_back(fmt::format(
        "no sample of {} is covered by {}: do they have the same coordinates (--crs)?", raster_.path, mesh_));
  }
  if (interrupted()) return fail(ErrorKind::kCancelled, "interrupted");

  if (map_) {
    const Result<std::vector<std::uint8_t>> png = encode_png(draw_error_map(watcher.errors(), view.cols, view.rows));
    if (!png) return tl::unexpected(png.error());
    const Result<void> written = write_file(*map_, *png, overwrite_);
    if (!written) return written;
  }
  display.finish();
  judged.seconds_total = seconds_since(start);

  if (!quiet_) print_warnings(judged.warnings);
  if (json_) {
    const Result<void> printed = print_to_stdout(to_text(make_report(judged, mesh_, command_line)));
    if (!printed) return printed;
  } else if (!quiet_) {
    const std::string table = make_table(judged, raster_.path, mesh_);
    if (map_ && is_stdout(*map_)) {
      print_to_stderr(table);
    } else {
      const Result<void> printed = print_to_stdout(table);
      if (!printed) return printed;
    }
  }
  if (judged.broken) return fail(ErrorKind::kPromise, fmt::format("{}: {}", mesh_, *judged.broken));
  return {};
}

}  // namespace scarp::cli
