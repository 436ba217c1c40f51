#include "scarp/simplify.h"

#include <algorithm>
#include <limits>
#include <utility>

#include "mesh.h"
#include "scarp/measure.h"

namespace scarp::wasm {

/// Enums have their numbers in scarp/options.h. NaN and 0: not given.
struct Options {
  double max_error, max_triangles, max_vertices;
  double effort, vertices, order, objective;
  double min_shape, outline_tolerance;
  double normals, uvs, lattice, doubles, locks_border;
  double mask, tolerance;  ///< addresses of cols · rows float32; 0: none
  double has_progress;
};

Report describe(const Measurement& measured) {
  Report report;
  report.vertices = static_cast<double>(measured.vertices);
  report.triangles = static_cast<double>(measured.triangles);
  report.samples = static_cast<double>(measured.samples);
  report.uncovered = static_cast<double>(measured.uncovered);
  report.stray = static_cast<double>(measured.stray);
  report.max_error = measured.max_error;
  report.max_error_col = measured.max_error_at[0];
  report.max_error_row = measured.max_error_at[1];
  report.rmse = measured.rmse;
  report.mean_error = measured.mean_error;
  report.mean_abs_error = measured.mean_abs_error;
  report.p50 = measured.p50;
  report.p95 = measured.p95;
  report.p99 = measured.p99;
  return report;
}

namespace {

SimplifyOptions take_options(const Options& asked, std::size_t samples) {
  SimplifyOptions options;
  options.goals.max_error = given(asked.max_error);
  options.goals.max_triangles = budget(asked.max_triangles);
  options.goals.max_vertices = budget(asked.max_vertices);
  options.goals.objective = static_cast<Objective>(asked.objective);
  options.quality.effort = static_cast<Effort>(asked.effort);
  options.quality.vertices = static_cast<Vertices>(asked.vertices);
  options.quality.order = static_cast<Order>(asked.order);
  options.quality.min_shape = given(asked.min_shape);
  options.domain.outline_tolerance = asked.outline_tolerance;
  options.domain.border.is_locked = asked.locks_border != 0;
  options.output.normals = asked.normals != 0;
  options.output.uvs = asked.uvs != 0;
  options.output.lattice = asked.lattice != 0;
  options.output.float32_positions = asked.doubles == 0;
  if (asked.mask != 0) options.tolerances.weights = {at<const float>(asked.mask), samples};
  if (asked.tolerance != 0) options.tolerances.values = {at<const float>(asked.tolerance), samples};
  options.run.threads = 1;
  if (asked.has_progress != 0) options.run.progress = ask_javascript();
  return options;
}

}  // namespace
}  // namespace scarp::wasm

using namespace scarp::wasm;
using scarp::Result;

SCARP_EXPORT(scarp_simplify) WholeMesh* scarp_simplify(const Field* given_field, const Options* asked) {
  return give<WholeMesh>([&]() -> Result<std::unique_ptr<WholeMesh>> {
    SCARP_TRY(const auto& field, take_field(*given_field));
    const auto samples = static_cast<std::size_t>(field.cols) * static_cast<std::size_t>(field.rows);
    SCARP_TRY(auto&& made, scarp::simplify(field, take_options(*asked, samples)));
    auto whole = std::make_unique<WholeMesh>();
    whole->report = describe(made.measurement);
    whole->report.stop = static_cast<double>(made.stop);
    whole->report.effort = static_cast<double>(made.effort) - static_cast<double>(scarp::Effort::kFast);
    whole->mesh = std::move(made.mesh);
    const std::array<double, 6>& affine = field.frame.affine;
    if (affine[2] == 0 && affine[4] == 0) {
      whole->cell[0] = affine[1];
      whole->cell[1] = affine[5];
    }
    return whole;
  });
}

/// Positions: 3 doubles a vertex, as offsets from the origin. They are judged unchanged.
SCARP_EXPORT(scarp_measure)
std::int32_t scarp_measure(const Field* given_field, const double* origin, const double* positions, double vertices,
                           const std::uint32_t* corners, double triangles, Report* out) {
  return guarded<std::int32_t>(0, [&]() -> Result<std::int32_t> {
    SCARP_TRY(const auto& field, take_field(*given_field));
    scarp::Mesh mesh;
    std::copy_n(origin, 3, mesh.origin.begin());
    mesh.positions.assign(positions, positions + 3 * static_cast<std::size_t>(vertices));
    mesh.triangles.assign(corners, corners + 3 * static_cast<std::size_t>(triangles));
    scarp::MeasureOptions options;
    options.run.threads = 1;
    SCARP_TRY(const auto& measured, scarp::measure(field, mesh, options));
    *out = describe(measured);
    out->is_sound = measured.is_sound() ? 1 : 0;
    return 1;
  });
}
