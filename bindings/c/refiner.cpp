#include <algorithm>
#include <memory>
#include <utility>

#include "commands/simplify_run.h"
#include "door.h"
#include "inputs.h"
#include "mesh.h"
#include "scarp/simplify.h"

struct scarp_refiner {
  scarp::OwnedHeightField field;  ///< whose samples are the caller's, but where they had to be cleaned
  scarp::Refiner refiner;
};

using namespace scarp::door;

extern "C" {

scarp_status scarp_refiner_create(const scarp_field* given, scarp_refiner** out) {
  return guarded([&]() -> scarp_status {
    if (out == nullptr) return report(scarp::ErrorKind::kUsage, "the place for the refiner is a null pointer");
    *out = nullptr;
    const LentInputs inputs(given, known<scarp_options>(nullptr, scarp_options_init));
    if (auto checked = inputs.check(); !checked) return report(checked.error());
    auto field = scarp::read_height_field(inputs.name(), {.default_frame = scarp::DefaultFrame::kMetric});
    if (!field) return report(field.error());
    auto refiner = scarp::Refiner::create(field->view());
    if (!refiner) return report(refiner.error());
    *out = new scarp_refiner{std::move(*field), std::move(*refiner)};
    return SCARP_OK;
  });
}

int32_t scarp_refiner_insert_worst(scarp_refiner* refiner) {
  int32_t inserted = 0;
  const scarp_status status = guarded([&]() -> scarp_status {
    inserted = refiner->refiner.insert_worst() ? 1 : 0;
    return SCARP_OK;
  });
  return status == SCARP_OK ? inserted : -1;
}

int64_t scarp_refiner_run(scarp_refiner* refiner, double max_error, uint64_t max_vertices) {
  int64_t inserted = 0;
  const scarp_status status = guarded([&]() -> scarp_status {
    scarp::Refiner& steps = refiner->refiner;
    const auto goes_on = [&] {
      return steps.max_error() > max_error && (max_vertices == 0 || steps.vertex_count() < max_vertices);
    };
    while (goes_on() && steps.insert_worst()) ++inserted;
    return SCARP_OK;
  });
  return status == SCARP_OK ? inserted : -1;
}

double scarp_refiner_max_error(const scarp_refiner* refiner) { return refiner->refiner.max_error(); }
uint64_t scarp_refiner_vertex_count(const scarp_refiner* refiner) { return refiner->refiner.vertex_count(); }
uint64_t scarp_refiner_triangle_count(const scarp_refiner* refiner) { return refiner->refiner.triangle_count(); }

scarp_status scarp_refiner_mesh(const scarp_refiner* refiner, scarp_mesh** out) {
  return guarded([&]() -> scarp_status {
    if (refiner == nullptr || out == nullptr)
      return report(scarp::ErrorKind::kUsage, "the refiner, or the place for its mesh, is a null pointer");
    *out = nullptr;
    const scarp::Frame& frame = refiner->field.frame;
    auto mesh = std::make_unique<scarp_mesh>();
    mesh->mesh = refiner->refiner.mesh();
    const char* crs = frame.kind == scarp::Frame::Kind::kGrid    ? "grid"
                      : frame.kind == scarp::Frame::Kind::kLocal ? "local"
                                                                 : "source";
    scarp::cli::add_origin("scarp refiner", frame.description, frame.crs, crs, mesh->mesh);
    *out = mesh.release();
    return SCARP_OK;
  });
}

void scarp_refiner_free(scarp_refiner* refiner) { delete refiner; }

}  // extern "C"
