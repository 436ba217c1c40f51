#include "session/reports/measure_report.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "scarp/version.h"
#include "session/reports/feature_report.h"
#include "session/reports/place.h"
#include "session/reports/report.h"
#include "session/reports/verdict.h"
#include "session/text/json_text.h"
#include "session/text/text.h"

namespace scarp::cli {
namespace {

std::string line(const char* name, const std::string& value) { return fmt::format("  {:<20}{}\n", name, value); }

std::string describe_place(const std::array<std::int32_t, 2>& at) {
  return fmt::format("at column {}, row {}", at[0], at[1]);
}

/// The reason why weighed errors fail, if they do.
std::optional<std::string> find_excess(const Judged& judged) {
  const double rounding = judged.field.sample_rounding;
  if (judged.judgement.weighted && judged.companions.has_tolerance() && judged.judgement.weighted->over > 0) {
    return fmt::format("{} above {} tolerance, the worst {:.10g} times {}{}",
                       judged.judgement.weighted->over == 1
                           ? "1 sample is"
                           : format_count(judged.judgement.weighted->over) + " samples are",
                       judged.judgement.weighted->over == 1 ? "its" : "their", judged.judgement.weighted->bounded.value,
                       describe_place(judged.judgement.weighted->bounded.at), describe_rounding(rounding));
  }
  if (!judged.fail_above) return std::nullopt;
  const bool has_mask = !judged.companions.mask.empty();
  const std::optional<judge::WeighedErrors>& errors = has_mask ? judged.judgement.weighted : judged.judgement.combined;
  if (!errors || errors->over == 0) return std::nullopt;
  return fmt::format("{} max error {:.10g} {}{} exceeds {:.10g}", has_mask ? "weighted" : "combined",
                     errors->bounded.value, describe_place(errors->bounded.at), describe_rounding(rounding),
                     *judged.fail_above);
}

std::string describe_heights(const Judged& judged) {
  const Measurement& m = judged.judgement.heights;
  if (m.samples == 0) return line("max error", "none: no sample is covered");
  const std::string unit = judged.field.info.unit.empty() ? "" : " " + judged.field.info.unit;
  std::string text;
  text += line("max error", fmt::format("{}{} at column {}, row {}", format_number(m.max_error), unit,
                                        m.max_error_at[0], m.max_error_at[1]));
  if (const auto place = find_place(judged.field.info, m.max_error_at)) text += line("", "at " + describe(*place));
  if (judged.field.sample_rounding > 0) {
    text += line(
        "", fmt::format("values rounded to float32 by up to {}{}", format_number(judged.field.sample_rounding), unit));
  }
  text += line("RMSE", format_number(m.rmse) + unit);
  text += line("mean error", format_number(m.mean_error) + unit);
  text += line("mean |error|", format_number(m.mean_abs_error) + unit);
  text += line("P50, P95", fmt::format("{}, {}", format_number(m.p50), format_number(m.p95)));
  text += line("P99, P99.9", fmt::format("{}, {}", format_number(m.p99), format_number(m.p999)));
  return text;
}

/// Describes channels, masks and tolerances.
std::string describe_weighed(const Judged& judged) {
  std::string text;
  if (judged.judgement.heights.samples == 0) return text;
  constexpr std::size_t kMostLines = 8;
  for (std::size_t k = 0; k < std::min(kMostLines, judged.judgement.channels.size()); ++k) {
    const Measurement& channel = judged.judgement.channels[k];
    text += line(judged.channels.names[k].c_str(),
                 fmt::format("max error {} {}, RMSE {}", format_number(channel.max_error),
                             describe_place(channel.max_error_at), format_number(channel.rmse)));
  }
  if (judged.channels.count() > kMostLines) text += line("", "further bands: see --json");
  if (judged.judgement.combined) {
    text += line("combined",
                 fmt::format("max error {} {} ({})", format_number(judged.judgement.combined->largest.value),
                             describe_place(judged.judgement.combined->largest.at), norm_name(judged.plan.norm)));
  }
  if (judged.judgement.weighted) {
    const bool has_mask = !judged.companions.mask.empty();
    text += line("weighted", fmt::format("{} {} {}, RMS {}", has_mask ? "max error" : "largest error / tolerance",
                                         format_number(judged.judgement.weighted->largest.value),
                                         describe_place(judged.judgement.weighted->largest.at),
                                         format_number(judged.judgement.weighted->rmse)));
  }
  if (judged.judgement.ignored > 0) {
    const judge::LargestError bounded = judged.bounded();
    text += line("samples ignored", format_count(judged.judgement.ignored) + ", without a bound");
    text += line("max error, bounded",
                 format_number(bounded.value) + (bounded.at[0] < 0 ? "" : " " + describe_place(bounded.at)));
  }
  return text;
}

std::string describe_pass(const Judged& judged) {
  std::string kept;
  if (judged.companions.has_tolerance()) kept = "every sample is within its tolerance";
  if (judged.fail_above) {
    const bool has_mask = !judged.companions.mask.empty();
    const double error = has_mask                    ? judged.judgement.weighted->bounded.value
                         : judged.judgement.combined ? judged.judgement.combined->bounded.value
                                                     : judged.judgement.bounded.value;
    kept += fmt::format("{}{}max error {}{}{} is within {}", kept.empty() ? "" : ", ",
                        has_mask                    ? "weighted "
                        : judged.judgement.combined ? "combined "
                                                    : "",
                        format_number(error), judged.judgement.ignored > 0 ? " of the bounded samples" : "",
                        describe_rounding(judged.field.sample_rounding), format_number(*judged.fail_above));
  }
  return fmt::format("Passed: {}, every sample is covered, the mesh is sound\n", kept);
}

}  // namespace

void decide(Judged& judged) {
  if (!judged.has_verdict()) return;
  judged.broken = find_excess(judged);
  if (judged.broken) return;
  const bool bounds_heights = judged.fail_above && judged.channels.empty() && judged.companions.mask.empty();
  Measurement bounded = judged.judgement.heights;
  bounded.max_error = judged.judgement.bounded.value;
  bounded.max_error_at = judged.judgement.bounded.at;
  judged.broken = find_broken_promise(bounded, judged.field.sample_rounding,
                                      bounds_heights ? *judged.fail_above : HUGE_VAL, bounded.heights);
}

Json make_report(const Judged& judged, const std::string& mesh_path, const GivenOptions& cutline,
                 const std::string& command_line) {
  Json report;
  report["scarp"] = version();
  report["command"] = command_line;
  report["input"] = describe_input(judged.field, judged.field.info, judged.band);
  report["frame"] = describe_frame(judged.field.frame, judged.field.info, judged.field.rows);
  report["mesh"] = Json{{"path", mesh_path}, {"metadata", judged.mesh.metadata}};
  report["vertices"] = judged.judgement.heights.vertices;
  report["triangles"] = judged.judgement.heights.triangles;
  report["full_triangles"] = full_grid_triangles(judged.field);
  const bool is_judged = judged.judgement.heights.samples > 0;
  if (!judged.plan.image) {
    add_errors(report, judged.judgement.heights, judged.field.sample_rounding);
    report["max_error_place"] =
        is_judged ? to_json(find_place(judged.field.info, judged.judgement.heights.max_error_at)) : Json(nullptr);
  }
  if (judged.judgement.weighted && is_judged) {
    report["weighted_max_error"] = finite_or_word(judged.judgement.weighted->largest.value);
    report["weighted_rmse"] = finite_or_word(judged.judgement.weighted->rmse);
    if (judged.companions.has_tolerance()) report["over_tolerance"] = judged.judgement.weighted->over;
  }
  if (judged.judgement.weighted || judged.companions.script.size() > 0) report["ignored"] = judged.judgement.ignored;
  if (judged.judgement.ignored > 0) add_bounded(report, judged.bounded());
  if (judged.judgement.combined) {
    report["norm"] = norm_name(judged.plan.norm);
    report["height_scale"] = judged.channels.height_scale;
    report["combined_max_error"] = is_judged ? Json(judged.judgement.combined->largest.value) : Json(nullptr);
    report["channels"] = describe_channels(judged.channels.names, judged.channels.scales, judged.judgement.channels);
  }
  report["cutline"] = describe_cut(cutline, judged.cut, judged.judgement.heights.cut_off);
  add_coverage(report, judged.judgement.heights);
  report["fail_above"] = judged.fail_above ? Json(*judged.fail_above) : Json(nullptr);
  report["passed"] = judged.has_verdict() || judged.broken ? Json(!judged.broken) : Json(nullptr);
  report["seconds"] =
      Json{{"read", judged.seconds_read}, {"measure", judged.seconds_measure}, {"total", judged.seconds_total}};
  report["warnings"] = judged.warnings;
  return report;
}

std::string make_table(const Judged& judged, const std::string& raster_path, const std::string& mesh_path) {
  const Measurement& m = judged.judgement.heights;
  std::string text = fmt::format("{} judged by {}, {} x {}\n", base_name(mesh_path), base_name(raster_path),
                                 judged.field.cols, judged.field.rows);
  if (!judged.field.info.file_unit.empty())
    text += line("heights", fmt::format("in {}, of the file's {}",
                                        judged.field.info.unit.empty() ? "units" : judged.field.info.unit,
                                        judged.field.info.file_unit));
  if (!judged.plan.image) text += describe_heights(judged);
  text += describe_weighed(judged);
  text += line("samples judged", format_count(m.samples));
  text += line("samples uncovered", format_count(m.uncovered));
  if (judged.cut.polygons > 0) text += line("cutline", cut_words(judged.cut, m.cut_off));
  if (m.stray > 0) text += line("samples stray", format_count(m.stray) + ", outside every cell of the domain");
  text += line("nodata covered", format_count(m.nodata_cells_covered));
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
  if (!judged.has_verdict() && !judged.broken) return text;
  return text + (judged.broken ? fmt::format("Failed: {}\n", *judged.broken) : describe_pass(judged));
}

}  // namespace scarp::cli
