// The engine one vertex at a time: a thin layer over refine/.
#include "base/caught.h"
#include "grid/raster.h"
#include "grid/samples.h"
#include "metric/height_metric.h"
#include "pieces/freeze.h"
#include "refine/domain.h"
#include "refine/refinement.h"
#include "scarp/simplify.h"

namespace scarp {

struct Refiner::Impl {
  Impl(const HeightField& field_, grid::Samples samples_, refine::DomainMesh domain_)
      : field(field_),
        samples(std::move(samples_)),
        raster(samples.raster()),
        domain(std::move(domain_)),
        metric(raster, 0),
        refinement(metric, domain.tin) {}
  HeightField field;
  grid::Samples samples;
  grid::Raster raster;
  refine::DomainMesh domain;
  metric::HeightMetric metric;
  refine::Refinement refinement;
};

Refiner::Refiner(std::unique_ptr<Impl> impl) : impl_(std::move(impl)) {}
Refiner::Refiner(Refiner&&) noexcept = default;
Refiner& Refiner::operator=(Refiner&&) noexcept = default;
Refiner::~Refiner() = default;

Result<Refiner> Refiner::create(const HeightField& field, double outline_tolerance) try {
  if (field.samples == nullptr && field.source != nullptr)
    return fail(ErrorKind::kUsage, "a refiner needs the samples as one array of floats: read the raster as a whole");
  SCARP_TRY(auto&& samples, grid::Samples::to_refine(field, 1));
  SCARP_TRY(auto&& domain, refine::build_domain(samples.raster(), outline_tolerance, field.frame));
  return Refiner(std::make_unique<Impl>(field, std::move(samples), std::move(domain)));
} catch (...) {
  return caught(ErrorKind::kInput, "triangulate this raster");
}

bool Refiner::insert_worst() {
  if (impl_->refinement.done() || impl_->refinement.is_full()) return false;
  impl_->refinement.insert_worst();
  return true;
}

double Refiner::max_error() const { return impl_->refinement.worst_error(); }
std::uint64_t Refiner::vertex_count() const { return impl_->domain.tin.vertex_count() - impl_->domain.unused; }
std::uint64_t Refiner::triangle_count() const { return impl_->refinement.triangle_count(); }
Mesh Refiner::mesh(bool float32_positions) const {
  const HeightField& field = impl_->field;
  const grid::Raster given{field.frame.space ? field.samples : impl_->raster.samples, field.cols, field.rows};
  return pieces::freeze(impl_->domain.tin, {pieces::SampleHeights(given), {}, field.frame, float32_positions});
}

}  // namespace scarp
