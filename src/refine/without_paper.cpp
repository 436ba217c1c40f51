// The interfaces to the strategies of the 1995 paper in a build without them (SCARP_WITH_PAPER=OFF). The check refuses
// every strategy but the default, so nothing else here has an effect.
#include "metric/criterion.h"
#include "metric/importance.h"
#include "refine/data_dependent.h"
#include "refine/settle_edges.h"

namespace scarp {

Result<void> metric::Criterion::check_strategy() const {
  if (options_->strategy == Strategy{}) return {};
  return fail(ErrorKind::kUsage, "this build of Scarp knows no strategies of the 1995 paper: leave them out");
}

bool metric::has_raster_feature(const Importance&) { return false; }
double metric::damped(double feature, Importance::Damping) { return feature; }
std::vector<float> metric::measure_feature(const grid::Raster&, const Importance&) { return {}; }
std::vector<Point> metric::rank_samples(const grid::Raster&, const std::vector<float>&) { return {}; }

refine::DataDependentRule::DataDependentRule(const metric::ErrorMetric& metric, const EdgeRule& rule)
    : metric_(metric), rule_(rule), threshold_(0), cache_(metric, false, 0) {}
bool refine::DataDependentRule::should_flip(const tin::Triangulation&, tin::HalfEdge) { return false; }
tin::Vertex refine::DataDependentRule::insert(tin::Triangulation& tin, Point p, tin::Triangulation::Location location) {
  return tin.insert(p, location, this);
}
Work refine::settle_edges(tin::Triangulation&, const metric::ErrorMetric&, const EdgeRule&, bool) { return {}; }

}  // namespace scarp
