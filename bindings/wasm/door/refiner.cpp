#include <utility>

#include "mesh.h"
#include "scarp/simplify.h"

using namespace scarp::wasm;
using scarp::Refiner;
using scarp::Result;

SCARP_EXPORT(scarp_refiner_create) Refiner* scarp_refiner_create(const Field* given) {
  return give<Refiner>([&]() -> Result<std::unique_ptr<Refiner>> {
    SCARP_TRY(const auto& field, take_field(*given));
    SCARP_TRY(auto&& refiner, Refiner::create(field));
    return std::make_unique<Refiner>(std::move(refiner));
  });
}
/// Inserts vertices until the max error is at most `max_error`, or there are `max_vertices` (0: any number), or `most`
/// were inserted. Returns the number inserted; -1: failed.
SCARP_EXPORT(scarp_refiner_run)
double scarp_refiner_run(Refiner* refiner, double max_error, double max_vertices, double most) {
  return guarded<double>(-1, [&]() -> Result<double> {
    double inserted = 0;
    const auto goes_on = [&] {
      return inserted < most && refiner->max_error() > max_error &&
             (max_vertices == 0 || static_cast<double>(refiner->vertex_count()) < max_vertices);
    };
    while (goes_on() && refiner->insert_worst()) ++inserted;
    return inserted;
  });
}
SCARP_EXPORT(scarp_refiner_max_error) double scarp_refiner_max_error(const Refiner* refiner) {
  return refiner->max_error();
}
SCARP_EXPORT(scarp_refiner_vertices) double scarp_refiner_vertices(const Refiner* refiner) {
  return static_cast<double>(refiner->vertex_count());
}
SCARP_EXPORT(scarp_refiner_triangles) double scarp_refiner_triangles(const Refiner* refiner) {
  return static_cast<double>(refiner->triangle_count());
}
SCARP_EXPORT(scarp_refiner_mesh) WholeMesh* scarp_refiner_mesh(const Refiner* refiner) {
  return give<WholeMesh>(
      [&]() -> Result<std::unique_ptr<WholeMesh>> { return whole_of(refiner->mesh(false), refiner->max_error()); });
}
SCARP_EXPORT(scarp_refiner_free) void scarp_refiner_free(Refiner* refiner) { delete refiner; }
