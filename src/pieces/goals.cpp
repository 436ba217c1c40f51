#include "pieces/goals.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "fit/fit.h"
#include "metric/criterion.h"
#include "shape/shape_refinement.h"

namespace scarp {

MemoryBudget memory_budget(const HeightField& field, const SimplifyOptions& options) {
  constexpr std::uint64_t kMesh = 48, kProof = 145;
  const bool is_fitted_whole =
      options.quality.effort > Effort::kFast && (field.samples != nullptr || options.quality.shape.any());
  const std::uint64_t fit = is_fitted_whole ? kFitBytesPerVertex + kFitBytesPerVertexAndThread : 0;
  const std::uint64_t shape = options.quality.shape.any() ? kShapeBytesPerVertex : 0;
  const std::uint64_t normals = options.output.normals ? 3 * sizeof(float) : 0;
  return {options.run.memory.limit, options.run.memory.taken,
          std::max({kProof + normals, kMesh + normals + options.run.memory.per_vertex, fit, shape})};
}

Result<void> check_goals(const SimplifyOptions& options) {
  if (!options.goals.max_error && !options.goals.max_triangles && !options.goals.max_vertices &&
      !has_tolerances(options))
    return fail(ErrorKind::kUsage, "no goal given: set max_error, max_triangles, max_vertices or tolerance");
  return check_max_error(options.goals.max_error);
}

Result<void> check_max_error(const std::optional<double>& max_error) {
  if (!max_error || (*max_error >= 0 && std::isfinite(*max_error))) return {};
  return fail(ErrorKind::kUsage, fmt::format("max_error must be a finite number of at least 0, not {}", *max_error));
}

Result<void> Budget::check(const MeshSize& least, const std::string& culprit, const std::string& advice) const {
  const auto refuse = [&](std::uint64_t budget, const char* one, const char* many, std::uint64_t needed) {
    return fail(ErrorKind::kUsage, fmt::format("{} {} too few: {} {}; allow more{}", budget,
                                               budget == 1 ? std::string(one) + " is" : std::string(many) + " are",
                                               culprit, needed, advice));
  };
  if (max_vertices_ && *max_vertices_ < least.vertices)
    return refuse(*max_vertices_, "vertex", "vertices", least.vertices);
  if (max_triangles_ && *max_triangles_ < least.triangles)
    return refuse(*max_triangles_, "triangle", "triangles", least.triangles);
  return {};
}

std::optional<StopReason> Budget::exceeded(const MeshSize& size, std::uint32_t gain) const {
  if (max_vertices_ && size.vertices + 1 > *max_vertices_) return StopReason::kMaxVertices;
  if (max_triangles_ && size.triangles + gain > *max_triangles_) return StopReason::kMaxTriangles;
  return std::nullopt;
}

bool Budget::in_last_stretch(const MeshSize& size) const { return used(size) >= 0.95; }

double Budget::used(const MeshSize& size) const {
  const auto share = [](std::uint64_t count, const std::optional<std::uint64_t>& most) {
    return most ? static_cast<double>(count) / static_cast<double>(*most) : 0;
  };
  return std::max(share(size.vertices, max_vertices_), share(size.triangles, max_triangles_));
}

}  // namespace scarp
