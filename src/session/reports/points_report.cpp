#include "session/reports/points_report.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "scarp/version.h"
#include "session/options/points_options.h"
#include "session/options/region_options.h"
#include "session/options/strategy_options.h"
#include "session/options/strategy_words.h"
#include "session/reports/level_report.h"
#include "session/reports/report.h"
#include "session/reports/shape_report.h"
#include "session/reports/verdict.h"
#include "session/text/json_text.h"
#include "session/text/text.h"

namespace scarp::cli {
namespace {

std::string describe_place(const PointSet& points, const Measurement& measured) {
  if (measured.max_error_at[0] < 0) return "no point";
  const auto i = static_cast<std::size_t>(measured.max_error_at[0]);
  const auto [x, y] = points.place_in_file(i);
  return fmt::format("{:.12g}, {:.12g}", x, y);
}

Json describe_points(const PointSet& points, DuplicatePolicy policy, std::uint64_t duplicates) {
  const HeightRange heights = height_range(points);
  Json json{{"path", points.path},
            {"format", points.format},
            {"points", points.size()},
            {"lines", points.lines.size()},
            {"duplicates", duplicates},
            {"duplicate_policy", policy_name(policy)},
            {"min", heights.min},
            {"max", heights.max},
            {"crs", points.is_local ? points.source_crs : points.crs},
            {"unit", points.heights.unit},
            {"columns", points.columns},
            {"without_height", points.without_height},
            {"spikes", points.spikes},
            {"outside", points.outside}};
  if (points.las) json["las"] = describe_las(*points.las);
  return json;
}

Json describe_frame(const PointSet& points) { return Json{{"crs", points.crs}, {"description", points.description}}; }

/// x and y of a point in its file; null if `point` is negative.
Json place_of(const PointSet& points, std::int64_t point) {
  if (point < 0) return nullptr;
  return points.place_in_file(static_cast<std::size_t>(point));
}

void add_point_measurement(Json& report, const PointSet& points, const Measurement& measured) {
  add_errors(report, measured, 0);
  add_coverage(report, measured);
  report["max_error_at"] = place_of(points, measured.max_error_at[0]);
}

}  // namespace

std::string left_out(const PointSet& points) {
  std::string text;
  const auto add = [&](std::uint64_t count, const char* what) {
    if (count > 0) text += fmt::format("{}{} {}", text.empty() ? "" : ", ", format_count(count), what);
  };
  add(points.without_height, "without a height");
  add(points.spikes, "as outliers");
  add(points.outside, "outside the rectangle");
  if (points.las) {
    add(points.las->withheld, "withheld");
    add(points.las->of_other_classes, "of other classes");
    add(points.las->overlap, "in overlaps");
    add(points.las->of_other_returns, "of other returns");
  }
  return text.empty() ? "" : fmt::format(" ({} left out)", text);
}

Json describe_las(const LasFacts& las) {
  Json classes = Json::object();
  for (const PointClass& of : las.classes) classes[fmt::format("{}", of.number)] = of.points;
  return Json{{"version", las.version},   {"point_format", las.point_format},
              {"points", las.points},     {"classes", classes},
              {"withheld", las.withheld}, {"of_other_classes", las.of_other_classes},
              {"overlap", las.overlap},   {"of_other_returns", las.of_other_returns}};
}

HeightRange height_range(const PointSet& points) {
  const auto [least, most] = std::minmax_element(points.z.begin(), points.z.end());
  return {points.size(), *least, *most};
}

std::optional<std::string> find_broken(const PointSet& points, const Measurement& measured, double bound) {
  if (!(measured.max_error <= bound + judge::judging_allowance(bound, height_range(points))))
    return fmt::format("max error {:.10g} at {} exceeds {:.10g}", measured.max_error, describe_place(points, measured),
                       bound);
  if (measured.uncovered > 0)
    return fmt::format("{} covered by no triangle",
                       measured.uncovered == 1 ? "1 point is" : format_count(measured.uncovered) + " points are");
  if (!measured.is_sound()) return "the mesh is not sound: " + list_faults(measured);
  return std::nullopt;
}

std::string PointsOutcome::frame() const {
  if (!centre) return points.description;
  return fmt::format("local: offsets from {:.12g}, {:.12g} of {}", (*centre)[0], (*centre)[1], points.description);
}

Json make_report(const SimplifyPlan& plan, const PointsOutcome& outcome, const std::vector<ReadyFile>& files,
                 const std::string& command_line) {
  Json report;
  report["scarp"] = version();
  report["command"] = command_line;
  report["input"] = describe_points(outcome.points, outcome.policy, outcome.duplicates);
  report["input"]["points"] = outcome.count();
  report["input"]["on_hull"] = outcome.on_hull;
  report["input"]["lattice_step"] = outcome.lattice_step;
  report["input"]["boundary"] = outcome.boundary;
  if (outcome.cut) {
    report["input"]["boundary_cut"] = Json{{"points_outside", outcome.cut->points_outside},
                                           {"corners", outcome.cut->corners},
                                           {"corners_beyond", outcome.cut->corners_beyond},
                                           {"farthest", outcome.cut->farthest}};
  }
  report["input"]["suggested_boundary"] =
      or_null(outcome.suggested_boundary.empty() ? Given() : Given(outcome.suggested_boundary));
  report["frame"] = describe_frame(outcome.points);
  if (outcome.centre) {
    report["frame"] = Json{{"crs", ""},
                           {"description", outcome.frame()},
                           {"origin", *outcome.centre},
                           {"origin_crs", or_null(outcome.points.crs.empty() ? Given() : Given(outcome.points.crs))}};
  }
  report["goal"] = describe_goal(plan, outcome);
  for (const PointLake& lake : outcome.lakes) {
    report["water"].push_back(
        Json{{"level", std::isnan(lake.level) ? Json(nullptr) : Json(lake.level)}, {"points_dropped", lake.dropped}});
  }
  report["strategy"] = Json{{"effort", effort_name(outcome.simplified.effort)},
                            {"vertices", name_of(outcome.simplified.vertices, kVertexWords)}};
  if (find_tolerance(plan.given)) {
    report["strategy"]["tolerance"] = or_null(plan.given[OptionId::kTolerance]);
    report["strategy"]["roi"] = plan.given.all(OptionId::kRoi);
    report["strategy"]["falloff"] = or_null(plan.given[OptionId::kFalloff]);
    report["with_tolerance"] = outcome.with_tolerance;
    report["tolerance_factor"] = outcome.simplified.tolerance_factor;
  }
  report["stopped_by"] = stop_name(outcome.simplified.stop);
  report["vertices"] = outcome.vertices;
  report["triangles"] = outcome.triangles;
  if (!outcome.points.lines.empty()) {
    report["flat_triangles"] = outcome.flat;
    report["loose_pieces"] = outcome.loose;
  }
  add_point_measurement(report, outcome.points, outcome.simplified.measurement);
  add_solid(report, plan, outcome);
  report["shape"] = describe_shape(plan.simplify.quality.shape, outcome.simplified);
  report["levels"] = describe_levels(plan, outcome);
  for (Json& level : report["levels"]) {
    level["max_error_at"] = place_of(outcome.points, level["max_error_at"][0].get<std::int64_t>());
  }
  report["passes"] = describe_passes(outcome);
  report["seconds"] = describe_seconds(outcome);
  report["outputs"] = describe_outputs(files);
  report["warnings"] = outcome.warnings;
  return report;
}

std::string make_summary(const SimplifyPlan& plan, const PointsOutcome& outcome, const std::vector<ReadyFile>& files) {
  const Measurement& measured = outcome.simplified.measurement;
  const HeightRange heights = height_range(outcome.points);
  std::string text = fmt::format("{} -> {}\n", base_name(outcome.points.path), plan.output);
  text += summary_line("points",
                       fmt::format("{}{}, heights {} to {}", format_count(outcome.count()), left_out(outcome.points),
                                   format_number(heights.min), format_number(heights.max)));
  if (!outcome.points.columns.empty()) text += summary_line("read as", outcome.points.columns);
  if (!outcome.points.lines.empty())
    text += summary_line("lines", format_count(outcome.points.lines.size()) + ", each a chain of edges");
  if (!outcome.lakes.empty()) {
    std::uint64_t dropped = 0;
    for (const PointLake& lake : outcome.lakes) dropped += lake.dropped;
    text += summary_line("water", fmt::format("{}{}, {} in them left out", format_plural(outcome.lakes.size(), "lake"),
                                              outcome.lakes.size() == 1 && !std::isnan(outcome.lakes.front().level)
                                                  ? " at " + format_number(outcome.lakes.front().level)
                                                  : "",
                                              format_plural(dropped, "point")));
  }
  if (outcome.cut)
    text += summary_line("boundary", fmt::format("{}: {}, {} outside left out", base_name(outcome.boundary),
                                                 format_plural(outcome.cut->corners, "corner"),
                                                 format_plural(outcome.cut->points_outside, "point")));
  text += summary_line("duplicates", outcome.duplicates == 0
                                         ? "none"
                                         : fmt::format("{}, the {} of each place counts",
                                                       format_count(outcome.duplicates), policy_name(outcome.policy)));
  text += summary_line("lattice step", format_number(outcome.lattice_step));
  text += files_lines(plan, files);
  if (outcome.cell_size) text += summary_line("cell size", format_number(*outcome.cell_size));
  text += summary_line(
      "vertices", fmt::format("{}, {} of the points, {} on the {}", format_count(outcome.vertices),
                              format_share(static_cast<double>(outcome.vertices), static_cast<double>(outcome.count())),
                              format_count(outcome.on_hull), outcome.cut ? "boundary" : "hull"));
  const std::string flats =
      fmt::format(", {} ({}) flat between points of equal height", format_count(outcome.flat),
                  format_share(static_cast<double>(outcome.flat), static_cast<double>(outcome.triangles)));
  text += summary_line("triangles", format_count(outcome.triangles) + (outcome.points.lines.empty() ? "" : flats));
  text += solid_line(plan, outcome);
  text += shape_line(plan.simplify.quality.shape, outcome.simplified);
  text += levels_lines(outcome);
  text += summary_line("effort", effort_name(outcome.simplified.effort));
  text += summary_line("frame", outcome.frame());
  text += summary_line("max error", fmt::format("{} at {}{}", format_number(measured.max_error),
                                                describe_place(outcome.points, measured), describe_asked(outcome)));
  text += summary_line("RMSE", format_number(measured.rmse));
  if (outcome.with_tolerance > 0)
    text +=
        summary_line("tolerances", format_plural(outcome.with_tolerance, "point") +
                                       (outcome.simplified.tolerance_factor > 1
                                            ? ", all kept times " + format_number(outcome.simplified.tolerance_factor)
                                            : ", all kept"));
  text += summary_line("judged", format_plural(measured.samples, "point") + ", none uncovered");
  return text + seconds_line(outcome) +
         describe_end(plan, outcome, measured.max_error == 0 ? "Reproduced every point" : nullptr);
}

std::string describe_over_tolerance(const PointSet& points, const Measurement& measured) {
  const auto& worst =
      *std::max_element(measured.offenders.begin(), measured.offenders.end(),
                        [](const Offender& a, const Offender& b) { return std::abs(a.error) < std::abs(b.error); });
  const auto [x, y] = points.place_in_file(static_cast<std::size_t>(worst.col));
  return fmt::format("the error at {} is above the tolerance there, such as {:.6g} at {:.12g}, {:.12g}",
                     format_plural(measured.over_tolerance, "point"), std::abs(worst.error), x, y);
}

Json make_report(const JudgedPoints& judged, const std::string& mesh_path, const std::string& command_line) {
  Json report;
  report["scarp"] = version();
  report["command"] = command_line;
  report["input"] = describe_points(judged.points, judged.policy, judged.duplicates());
  report["input"]["points"] = judged.count();
  report["frame"] = describe_frame(judged.points);
  report["mesh"] = Json{{"path", mesh_path}, {"metadata", judged.mesh.metadata}};
  report["vertices"] = judged.measured.vertices;
  report["triangles"] = judged.measured.triangles;
  add_point_measurement(report, judged.points, judged.measured);
  report["fail_above"] = or_null(judged.fail_above);
  if (judged.has_tolerances) report["over_tolerance"] = judged.measured.over_tolerance;
  report["passed"] = judged.fail_above || judged.broken ? Json(!judged.broken) : Json(nullptr);
  report["seconds"] =
      Json{{"read", judged.seconds_read}, {"measure", judged.seconds_measure}, {"total", judged.seconds_total}};
  report["warnings"] = judged.points.warnings;
  return report;
}

std::string make_table(const JudgedPoints& judged, const std::string& mesh_path) {
  const Measurement& m = judged.measured;
  const auto line = [](const char* name, const std::string& value) { return fmt::format("  {:<20}{}\n", name, value); };
  std::string text = fmt::format("{} judged by {}, {}\n", base_name(mesh_path), base_name(judged.points.path),
                                 format_plural(judged.count(), "point"));
  if (m.samples == 0) {
    text += line("max error", "none: no point is covered");
  } else {
    text += line("max error", fmt::format("{} at {}", format_number(m.max_error), describe_place(judged.points, m)));
    text += line("RMSE", format_number(m.rmse));
    text += line("mean error", format_number(m.mean_error));
    text += line("mean |error|", format_number(m.mean_abs_error));
    text += line("P50, P95", fmt::format("{}, {}", format_number(m.p50), format_number(m.p95)));
    text += line("P99, P99.9", fmt::format("{}, {}", format_number(m.p99), format_number(m.p999)));
  }
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
  if (judged.has_tolerances)
    text +=
        line("tolerances", m.over_tolerance == 0 ? "kept" : "broken at " + format_plural(m.over_tolerance, "point"));
  if (judged.fail_above || judged.has_tolerances) {
    const std::string bound = judged.fail_above ? " " + format_number(*judged.fail_above) : "";
    text += line("verdict",
                 (judged.broken ? "FAILS" : "keeps") + (judged.has_tolerances ? bound + " and the tolerances" : bound));
  }
  return text;
}

}  // namespace scarp::cli
