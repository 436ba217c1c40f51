#include "session/reports/simplify_run.h"

#include <fmt/format.h>

#include "scarp/version.h"
#include "session/reports/solid_report.h"
#include "session/text/json_text.h"
#include "session/text/text.h"

namespace scarp::cli {
namespace {

/// Reading, the passes of simplify() in the order in which they ended, and writing.
std::vector<Pass> list_passes(const SimplifyRun& run) {
  std::vector<Pass> passes{{"read", run.seconds_read}};
  passes.insert(passes.end(), run.simplified.passes.begin(), run.simplified.passes.end());
  passes.push_back({"write", run.seconds_write});
  return passes;
}

}  // namespace

ReadyFile ready(const ProjectionFile& file) { return {file.path, "prj", {file.text.begin(), file.text.end()}}; }

Json describe_goal(const SimplifyPlan& plan, const SimplifyRun& run) {
  Json goal;
  goal["max_error"] = or_null(run.asked);
  goal["percent_of_relief"] =
      plan.error_goal && plan.error_goal->percent_of_relief ? Json(plan.error_goal->value) : Json(nullptr);
  goal["max_triangles"] = or_null(plan.simplify.goals.max_triangles);
  goal["max_points"] = or_null(plan.simplify.goals.max_vertices);
  return goal;
}

Json describe_passes(const SimplifyRun& run) {
  Json list = Json::array();
  for (const Pass& pass : list_passes(run)) {
    list.push_back(Json{{"name", pass.name},
                        {"seconds", pass.seconds},
                        {"samples_scanned", pass.samples_scanned},
                        {"triangles_scanned", pass.triangles_scanned},
                        {"insertions", pass.insertions},
                        {"removals", pass.removals}});
  }
  return list;
}

Json describe_seconds(const SimplifyRun& run) {
  return Json{{"read", run.seconds_read},
              {"refine", run.simplified.seconds_refine},
              {"measure", run.simplified.seconds_measure},
              {"write", run.seconds_write},
              {"total", run.seconds_total}};
}

Json describe_outputs(const std::vector<ReadyFile>& files) {
  Json outputs = Json::array();
  for (const ReadyFile& file : files)
    outputs.push_back(Json{{"path", file.path}, {"format", file.kind}, {"bytes", file.size()}});
  return outputs;
}

void add_solid(Json& report, const SimplifyPlan& plan, const SimplifyRun& run) {
  if (run.print) report["solid"] = describe_print(*plan.solid, *run.print, print_paths(plan, *run.print));
  if (!plan.base) return;
  report["solid"] = Json{{"base", *plan.base}, {"vertices", run.solid_vertices}, {"triangles", run.solid_triangles}};
}

std::vector<std::string> print_paths(const SimplifyPlan& plan, const Print& print) {
  std::vector<std::string> paths;
  if (plan.has_file_per_tile()) {
    for (const PrintTile& tile : print.tiles) paths.push_back(tile_path(plan.output, tile.row, tile.column));
  } else {
    paths.push_back(plan.output);
  }
  return paths;
}

std::string files_lines(const SimplifyPlan& plan, const std::vector<ReadyFile>& files) {
  std::string text;
  for (const ReadyFile& file : files)
    text += summary_line("written", fmt::format("{}, {}", file.path, format_bytes(file.size())));
  return plan.report ? text + summary_line("written", *plan.report) : text;
}

std::string solid_line(const SimplifyPlan& plan, const SimplifyRun& run) {
  if (run.print) return print_lines(*plan.solid, *run.print);
  if (!plan.base) return "";
  return summary_line("solid", fmt::format("{}, base at {}", format_plural(run.solid_triangles, "triangle"),
                                           format_number(*plan.base)));
}

std::string seconds_line(const SimplifyRun& run) {
  return summary_line("seconds",
                      fmt::format("read {}, refine {}, measure {}, write {}", format_seconds(run.seconds_read),
                                  format_seconds(run.simplified.seconds_refine),
                                  format_seconds(run.simplified.seconds_measure), format_seconds(run.seconds_write)));
}

std::string timing_lines(const SimplifyRun& run) {
  const auto line = [](std::string_view name, const std::string& seconds, const std::string& samples,
                       const std::string& triangles, const std::string& insertions, const std::string& removals) {
    return fmt::format("  {:<8}{:>10}{:>19}{:>19}{:>14}{:>14}\n", name, seconds, samples, triangles, insertions,
                       removals);
  };
  std::string text = line("pass", "seconds", "samples scanned", "triangles scanned", "insertions", "removals");
  for (const Pass& pass : list_passes(run)) {
    text += line(pass.name, fmt::format("{:.3f}", pass.seconds), format_count(pass.samples_scanned),
                 format_count(pass.triangles_scanned), format_count(pass.insertions), format_count(pass.removals));
  }
  return text;
}

std::string describe_asked(const SimplifyRun& run, const char* exceptions) {
  if (!run.asked) return "";
  const StopReason stop = run.simplified.stop;
  const bool is_budget = stop == StopReason::kMaxTriangles || stop == StopReason::kMaxVertices;
  return fmt::format(" (asked {}{}{})", format_number(*run.asked), is_budget ? ", not reached" : "", exceptions);
}

std::string describe_end(const SimplifyPlan& plan, const SimplifyRun& run, const char* exact) {
  const auto name_end = [&]() -> std::string {
    switch (run.simplified.stop) {
      case StopReason::kMaxError:
        return run.simplified.is_cut_short ? fmt::format("Reached the error goal, when {} ended the effort",
                                                         run.was_ended ? "the interrupt" : "the time limit")
                                           : "Reached the error goal";
      case StopReason::kMaxTriangles:
        return fmt::format("Reached the triangle budget of {}",
                           format_count(plan.simplify.goals.max_triangles.value_or(0)));
      case StopReason::kMaxVertices:
        return fmt::format("Reached the point budget of {}",
                           format_count(plan.simplify.goals.max_vertices.value_or(0)));
      case StopReason::kExact:
        break;
    }
    return exact != nullptr ? exact : "No vertex more would lower the error";
  };
  return fmt::format("{}, after {} s\n", name_end(), format_seconds(run.seconds_total));
}

}  // namespace scarp::cli
