#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <memory>
#include <utility>

#include "door.h"
#include "inputs.h"
#include "mesh.h"
#include "scarp/simplify.h"
#include "session/tasks/mesh_output.h"
#include "session/text/clock.h"

struct scarp_refiner {
  scarp::OwnedHeightField field;  ///< borrows the caller's samples unless they had to be cleaned
  scarp::Refiner refiner;
};

namespace scarp::door {
namespace {

constexpr int kStepsUnwatched = 64;
constexpr double kMinInterval = 0.1;  // seconds

/// The fraction of the work that is done. Work grows with the number of vertices, which grows as 1 / error².
double share_of(const Refiner& steps, double first_error, double max_error, std::uint64_t first,
                std::uint64_t max_vertices) {
  const double now = steps.max_error();
  double share = max_error > 0 && first_error > max_error && now > 0 ? max_error * max_error / (now * now) : 0;
  if (max_vertices > first) {
    const auto done = static_cast<double>(steps.vertex_count() - first);
    share = std::max(share, done / static_cast<double>(max_vertices - first));
  }
  return std::min(share, 1.0);
}

scarp_status go_on(scarp_refiner& refiner, double max_error, std::uint64_t max_vertices,
                   const ProgressCallback& progress, std::uint64_t& inserted) {
  if (!(max_error >= 0))
    return report(ErrorKind::kUsage, fmt::format("max_error {} is {}: it must be at least 0, and 0 reproduces every "
                                                 "sample",
                                                 max_error, max_error < 0 ? "negative" : "no number"));
  Refiner& steps = refiner.refiner;
  const double first_error = steps.max_error();
  const std::uint64_t first = steps.vertex_count();
  const auto tell = [&] {
    const double share = share_of(steps, first_error, max_error, first, max_vertices);
    return progress({"refine", share, steps.vertex_count(), steps.max_error()});
  };
  auto last = cli::Clock::now();
  for (bool is_due = true;
       steps.max_error() > max_error && (max_vertices == 0 || steps.vertex_count() < max_vertices);) {
    if (progress && is_due) {
      last = cli::Clock::now();
      if (!tell()) return report(ErrorKind::kCancelled, "cancelled while refining");
    }
    if (!steps.insert_worst()) break;
    ++inserted;
    is_due = inserted % kStepsUnwatched == 0 && cli::seconds_since(last) > kMinInterval;
  }
  return SCARP_OK;
}

scarp_status refuse_null_refiner() { return report(ErrorKind::kUsage, "the refiner is a null pointer"); }

}  // namespace
}  // namespace scarp::door

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
    if (refiner == nullptr) return refuse_null_refiner();
    inserted = refiner->refiner.insert_worst() ? 1 : 0;
    return SCARP_OK;
  });
  return status == SCARP_OK ? inserted : -1;
}

int64_t scarp_refiner_run(scarp_refiner* refiner, double max_error, uint64_t max_vertices) {
  uint64_t inserted = 0;
  const scarp_status status = guarded([&]() -> scarp_status {
    if (refiner == nullptr) return refuse_null_refiner();
    return go_on(*refiner, max_error, max_vertices, {}, inserted);
  });
  return status == SCARP_OK ? static_cast<int64_t>(inserted) : -1;
}

scarp_status scarp_refiner_go_on(scarp_refiner* refiner, const scarp_options* options, uint64_t* inserted) {
  uint64_t count = 0;
  const scarp_status status = guarded([&]() -> scarp_status {
    if (refiner == nullptr) return refuse_null_refiner();
    const scarp_options asked = known(options, scarp_options_init);
    if (asked.named != nullptr || asked.max_triangles != 0 || asked.mask != nullptr || asked.tolerance != nullptr)
      return report(scarp::ErrorKind::kUsage, "a refiner takes max_error, max_points and progress only");
    const double max_error = std::isnan(asked.max_error) ? 0 : asked.max_error;
    return go_on(*refiner, max_error, asked.max_points, progress_of(asked), count);
  });
  if (inserted != nullptr) *inserted = count;
  return status;
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
    mesh->mesh = refiner->refiner.mesh(false);
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
