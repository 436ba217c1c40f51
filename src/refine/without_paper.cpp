// The interfaces to the strategies of the 1995 paper in a build without them (SCARP_WITH_PAPER=OFF). The check refuses
// every strategy but the default, so nothing else here has an effect.
#include "metric/criterion.h"
#include "metric/importance.h"
#include "refine/data_dependent.h"
#include "refine/settle_edges.h"

namespace scarp {

Result<void> Criterion::check_strategy() const {
  if (options_->strategy == Strategy{}) return {};
  return fail(ErrorKind::kUsage, "this build of Scarp knows no strategies of the 1995 paper: leave them out");
}

bool has_raster_feature(const Importance&) { return false; }
double damped(double feature, Importance::Damping) { return feature; }
std::vector<float> measure_feature(const Raster&, const Importance&) { return {}; }
std::vector<Point> rank_samples(const Raster&, const std::vector<float>&) { return {}; }

DataDependentRule::DataDependentRule(const ErrorMetric& metric, const EdgeRule& rule)
    : metric_(metric), rule_(rule), threshold_(0), cache_(metric, false, 0) {}
bool DataDependentRule::should_flip(const Triangulation&, HalfEdge) { return false; }
Vertex DataDependentRule::insert(Triangulation& tin, Point p, Triangulation::Location location) {
  return tin.insert(p, location, this);
}
Work settle_edges(Triangulation&, const ErrorMetric&, const EdgeRule&, bool) { return {}; }

}  // namespace scarp
