#include "session/reports/level_report.h"

#include <fmt/format.h>

#include "session/options/level_options.h"
#include "session/text/json_text.h"
#include "session/text/text.h"

namespace scarp::cli {
namespace {

/// The facts common to a level and the run itself.
struct LevelNumbers {
  std::optional<double> asked;
  const Simplified& simplified;
  std::uint64_t vertices, triangles;
};

std::vector<LevelNumbers> list_levels(const SimplifyRun& run) {
  std::vector<LevelNumbers> list{{run.asked, run.simplified, run.vertices, run.triangles}};
  for (const Level& level : run.coarser) {
    const Mesh& mesh = level.simplified.mesh;
    list.push_back({level.asked, level.simplified, mesh.vertex_count(), mesh.triangle_count()});
  }
  return list;
}

}  // namespace

Json describe_levels(const SimplifyPlan& plan, const SimplifyRun& run) {
  if (!plan.levels) return nullptr;
  Json levels = Json::array();
  const std::vector<LevelNumbers> list = list_levels(run);
  for (std::size_t k = 0; k < list.size(); ++k) {
    const Measurement& measured = list[k].simplified.measurement;
    levels.push_back(Json{{"path", plan.levels_in_one ? plan.output : level_path(plan.output, static_cast<int>(k))},
                          {"asked", or_null(list[k].asked)},
                          {"max_error", measured.max_error},
                          {"max_error_at", measured.max_error_at},
                          {"rmse", measured.rmse},
                          {"vertices", list[k].vertices},
                          {"triangles", list[k].triangles}});
  }
  return levels;
}

std::string levels_lines(const SimplifyRun& run) {
  if (run.coarser.empty()) return "";
  std::string text;
  const std::vector<LevelNumbers> list = list_levels(run);
  for (std::size_t k = 0; k < list.size(); ++k) {
    const Measurement& measured = list[k].simplified.measurement;
    text += summary_line(fmt::format("level {}", k).c_str(),
                         fmt::format("{}, max error {} (asked {}), RMSE {}",
                                     format_plural(list[k].triangles, "triangle"), format_number(measured.max_error),
                                     format_number(list[k].asked.value_or(0)), format_number(measured.rmse)));
  }
  return text;
}

}  // namespace scarp::cli
