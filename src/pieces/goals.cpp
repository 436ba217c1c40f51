#include "pieces/goals.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "fit/fit.h"
#include "shape/shape_refinement.h"

namespace scarp {

MemoryBudget memory_budget(const HeightField& field, const SimplifyOptions& options) {
  constexpr std::uint64_t kMesh = 48, kProof = 145;
  const bool is_fitted_whole = options.effort > Effort::kFast && (field.samples != nullptr || options.shape.any());
  const std::uint64_t fit = is_fitted_whole ? kFitBytesPerVertex + kFitBytesPerVertexAndThread : 0;
  const std::uint64_t shape = options.shape.any() ? kShapeBytesPerVertex : 0;
  return {options.memory_limit, options.memory_taken,
          std::max({kProof, kMesh + options.memory_per_vertex, fit, shape})};
}

Result<void> check_goals(const SimplifyOptions& options, bool may_have_tolerance) {
  const bool has_tolerance = may_have_tolerance && (!options.tolerance.empty() || options.tolerance_source != nullptr);
  if (!options.max_error && !options.max_triangles && !options.max_vertices && !has_tolerance)
    return fail(ErrorKind::kUsage,
                fmt::format("no goal given: set max_error, max_triangles{} max_vertices{}",
                            may_have_tolerance ? "," : " or", may_have_tolerance ? " or tolerance" : ""));
  if (options.max_error && !(*options.max_error >= 0 && std::isfinite(*options.max_error)))
    return fail(ErrorKind::kUsage,
                fmt::format("max_error must be a finite number of at least 0, not {}", *options.max_error));
  return {};
}

Result<void> Budget::check(const MeshSize& least, const std::string& culprit, const std::string& advice) const {
  const auto refuse = [&](std::uint64_t budget, const char* one, const char* many, std::uint64_t needed) {
    return fail(ErrorKind::kUsage, fmt::format("{} {} too few: {} {}; allow more{}", budget,
                                               budget == 1 ? std::string(one) + " is" : std::string(many) + " are",
                                               culprit, needed, advice));
  };
  if (options_.max_vertices && *options_.max_vertices < least.vertices)
    return refuse(*options_.max_vertices, "vertex", "vertices", least.vertices);
  if (options_.max_triangles && *options_.max_triangles < least.triangles)
    return refuse(*options_.max_triangles, "triangle", "triangles", least.triangles);
  return {};
}

std::optional<StopReason> Budget::exceeded(const MeshSize& size, std::uint32_t gain) const {
  if (options_.max_vertices && size.vertices + 1 > *options_.max_vertices) return StopReason::kMaxVertices;
  if (options_.max_triangles && size.triangles + gain > *options_.max_triangles) return StopReason::kMaxTriangles;
  return std::nullopt;
}

bool Budget::in_last_stretch(const MeshSize& size) const { return used(size) >= 0.95; }

double Budget::used(const MeshSize& size) const {
  const auto share = [](std::uint64_t count, const std::optional<std::uint64_t>& most) {
    return most ? static_cast<double>(count) / static_cast<double>(*most) : 0;
  };
  return std::max(share(size.vertices, options_.max_vertices), share(size.triangles, options_.max_triangles));
}

}  // namespace scarp
