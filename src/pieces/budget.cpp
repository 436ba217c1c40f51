#include "pieces/budget.h"

#include <fmt/format.h>

#include <algorithm>
#include <limits>

namespace scarp::pieces {

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

StopReason Budget::tighter(const MeshSize& size) const {
  return used({size.vertices, 0}) > used({0, size.triangles}) ? StopReason::kMaxVertices : StopReason::kMaxTriangles;
}

MeshSize Budget::most() const {
  constexpr std::uint64_t kAny = std::numeric_limits<std::uint64_t>::max();
  return {max_vertices_.value_or(kAny), max_triangles_.value_or(kAny)};
}

double Budget::used(const MeshSize& size) const {
  const auto share = [](std::uint64_t count, const std::optional<std::uint64_t>& most) {
    return most ? static_cast<double>(count) / static_cast<double>(*most) : 0;
  };
  return std::max(share(size.vertices, max_vertices_), share(size.triangles, max_triangles_));
}

}  // namespace scarp::pieces
