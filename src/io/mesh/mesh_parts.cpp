#include "io/mesh/mesh_parts.h"

#include <algorithm>
#include <array>
#include <limits>
#include <numeric>
#include <span>

namespace scarp {
namespace {

constexpr std::size_t kMostVertices = 65535;
constexpr std::uint32_t kUnseen = std::numeric_limits<std::uint32_t>::max();

class Splitter {
 public:
  explicit Splitter(const Mesh& mesh) : mesh_(mesh), place_(mesh.vertex_count(), kUnseen) {}

  std::vector<MeshPart> parts;

  void split(std::span<std::uint32_t> triangles) {
    if (add_part(triangles)) return;
    const auto middle = static_cast<std::ptrdiff_t>(halve(triangles));
    split(triangles.first(static_cast<std::size_t>(middle)));
    split(triangles.subspan(static_cast<std::size_t>(middle)));
  }

 private:
  /// False if the triangles have too many vertices.
  bool add_part(std::span<const std::uint32_t> triangles) {
    MeshPart part;
    part.corners.reserve(std::min(3 * triangles.size(), 6 * kMostVertices));
    bool fits = true;
    for (std::size_t i = 0; i < triangles.size() && fits; ++i) {
      for (std::size_t k = 0; k < 3; ++k) {
        const std::uint32_t v = mesh_.triangles[3 * std::size_t{triangles[i]} + k];
        if (place_[v] == kUnseen) {
          place_[v] = static_cast<std::uint32_t>(part.vertices.size());
          part.vertices.push_back(v);
        }
        part.corners.push_back(static_cast<std::uint16_t>(place_[v]));
      }
      fits = part.vertices.size() <= kMostVertices;
    }
    for (const std::uint32_t v : part.vertices) place_[v] = kUnseen;
    if (fits) parts.push_back(std::move(part));
    return fits;
  }

  /// Thrice the centre of a triangle.
  double centre(std::uint32_t triangle, std::size_t axis) const {
    double sum = 0;
    for (std::size_t k = 0; k < 3; ++k)
      sum += mesh_.positions[3 * std::size_t{mesh_.triangles[3 * std::size_t{triangle} + k]} + axis];
    return sum;
  }

  /// Moves those on one side of the median to the front, in their order. Returns their number.
  std::size_t halve(std::span<std::uint32_t> triangles) const {
    std::array<double, 2> low, high;
    low.fill(std::numeric_limits<double>::infinity());
    high.fill(-std::numeric_limits<double>::infinity());
    for (const std::uint32_t t : triangles) {
      for (std::size_t axis = 0; axis < 2; ++axis) {
        low[axis] = std::min(low[axis], centre(t, axis));
        high[axis] = std::max(high[axis], centre(t, axis));
      }
    }
    const std::size_t axis = high[1] - low[1] > high[0] - low[0] ? 1 : 0;
    std::vector<double> centres;
    centres.reserve(triangles.size());
    for (const std::uint32_t t : triangles) centres.push_back(centre(t, axis));
    const auto middle = centres.begin() + static_cast<std::ptrdiff_t>(centres.size() / 2);
    std::nth_element(centres.begin(), middle, centres.end());
    const double median = *middle;
    const auto behind = std::stable_partition(triangles.begin(), triangles.end(),
                                              [&](std::uint32_t t) { return centre(t, axis) < median; });
    const auto front = static_cast<std::size_t>(behind - triangles.begin());
    return front == 0 ? triangles.size() / 2 : front;  // all centres lie behind each other
  }

  const Mesh& mesh_;
  std::vector<std::uint32_t> place_;  // of a vertex in the part that is being made
};

}  // namespace

std::vector<MeshPart> split_mesh(const Mesh& mesh) {
  if (mesh.vertex_count() <= kMostVertices) {
    MeshPart whole;
    whole.vertices.resize(mesh.vertex_count());
    std::iota(whole.vertices.begin(), whole.vertices.end(), 0);
    whole.corners.assign(mesh.triangles.begin(), mesh.triangles.end());
    return {std::move(whole)};
  }
  Splitter splitter(mesh);
  std::vector<std::uint32_t> triangles(mesh.triangle_count());
  std::iota(triangles.begin(), triangles.end(), 0);
  splitter.split(triangles);
  return std::move(splitter.parts);
}

}  // namespace scarp
