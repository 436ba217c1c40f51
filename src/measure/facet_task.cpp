#include "measure/facet_task.h"

#include <tuple>

namespace scarp::judge {
namespace {

/// Up to this size, facets on the lattice of 256ths have weights of at most 45 bits, and a slack smaller than a
/// weight's step.
constexpr double kMostExact = 2048;
/// Largest column for exact spans. In a row, a side of such a facet is either on a sample or at least 2^-27 of a column
/// away from all. In smaller columns, the margin plus the rounding is less than half of that distance.
constexpr std::int32_t kMostExactCols = 1 << 22;
/// In narrower rows, a search for sides costs more than it saves.
constexpr std::int32_t kNarrow = 8;

}  // namespace

bool make_task(const Facet& facet, const TaskRows& rows, bool is_on_lattice, FacetTask& task) {
  const PlanTriangle& plan = facet.plan;
  const Interval along = plan.y_extent(), across = plan.x_extent();
  const double width = across.hi - across.lo, height = along.hi - along.lo;
  task.margin = 1e-9 + 1e-12 * width;
  std::tie(task.first, task.last) =
      whole_between(along.lo - task.margin, along.hi + task.margin, rows.first, rows.last);
  std::tie(task.left, task.right) = whole_between(across.lo - task.margin, across.hi + task.margin, 0, rows.cols - 1);
  if (task.first > task.last || task.left > task.right) return false;
  for (std::size_t k = 0; k < 3; ++k) {
    const std::size_t a = k == 2 ? 0 : k + 1, b = a == 2 ? 0 : a + 1;
    task.x[k] = plan.x[a];
    task.y[k] = plan.y[a];
    task.dx[k] = plan.x[b] - plan.x[a];
    task.dy[k] = plan.y[b] - plan.y[a];
  }
  task.z = facet.z;
  task.slack = 1e-12 * width * height;  // like PlanTriangle::slack()
  task.per_area = 1 / plan.double_area();
  task.is_exact = is_on_lattice && width <= kMostExact && height <= kMostExact && rows.cols <= kMostExactCols;
  task.has_spans = !task.is_exact || task.right - task.left >= kNarrow;
  for (std::size_t k = 0; task.has_spans && k < 3; ++k) task.per_dy[k] = 1 / task.dy[k];
  return true;
}

}  // namespace scarp::judge
