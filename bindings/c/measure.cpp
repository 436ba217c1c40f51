// measure() through the program's own plans.
#include <CLI/CLI.hpp>
#include <optional>

#include "door.h"
#include "inputs.h"
#include "mesh.h"
#include "session/options/given_options.h"
#include "session/reports/measure_report.h"
#include "session/reports/points_report.h"
#include "session/table/option_table.h"
#include "session/tasks/measure_work.h"
#include "session/tasks/points_work.h"
#include "session/tasks/runner.h"
#include "settings.h"

namespace scarp::door {
namespace {

constexpr const char* kMeshName = "the mesh";

scarp_status finish(const Measurement& measured, std::uint64_t over, double seconds,
                    const std::optional<std::string>& broken, scarp_report* out) {
  scarp_report all = describe_measurement(measured);
  all.over = over;
  all.seconds = seconds;
  hand_out(all, out);
  return broken ? report(ErrorKind::kPromise, *broken) : SCARP_OK;
}

/// `are_points`: nothing for a file, which contains points or a raster.
scarp_status judge(const std::string& input, std::optional<bool> are_points, const Mesh& mesh,
                   const scarp_options& asked, scarp_report* out) {
  const io::Lent lent(kMeshName, mesh);
  CLI::App program;
  cli::GivenOptions given(cli::kMeasure);
  given.add_to(program);
  std::vector<std::string> beside;
  if (are_points.value_or(false)) beside.push_back(cli::name_of(cli::OptionId::kPoints));
  if (auto parsed = parse_options(program, cli::kMeasure, {"measure", input, kMeshName}, asked, beside); !parsed)
    return report(parsed.error());
  const cli::Runner runner{progress_of(asked)};
  if (auto fits = cli::check_kind_of_input(given); !fits) return report(fits.error());
  if (are_points.value_or(cli::are_points_meant(given))) {
    cli::JudgedPoints judged;
    if (auto done = cli::judge_points(given, runner, judged); !done) return report(done.error());
    return finish(judged.measured, judged.measured.over_tolerance, judged.seconds_measure, judged.broken, out);
  }
  cli::Judged judged;
  cli::StreamedErrors errors;
  if (auto done = cli::judge_inputs(given, runner, judged, errors); !done) return report(done.error());
  const std::uint64_t over = judged.judgement.weighted ? judged.judgement.weighted->over : 0;
  return finish(judged.judgement.heights, over, judged.seconds_measure, judged.broken, out);
}

scarp_status refuse_null_mesh() {
  return report(ErrorKind::kUsage, "the mesh, or the place for its report, is a null pointer");
}

}  // namespace
}  // namespace scarp::door

using namespace scarp::door;

extern "C" {

scarp_status scarp_measure(const scarp_field* field, const scarp_mesh* mesh, const scarp_options* options,
                           scarp_report* out) {
  return guarded([&]() -> scarp_status {
    if (mesh == nullptr || out == nullptr) return refuse_null_mesh();
    const scarp_options asked = known(options, scarp_options_init);
    const LentInputs inputs(field, asked);
    if (auto checked = inputs.check(); !checked) return report(checked.error());
    return judge(inputs.name(), false, mesh->mesh, asked, out);
  });
}

scarp_status scarp_measure_file(const char* path, const scarp_mesh* mesh, const scarp_options* options,
                                scarp_report* out) {
  return guarded([&]() -> scarp_status {
    if (mesh == nullptr || out == nullptr) return refuse_null_mesh();
    if (path == nullptr || *path == '\0') return report(scarp::ErrorKind::kUsage, "the path is empty");
    return judge(path, {}, mesh->mesh, known(options, scarp_options_init), out);
  });
}

scarp_status scarp_measure_points(const scarp_points* points, const scarp_mesh* mesh, const scarp_options* options,
                                  scarp_report* out) {
  return guarded([&]() -> scarp_status {
    if (mesh == nullptr || out == nullptr) return refuse_null_mesh();
    const scarp_options asked = known(options, scarp_options_init);
    const LentInputs inputs(points, asked);
    if (auto checked = inputs.check(); !checked) return report(checked.error());
    return judge(inputs.name(), true, mesh->mesh, asked, out);
  });
}

}  // extern "C"
