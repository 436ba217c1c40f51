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

Result<ConstrainedMesh> ConstrainedMesh::insert(const Raster&, Triangulation&, const ConstraintGraph&) {
  return refuse();
}
void ConstrainedMesh::release_starts(Triangulation&) {}
VertexLattice ConstrainedMesh::lattice(int) const { return {}; }

bool is_inserted_first(const Line&) { return false; }
std::uint64_t line_bytes(const HeightField&, std::span<const Line>, const std::array<double, 6>&) { return 0; }
Result<FieldLines> prepare_lines(const HeightField&, const LineConstraints&, const Cutline&, double, int,
                                 std::span<const std::int32_t>) {
  return refuse();
}
HeightField FieldLines::apply(const HeightField& field) const { return field; }

Result<ShapeWork> refine_shapes(const Raster&, Triangulation&, VertexLattice&, const ShapeTask&) { return refuse(); }
Result<ShapeWork> refine_shapes(const SnappedPoints&, std::span<const double>, ScatteredDomain&, const ShapeGoals&,
                                double, std::span<const double>, Reporter&) {
  return refuse();
}
std::optional<ShapeRule> shape_rule(const ShapeGoals&, const PointLattice&) { return std::nullopt; }
ShapeReport report_shapes(const Mesh&, const ShapeGoals&, const Triangulation&, const PointLattice&) { return {}; }
Result<void> check_need(double, const MemoryBudget&, std::uint64_t) { return refuse(); }
std::optional<ShapeRule> shape_rule(const ShapeGoals&, const Frame&) { return std::nullopt; }
ShapeLosses count_losses(const Triangulation&, std::int32_t, const Frame&, const ShapeGoals&) { return {}; }
ShapeReport report_shapes(const Mesh&, const ShapeGoals&, const ShapeLosses&) { return {}; }

}  // namespace scarp
