// simplify() through the program's own plans, for data in memory and for files.
#include <CLI/CLI.hpp>
#include <array>
#include <memory>
#include <optional>
#include <string>
#include <utility>
#include <vector>

#include "door.h"
#include "inputs.h"
#include "mesh.h"
#include "scarp/picture.h"
#include "session/options/given_options.h"
#include "session/options/output_kind.h"
#include "session/options/points_options.h"
#include "session/plan/simplify_plan.h"
#include "session/reports/points_report.h"
#include "session/reports/simplify_outcome.h"
#include "session/reports/simplify_run.h"
#include "session/table/option_table.h"
#include "session/tasks/points_work.h"
#include "session/tasks/runner.h"
#include "session/tasks/simplify_files.h"
#include "session/tasks/simplify_work.h"
#include "settings.h"

namespace scarp::door {
namespace {

enum class InputKind { kField, kPoints, kFile };  // a file contains either data

struct Request {
  std::vector<std::string> words;
  cli::GivenOptions given{cli::kSimplify};
  std::optional<cli::SimplifyPlan> plan;  ///< plan for a raster; no output file can be an input
};

Result<void> check_goal(const cli::GivenOptions& given) {
  using enum cli::OptionId;
  if (given.first_of({kMaxError, kMaxTriangles, kMaxPoints, kTolerance, kRoi})) return {};
  return fail(ErrorKind::kUsage,
              "no goal is given: say how good the mesh must be with max_error, or how small with max_triangles or "
              "max_points");
}

/// The command's options as in a run of the program, and the last requests about fields. Both are cached per thread,
/// because making them anew is slower than simplifying a small field.
class SimplifyWords {
 public:
  SimplifyWords() { given_.add_to(program_); }

  Result<std::shared_ptr<const Request>> parse(const std::string& input, InputKind kind, const scarp_options& asked) {
    std::vector<std::string> beside;
    if (kind == InputKind::kPoints) beside.push_back(cli::name_of(cli::OptionId::kPoints));
    if (!has_setting(asked, "--of")) beside.emplace_back("--of=glb");
    SCARP_TRY(auto&& words, words_of(cli::kSimplify, {"simplify", input, "-"}, asked, beside));
    for (const auto& request : last_) {
      if (kind == InputKind::kField && request && request->words == words) return request;
    }
    auto request = std::make_shared<Request>();
    given_.clear();
    SCARP_RETURN_IF_ERROR(parse_words(program_, words));
    request->words = std::move(words);
    request->given = given_;
    SCARP_RETURN_IF_ERROR(check_goal(given_));
    SCARP_RETURN_IF_ERROR(cli::check_kind_of_input(given_));
    if (kind != InputKind::kField && cli::are_points_meant(given_)) return request;
    SCARP_TRY(request->plan, cli::plan_simplify(given_, {}));
    if (kind == InputKind::kField) last_[next_++ % last_.size()] = request;
    return request;
  }

 private:
  CLI::App program_;
  cli::GivenOptions given_{cli::kSimplify};
  std::array<std::shared_ptr<const Request>, 8> last_;
  std::size_t next_ = 0;
};

SimplifyWords& words_of_thread() {
  thread_local SimplifyWords words;
  return words;
}

/// Without an output format, the frame is the raster's own coordinates, in which arrays are compared.
void choose_frame(const scarp_options& asked, ReadOptions& read) {
  if (has_setting(asked, "--of")) return;
  read.default_frame = DefaultFrame::kMetric;
  read.heights_in = HeightsIn::kFrame;
}

std::unique_ptr<scarp_mesh> hand_over(const cli::SimplifyPlan& plan, cli::SimplifyRun& run) {
  auto mesh = std::make_unique<scarp_mesh>();
  mesh->report = describe_run(run.simplified);
  mesh->mesh = std::move(run.simplified.mesh);
  mesh->format = plan.format;
  mesh->up = plan.given[cli::OptionId::kUp];
  mesh->crs = plan.read.crs;
  mesh->is_print = plan.solid.has_value();
  mesh->doubles = plan.doubles;
  mesh->glb.compress = plan.compress;
  mesh->glb.threads = plan.simplify.run.threads;
  mesh->warnings = in_words_of_door(join_lines(run.warnings));
  return mesh;
}

/// Replaces the mesh by that of the print's only tile.
Result<void> take_print(cli::SimplifyRun& outcome, scarp_mesh& mesh) {
  if (!outcome.print) return {};
  if (outcome.print->tiles.size() != 1)
    return fail(ErrorKind::kUsage, "a print that is split is several meshes: leave split out");
  Mesh solid = std::move(outcome.print->tiles.front().mesh);
  solid.metadata.insert(mesh.mesh.metadata.begin(), mesh.mesh.metadata.end());
  solid.metadata["name"] = "terrain";
  mesh.mesh = std::move(solid);
  mesh.report->vertices = mesh.mesh.vertex_count();
  mesh.report->triangles = mesh.mesh.triangle_count();
  return {};
}

Result<std::unique_ptr<scarp_mesh>> simplify_points_of(const Request& request, const scarp_options& asked) {
  cli::Runner runner{progress_of(asked)};
  runner.on_plan = [&](ReadOptions& read) { choose_frame(asked, read); };
  cli::SimplifyPlan plan;
  cli::PointsOutcome outcome;
  SCARP_RETURN_IF_ERROR(cli::make_points_mesh(request.given, runner, plan, outcome));
  SCARP_RETURN_IF_ERROR(cli::complete_mesh(plan, outcome));
  auto mesh = hand_over(plan, outcome);
  SCARP_RETURN_IF_ERROR(take_print(outcome, *mesh));
  return mesh;
}

Result<std::unique_ptr<scarp_mesh>> simplify_input(const std::string& input, InputKind kind,
                                                   const scarp_options& asked) {
  SCARP_TRY(const auto& parsed, words_of_thread().parse(input, kind, asked));
  const Request& request = *parsed;
  if (!request.plan) return simplify_points_of(request, asked);
  cli::SimplifyPlan plan = *request.plan;
  if (plan.format.kind == cli::OutputKind::kDem)
    return fail(ErrorKind::kUsage, "of dem is a raster, and a mesh is asked for: choose glb, obj, ply, stl ...");
  choose_frame(asked, plan.read);
  cli::Outcome outcome;
  SCARP_RETURN_IF_ERROR(cli::make_mesh(request.given, plan, {progress_of(asked)}, outcome));
  if (!outcome.channels.empty()) color_by_channels(outcome.simplified.mesh, outcome.channels.bands);
  SCARP_TRY(auto&& glb, cli::glb_options(plan, outcome));
  SCARP_RETURN_IF_ERROR(cli::complete_mesh(plan, outcome));
  auto mesh = hand_over(plan, outcome);
  mesh->glb = std::move(glb);
  SCARP_RETURN_IF_ERROR(take_print(outcome, *mesh));
  return mesh;
}

scarp_status hand_out_mesh(Result<std::unique_ptr<scarp_mesh>> made, scarp_mesh** out) {
  if (!made) return report(made.error());
  *out = made->release();
  return SCARP_OK;
}

scarp_status refuse_null_out() { return report(ErrorKind::kUsage, "the place for the mesh is a null pointer"); }

}  // namespace
}  // namespace scarp::door

using namespace scarp::door;

extern "C" {

scarp_status scarp_simplify(const scarp_field* field, const scarp_options* options, scarp_mesh** out) {
  return guarded([&]() -> scarp_status {
    if (out == nullptr) return refuse_null_out();
    *out = nullptr;
    const scarp_options asked = known(options, scarp_options_init);
    const LentInputs inputs(field, asked);
    if (auto checked = inputs.check(); !checked) return report(checked.error());
    return hand_out_mesh(simplify_input(inputs.name(), InputKind::kField, asked), out);
  });
}

scarp_status scarp_simplify_file(const char* path, const scarp_options* options, scarp_mesh** out) {
  return guarded([&]() -> scarp_status {
    if (out == nullptr) return refuse_null_out();
    *out = nullptr;
    if (path == nullptr || *path == '\0') return report(scarp::ErrorKind::kUsage, "the path is empty");
    const scarp_options asked = known(options, scarp_options_init);
    if (asked.mask != nullptr || asked.tolerance != nullptr)
      return report(scarp::ErrorKind::kUsage,
                    "mask and tolerance are arrays on the grid of a field: beside a file they are files, set by name");
    return hand_out_mesh(simplify_input(path, InputKind::kFile, asked), out);
  });
}

scarp_status scarp_simplify_points(const scarp_points* points, const scarp_options* options, scarp_mesh** out) {
  return guarded([&]() -> scarp_status {
    if (out == nullptr) return refuse_null_out();
    *out = nullptr;
    const scarp_options asked = known(options, scarp_options_init);
    const LentInputs inputs(points, asked);
    if (auto checked = inputs.check(); !checked) return report(checked.error());
    return hand_out_mesh(simplify_input(inputs.name(), InputKind::kPoints, asked), out);
  });
}

}  // extern "C"
