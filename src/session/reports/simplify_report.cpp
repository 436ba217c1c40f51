#include "session/reports/simplify_report.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <utility>

#include "scarp/version.h"
#include "session/options/strategy_options.h"
#include "session/reports/feature_report.h"
#include "session/reports/level_report.h"
#include "session/reports/place.h"
#include "session/reports/report.h"
#include "session/reports/shape_report.h"
#include "session/reports/strategy_report.h"
#include "session/text/json_text.h"
#include "session/text/text.h"

namespace scarp::cli {
namespace {

using enum OptionId;

bool has_tolerance_and_budget(const SimplifyPlan& plan, const Outcome& outcome) {
  return outcome.companions.has_tolerance() && (plan.simplify.goals.max_triangles || plan.simplify.goals.max_vertices);
}

/// Adds errors of heights and channels, plain and weighted.
void add_all_errors(Json& report, const SimplifyPlan& plan, const Outcome& outcome) {
  const Simplified& simplified = outcome.simplified;
  if (!plan.channels.image) add_errors(report, simplified.measurement, outcome.field.sample_rounding);
  if (outcome.companions.has_weights()) {
    report["weighted_max_error"] = finite_or_word(simplified.weighted_max_error);
    report["weighted_rmse"] = finite_or_word(simplified.weighted_rmse);
    if (has_tolerance_and_budget(plan, outcome))
      report["tolerance_factor"] = finite_or_word(simplified.tolerance_factor);
  }
  report["ignored"] = simplified.ignored;
  if (outcome.bounded) add_bounded(report, *outcome.bounded);
  if (!outcome.channels.empty()) {
    report["norm"] = norm_name(plan.channels.norm);
    report["height_scale"] = outcome.channels.height_scale;
    report["combined_max_error"] = simplified.combined_max_error;
    report["channels"] =
        describe_channels(outcome.channels.names, outcome.channels.scales, simplified.channel_measurements);
  }
  if (outcome.psnr) report["psnr"] = finite_or_word(*outcome.psnr);
}

/// ", ignored samples left out", or "": words for samples without a bound.
const char* describe_exceptions(const Outcome& outcome) {
  return outcome.companions.ignores_samples() ? ", ignored samples left out" : "";
}

/// The summary's lines on errors.
std::string describe_errors(const SimplifyPlan& plan, const Outcome& outcome) {
  const Simplified& simplified = outcome.simplified;
  const Measurement& measured = simplified.measurement;
  const std::string unit = outcome.as_read.unit.empty() ? "" : " " + outcome.as_read.unit;
  const std::string asked = describe_asked(outcome, describe_exceptions(outcome));
  const bool bounds_heights = outcome.channels.empty() && outcome.companions.mask.empty();
  std::string text;
  if (!plan.channels.image) {
    text += summary_line("max error",
                         fmt::format("{}{} at column {}, row {}{}", format_number(measured.max_error), unit,
                                     measured.max_error_at[0], measured.max_error_at[1], bounds_heights ? asked : ""));
    if (const auto place = find_place(outcome.as_read, measured.max_error_at))
      text += summary_line("", "at " + describe(*place));
    if (outcome.field.sample_rounding > 0) {
      text += summary_line("", fmt::format("values rounded to float32 by up to {}{}",
                                           format_number(outcome.field.sample_rounding), unit));
    }
    text += summary_line("RMSE", fmt::format("{}{}", format_number(measured.rmse), unit));
  }
  constexpr std::size_t kMostLines = 8;
  for (std::size_t k = 0; k < std::min(kMostLines, simplified.channel_measurements.size()); ++k) {
    const Measurement& channel = simplified.channel_measurements[k];
    text += summary_line(
        outcome.channels.names[k].c_str(),
        fmt::format("max error {}, RMSE {}", format_number(channel.max_error), format_number(channel.rmse)));
  }
  if (outcome.channels.count() > kMostLines) text += summary_line("", "further bands: see --report");
  if (!outcome.channels.empty()) {
    text += summary_line("combined",
                         fmt::format("max error {} ({}){}", format_number(simplified.combined_max_error),
                                     norm_name(plan.channels.norm), outcome.companions.has_weights() ? "" : asked));
  }
  if (outcome.companions.has_weights()) {
    const bool has_mask = !outcome.companions.mask.empty();
    text +=
        summary_line("weighted", fmt::format("{} {}, RMS {}{}", has_mask ? "max error" : "largest error / tolerance",
                                             format_number(simplified.weighted_max_error),
                                             format_number(simplified.weighted_rmse), has_mask ? asked : ""));
  }
  if (has_tolerance_and_budget(plan, outcome) && simplified.tolerance_factor > 1)
    text +=
        summary_line("", std::isinf(simplified.tolerance_factor)
                             ? "a tolerance of 0 is not kept"
                             : fmt::format("kept: tolerances times {}", format_number(simplified.tolerance_factor)));
  if (simplified.ignored > 0) {
    text += summary_line("ignored", fmt::format("{} without a bound; max error of the others {}",
                                                format_plural(simplified.ignored, "sample"),
                                                format_number(outcome.bounded.value_or(judge::LargestError()).value)));
  }
  return text;
}

/// The last line of the summary.
std::string describe_ending(const SimplifyPlan& plan, const Outcome& outcome) {
  if (outcome.simplified.stop == StopReason::kMaxError && outcome.companions.has_tolerance() &&
      !outcome.simplified.is_cut_short)
    return fmt::format("Kept every tolerance, after {} s\n", format_seconds(outcome.seconds_total));
  const bool is_exact =
      find_goal_error(outcome).value == 0 && outcome.simplified.ignored == 0 && outcome.field.sample_rounding == 0;
  return describe_end(plan, outcome, is_exact ? "Reproduced every sample" : nullptr);
}

/// The reason for fast effort if it was not requested; empty for other efforts.
std::string explain_effort(const SimplifyPlan& plan, const Simplified& simplified) {
  switch (simplified.why_fast) {
    case WhyFast::kNone:
      break;
    case WhyFast::kOrder:
      return "because of --order greedy; --effort normal takes fewer triangles";
    case WhyFast::kStrategy:
      return fmt::format("because of {}: strategies only insert vertices", plan.strategy_option);
    case WhyFast::kMemory:
      return "because of --memory: removing vertices needs more";
    case WhyFast::kBudget:
      return "no mesh of normal effort within the budget was better";
  }
  return "";
}

std::string describe_effort(const SimplifyPlan& plan, const Simplified& simplified) {
  const std::string why = explain_effort(plan, simplified);
  return fmt::format("{}{}", effort_name(simplified.effort), why.empty() ? "" : " (" + why + ")");
}

/// A line of the summary; empty unless outlines need most of the mesh.
std::string outline_line(const SimplifyPlan& plan, const Outcome& outcome) {
  constexpr std::uint64_t kFew = 100;
  const std::uint64_t least = outcome.simplified.outline_triangles;
  if (least < kFew || 2 * least < outcome.triangles) return "";
  const std::uint64_t at_one = outcome.simplified.outline_triangles_at_one;
  const std::string fewer = at_one > 0 ? fmt::format("1 takes {}", format_count(at_one)) : std::string("takes fewer");
  return summary_line("outlines", fmt::format("of nodata and border alone need {}: --nodata-policy outline={}{}",
                                              format_plural(least, "triangle"), fewer,
                                              plan.memory && outcome.field.source ? ", without --memory" : ""));
}

}  // namespace

GoalError find_goal_error(const Outcome& outcome) {
  const Simplified& simplified = outcome.simplified;
  const auto goal = [&](double of_all, const char* name, bool is_rounded) {
    return GoalError{outcome.bounded_goal.value_or(of_all), name, is_rounded};
  };
  if (outcome.companions.has_tolerance()) {
    return goal(simplified.weighted_max_error, "largest error / tolerance", true);
  }
  if (!outcome.companions.mask.empty()) return goal(simplified.weighted_max_error, "weighted max error", true);
  if (!outcome.channels.empty()) return goal(simplified.combined_max_error, "combined max error", true);
  return goal(simplified.measurement.max_error, "max error", false);
}

namespace {

using enum OptionId;

/// A note about STL, which holds offsets from an origin that only Scarp reads.
std::string offset_words(const SimplifyPlan& plan, const Mesh& mesh) {
  const std::array<double, 3>& o = mesh.origin;
  if (!plan.format.is_mesh() || plan.format.mesh != MeshFormat::kStl || plan.solid || (o[0] == 0 && o[1] == 0))
    return "";
  return fmt::format("; the file holds offsets from {:.10g}, {:.10g}", o[0], o[1]);
}

/// The frame of the mesh; that of the input if OUTPUT is a raster. A PGM has no place.
Frame frame_of_output(const SimplifyPlan& plan, const Outcome& outcome) {
  const RasterInfo& info = outcome.field.info;
  if (plan.format.kind != OutputKind::kDem) return outcome.field.frame;
  if (!info.has_georeference || plan.format.raster == RasterFormat::kPgm) return grid_frame(outcome.field.rows);
  Frame frame;
  frame.kind = Frame::Kind::kSource;
  frame.affine = map_affine(info, outcome.field.rows);
  frame.crs = info.crs;
  frame.description = info.crs.empty() ? "the raster's own coordinates (no CRS)"
                                       : fmt::format("coordinates in {} ({})", crs_words(info.crs), info.crs_unit);
  return frame;
}

/// Makes the frame valid for the numbers in the file.
void add_offset(const SimplifyPlan& plan, const Mesh& mesh, Json& frame) {
  const std::string words = offset_words(plan, mesh);
  if (words.empty()) return;
  frame["description"] = frame["description"].get<std::string>() + words;
  Json& t = frame["to_source"];
  if (!t.is_array()) return;
  for (const std::size_t k : {std::size_t{0}, std::size_t{3}})
    t[k] = t[k].get<double>() + t[k + 1].get<double>() * mesh.origin[0] + t[k + 2].get<double>() * mesh.origin[1];
  frame["origin"] = Json{t[0], t[3]};
}

}  // namespace

Json make_report(const SimplifyPlan& plan, const Outcome& outcome, const std::vector<ReadyFile>& files,
                 const std::string& command_line) {
  Json report;
  report["scarp"] = version();
  report["command"] = command_line;
  report["input"] = describe_input(outcome.field, outcome.as_read, plan.read.band);
  report["input"]["filled"] = outcome.filled;
  report["frame"] = describe_frame(frame_of_output(plan, outcome), outcome.field.info, outcome.field.rows);
  add_offset(plan, outcome.simplified.mesh, report["frame"]);
  report["goal"] = describe_goal(plan, outcome);
  report["strategy"] = describe_strategy(plan.simplify, plan.strategy, outcome.simplified);
  for (const auto& [key, option] : {std::pair{"mask", kMask}, {"tolerance", kTolerance}, {"script", kScript}}) {
    report["strategy"][key] = or_null(plan.given[option]);
  }
  report["strategy"]["roi"] = plan.given.all(kRoi).empty() ? Json(nullptr) : Json(plan.given.all(kRoi));
  report["strategy"]["falloff"] = or_null(plan.given[kFalloff]);
  report["breaklines"] = describe_lines(plan.given, outcome.simplified);
  report["water"] = describe_lakes(outcome.features.lakes);
  report["rivers"] = describe_rivers(outcome.simplified.features.rivers);
  report["cliffs"] = describe_cliffs(plan.given, outcome.simplified.features.walls);
  report["ridges"] = describe_ridges(plan.given, outcome.simplified.features.ridges);
  report["shape"] = describe_shape(plan.simplify.quality.shape, outcome.simplified);
  report["cutline"] = describe_cut(plan.given, outcome.cut, outcome.simplified.cut_off);
  add_zones(report, plan.given, outcome.zones);
  report["stopped_by"] = stop_name(outcome.simplified.stop);
  report["vertices"] = outcome.vertices;
  report["triangles"] = outcome.triangles;
  report["full_triangles"] = full_grid_triangles(outcome.field);
  report["outline_triangles"] = outcome.simplified.outline_triangles;
  report["outline_triangles_at_one"] = outcome.simplified.outline_triangles_at_one;
  add_all_errors(report, plan, outcome);
  if (!plan.channels.image)
    report["max_error_place"] = to_json(find_place(outcome.as_read, outcome.simplified.measurement.max_error_at));
  add_coverage(report, outcome.simplified.measurement);
  add_solid(report, plan, outcome);
  report["levels"] = describe_levels(plan, outcome);
  const Work& work = outcome.simplified.work;
  report["work"] = Json{{"samples_scanned", work.samples_scanned},
                        {"triangles_scanned", work.triangles_scanned},
                        {"queue_moves", work.queue_moves},
                        {"passes", work.passes}};
  report["passes"] = describe_passes(outcome);
  report["seconds"] = describe_seconds(outcome);
  report["outputs"] = describe_outputs(files);
  report["warnings"] = outcome.warnings;
  return report;
}

std::string make_summary(const SimplifyPlan& plan, const Outcome& outcome, const std::vector<ReadyFile>& files) {
  const Measurement& measured = outcome.simplified.measurement;
  const RasterInfo& info = outcome.as_read;
  const std::string unit = heights_unit(info);

  std::string text = fmt::format("{} -> {}\n", base_name(plan.input), plan.output);
  const bool is_image = plan.channels.image;
  text += summary_line(is_image ? "image" : "raster",
                       fmt::format("{} x {}, {} valid {}, {} {} to {}{}", outcome.field.cols, outcome.field.rows,
                                   format_count(info.valid), is_image ? "pixels" : "samples",
                                   is_image ? format_plural(outcome.channels.count(), "band") + "," : "heights",
                                   format_number(info.min), format_number(info.max), unit));
  if (!info.view.empty()) text += summary_line("read as", info.view);
  if (outcome.filled > 0) text += summary_line("filled", format_plural(outcome.filled, "nodata sample"));
  text += files_lines(plan, files);
  text += summary_line("vertices", format_count(outcome.vertices));
  const std::uint64_t full = full_grid_triangles(outcome.field);
  text += summary_line(
      "triangles",
      fmt::format("{}, {} of the full grid's {}", format_count(outcome.triangles),
                  format_share(static_cast<double>(outcome.triangles), static_cast<double>(full)), format_count(full)));
  text += outline_line(plan, outcome);
  text += summary_line("effort", describe_effort(plan, outcome.simplified));
  text += summary_line("order", order_name(outcome.simplified.order));
  text +=
      summary_line("frame", frame_of_output(plan, outcome).description + offset_words(plan, outcome.simplified.mesh));
  text += waters_lines(outcome.features.lakes, outcome.simplified.features.rivers);
  if (!plan.given.all(kCutline).empty())
    text += summary_line("cutline", cut_words(outcome.cut, outcome.simplified.cut_off));
  text += lines_line(outcome.simplified.features.given_lines(), outcome.simplified.lines_inserted,
                     outcome.simplified.edits);
  text += zones_lines(plan.given, outcome.zones);
  text += cliffs_line(outcome.simplified.features.walls);
  text += ridges_line(outcome.simplified.features.ridges);
  text += shape_line(plan.simplify.quality.shape, outcome.simplified);
  text += solid_line(plan, outcome);
  text += levels_lines(outcome);
  text += describe_errors(plan, outcome);
  if (outcome.psnr) text += summary_line("PSNR", fmt::format("{:.2f} dB", *outcome.psnr));
  text += summary_line("judged", format_plural(measured.samples, "sample") + ", none uncovered" +
                                     (measured.stray > 0 ? fmt::format(", {} outside every cell of the domain left out",
                                                                       format_count(measured.stray))
                                                         : ""));
  return text + seconds_line(outcome) + describe_ending(plan, outcome);
}

}  // namespace scarp::cli
