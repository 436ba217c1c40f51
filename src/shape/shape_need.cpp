#include "shape/shape_need.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <limits>

namespace scarp::shape {

double least_triangles(const tin::Triangulation& tin, const PlanMetric& metric, const ShapeGoals& goals,
                       const SizeField* sizes) {
  // Paths along edges of a Delaunay triangulation are at most 1.998 times the straight distance (G. Xia, "The stretch
  // factor of the Delaunay triangulation is less than 1.998", 2013).
  constexpr double kStretch = 2, kFastest = 0.1;
  const double infinity = std::numeric_limits<double>::infinity(), fixed = goals.max_edge.value_or(infinity);
  if (sizes != nullptr && *goals.grade > kFastest) sizes = nullptr;
  if (sizes == nullptr && std::isinf(fixed)) return 0;
  double count = 0;
  for (tin::Triangle t = 0; t < tin.triangle_count(); ++t) {
    if (tin.is_outside(t)) continue;
    const auto [a, b, c] = tin.corners(t);
    double longest = fixed;
    if (sizes != nullptr) {
      const double way = kStretch * *goals.grade,
                   side2 = std::max({metric.square(a, b), metric.square(b, c), metric.square(c, a)});
      const double size =
          std::min({sizes->at(tin.origin(3 * t)), sizes->at(tin.origin(3 * t + 1)), sizes->at(tin.origin(3 * t + 2))});
      // A triangle that overlaps this one has corners at most an edge length beyond it.
      const double most = (size + way * std::sqrt(side2)) / (1 - kGradeFactor * way);
      longest = std::min(longest, kGradeFactor * most);
    }
    const PlanMetric::Vector u = metric.between(a, b), v = metric.between(a, c);
    count += std::abs(u[0] * v[1] - u[1] * v[0]) / (std::sqrt(0.75) * longest * longest);
  }
  return count;
}

Result<void> check_need(double triangles, const MemoryBudget& memory, std::uint64_t work) {
  constexpr double kMost = tin::kNone / 3;
  const auto count = [&] {
    return triangles < 1e6 ? fmt::format("{:.0f}", triangles) : fmt::format("{:.0f} million", triangles / 1e6);
  };
  if (triangles > kMost)
    return fail(ErrorKind::kInput, fmt::format("edges so short need at least {} triangles, and a mesh has at most "
                                               "1,431 million: ask for a larger max edge, or for a larger grade",
                                               count()));
  const double needed = triangles / 2 * static_cast<double>(memory.per_vertex) + static_cast<double>(work);
  if (!memory.is_limited() || needed <= static_cast<double>(memory.rest())) return {};
  return fail(
      ErrorKind::kMemory,
      fmt::format("the memory limit is too little: edges so short need at least {} triangles, which take more than "
                  "{:.0f}M; allow that much and more, or ask for a larger max edge, or for a larger grade",
                  count(), std::ceil((needed + static_cast<double>(memory.taken)) / 1e6)));
}

}  // namespace scarp::shape
