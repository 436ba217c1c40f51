#include "scarp/points.h"

#include "mesh.h"

namespace scarp::wasm {

/// `coordinates`: 3 doubles a point, x, y, z.
struct Points {
  double coordinates, count;
  double max_error, max_triangles, max_vertices, duplicates, effort, vertices, min_shape, objective, doubles,
      has_progress;
};

}  // namespace scarp::wasm

using namespace scarp::wasm;
using scarp::Result;

SCARP_EXPORT(scarp_simplify_points) WholeMesh* scarp_simplify_points(const Points* given_points) {
  return give<WholeMesh>([&]() -> Result<std::unique_ptr<WholeMesh>> {
    scarp::PointSet points;
    const auto* const coordinates = at<const double>(given_points->coordinates);
    const auto count = static_cast<std::size_t>(given_points->count);
    for (std::size_t k = 0; k < count; ++k) {
      points.x.push_back(coordinates[3 * k]);
      points.y.push_back(coordinates[3 * k + 1]);
      points.z.push_back(coordinates[3 * k + 2]);
    }
    points.path = "the points";
    points.format = "memory";
    scarp::PointOptions options;
    options.max_error = given(given_points->max_error);
    options.max_triangles = budget(given_points->max_triangles);
    options.max_vertices = budget(given_points->max_vertices);
    options.duplicates = static_cast<scarp::DuplicatePolicy>(given_points->duplicates);
    options.quality.effort = static_cast<scarp::Effort>(given_points->effort);
    options.quality.vertices = static_cast<scarp::Vertices>(given_points->vertices);
    options.quality.min_shape = given(given_points->min_shape);
    options.objective = static_cast<scarp::Objective>(given_points->objective);
    options.float32_positions = given_points->doubles == 0;
    options.run.threads = 1;
    if (given_points->has_progress != 0) options.run.progress = ask_javascript();
    SCARP_TRY(auto&& made, scarp::simplify_points(points, options));
    auto whole = std::make_unique<WholeMesh>();
    whole->report = describe(made.simplified.measurement);
    whole->report.stop = static_cast<double>(made.simplified.stop);
    whole->report.effort = static_cast<double>(made.simplified.effort) - static_cast<double>(scarp::Effort::kFast);
    whole->mesh = std::move(made.simplified.mesh);
    return whole;
  });
}
