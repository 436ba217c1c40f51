// The interfaces to lines, cutlines and shapes of triangles in a build without these modules (SCARP_WITH_LINES=OFF),
// for a web page that does not need them.
#include <span>

#include "lines/breaklines.h"
#include "lines/constraints.h"
#include "lines/field_lines.h"
#include "scarp/features.h"
#include "shape/shape_need.h"
#include "shape/shape_refinement.h"

namespace scarp {
namespace {

tl::unexpected<Error> refuse() {
  return fail(ErrorKind::kUsage, "this build of Scarp knows no lines, cutlines and goals for shapes: leave them out");
}

}  // namespace

LineConstraints Features::fixed_lines() const { return {}; }
Result<FittedFeatures> fit_features(const HeightField&, const Features&, const FeatureFitOptions&) { return refuse(); }

Result<lines::ConstrainedMesh> lines::ConstrainedMesh::insert(const grid::Raster&, tin::Triangulation&,
                                                              const ConstraintGraph&) {
  return refuse();
}
void lines::ConstrainedMesh::release_starts(tin::Triangulation&) {}
grid::VertexLattice lines::ConstrainedMesh::lattice(int) const { return {}; }

bool lines::is_inserted_first(const Line&) { return false; }
std::uint64_t lines::line_bytes(const HeightField&, std::span<const Line>, const std::array<double, 6>&) { return 0; }
Result<lines::FieldLines> lines::prepare_lines(const HeightField&, const LineConstraints&, const Cutline&, double, int,
                                               std::span<const std::int32_t>) {
  return refuse();
}
HeightField lines::FieldLines::apply(const HeightField& field) const { return field; }

Result<shape::ShapeWork> shape::refine_shapes(const grid::Raster&, tin::Triangulation&, grid::VertexLattice&,
                                              const ShapeTask&) {
  return refuse();
}
Result<shape::ShapeWork> shape::refine_shapes(const grid::SnappedPoints&, std::span<const double>,
                                              refine::ScatteredDomain&, const ShapeGoals&, double,
                                              std::span<const double>, Reporter&) {
  return refuse();
}
std::optional<fit::ShapeRule> shape::shape_rule(const ShapeGoals&, const grid::PointLattice&) { return std::nullopt; }
ShapeReport shape::report_shapes(const Mesh&, const ShapeGoals&, const tin::Triangulation&, const grid::PointLattice&) {
  return {};
}
Result<void> shape::check_need(double, const MemoryBudget&, std::uint64_t) { return refuse(); }
std::optional<fit::ShapeRule> shape::shape_rule(const ShapeGoals&, const Frame&) { return std::nullopt; }
shape::ShapeLosses shape::count_losses(const tin::Triangulation&, std::int32_t, const Frame&, const ShapeGoals&) {
  return {};
}
ShapeReport shape::report_shapes(const Mesh&, const ShapeGoals&, const ShapeLosses&) { return {}; }

}  // namespace scarp
