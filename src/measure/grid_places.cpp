#include "measure/grid_places.h"

#include <fmt/core.h>

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <optional>
#include <utility>
#include <vector>

#include "base/parallel.h"
#include "measure/check_mesh.h"
#include "measure/grid_map.h"

namespace scarp::judge {

namespace {

constexpr std::size_t kTogether = 1 << 15;

/// The position of vertex v of the mesh.
class Places {
 public:
  Places(const HeightField& field, const Mesh& mesh) : mesh_(mesh), to_grid_(field, mesh.origin) {}

  FacetCorner operator[](std::size_t v) const {
    const auto [col, row] = to_grid_(mesh_.positions[3 * v], mesh_.positions[3 * v + 1]);
    return {col, row, mesh_.origin[2] + mesh_.positions[3 * v + 2]};
  }

 private:
  const Mesh& mesh_;
  GridMap to_grid_;
};

/// Returns none if a corner does not fit.
std::optional<Array<FacetCorners::Short>> find_short(const Places& places, std::size_t count, int threads) {
  Array<FacetCorners::Short> corners;
  const auto fill = [&](std::size_t first, std::size_t end) {
    bool is_short = true;
    for (std::size_t v = first; v < end && is_short; ++v) is_short = FacetCorners::shorten(places[v], corners[v]);
    return is_short;
  };
  corners.resize(count);
  // The first corners usually decide.
  if (!fill(0, std::min(count, kTogether))) return std::nullopt;
  std::vector<std::uint8_t> are_short(count / kTogether + 1, 1);
  parallel_for_parts(count, kTogether, threads, [&](std::size_t first, std::size_t end) {
    if (first > 0) are_short[first / kTogether] = fill(first, end);
  });
  if (std::count(are_short.begin(), are_short.end(), 0) > 0) return std::nullopt;
  return corners;
}

}  // namespace

Result<GridPlaces> place_on_grid(const HeightField& field, const Mesh& mesh, int threads) {
  const std::size_t count = mesh.vertex_count(), parts = (count + kTogether - 1) / kTogether;
  const Places place(field, mesh);
  if (auto shorts = find_short(place, count, threads)) return GridPlaces{FacetCorners(std::move(*shorts)), true};
  Array<FacetCorner> corners;
  corners.resize(count);
  struct Part {
    std::size_t first_beyond;
    bool is_on_lattice;
  };
  std::vector<Part> found(parts, {count, true});
  parallel_for(parts, threads, [&](std::size_t part) {
    const std::size_t end = std::min(count, (part + 1) * kTogether);
    for (std::size_t v = end; v-- > part * kTogether;) {
      const FacetCorner corner = corners[v] = place[v];
      if (!is_in_reach(corner.x) || !is_in_reach(corner.y)) found[part].first_beyond = v;
      if (!GridMap::is_on_lattice(corner.x) || !GridMap::is_on_lattice(corner.y)) found[part].is_on_lattice = false;
    }
  });
  bool are_on_lattice = true;
  for (const Part& part : found) {
    are_on_lattice = are_on_lattice && part.is_on_lattice;
    if (part.first_beyond == count) continue;
    return fail(
        ErrorKind::kInput,
        fmt::format("vertex {} of the mesh lies more than 1e100 cells from the height field; only nearer ones can be "
                    "judged",
                    part.first_beyond));
  }
  return GridPlaces{FacetCorners(std::move(corners)), are_on_lattice};
}

}  // namespace scarp::judge
