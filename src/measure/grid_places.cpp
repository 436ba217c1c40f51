#include "measure/grid_places.h"

#include <fmt/core.h>

#include <algorithm>
#include <cmath>
#include <vector>

#include "base/parallel.h"
#include "measure/check_mesh.h"
#include "measure/grid_map.h"

namespace scarp::judge {

Result<GridPlaces> place_on_grid(const HeightField& field, const Mesh& mesh, int threads) {
  constexpr std::size_t kTogether = 1 << 15;
  const std::size_t count = mesh.vertex_count(), parts = (count + kTogether - 1) / kTogether;
  const GridMap to_grid(field, mesh.origin);
  GridPlaces places;
  places.corners.resize(count);
  struct Part {
    std::size_t first_beyond;
    bool is_on_lattice;
  };
  std::vector<Part> found(parts, {count, true});
  parallel_for(parts, threads, [&](std::size_t part) {
    const std::size_t end = std::min(count, (part + 1) * kTogether);
    for (std::size_t v = end; v-- > part * kTogether;) {
      const auto [col, row] = to_grid(mesh.positions[3 * v], mesh.positions[3 * v + 1]);
      places.corners[v] = {col, row, mesh.origin[2] + mesh.positions[3 * v + 2]};
      if (!is_in_reach(col) || !is_in_reach(row)) found[part].first_beyond = v;
      if (!GridMap::is_on_lattice(col) || !GridMap::is_on_lattice(row)) found[part].is_on_lattice = false;
    }
  });
  for (const Part& part : found) {
    places.are_on_lattice = places.are_on_lattice && part.is_on_lattice;
    if (part.first_beyond == count) continue;
    return fail(
        ErrorKind::kInput,
        fmt::format("vertex {} of the mesh lies more than 1e100 cells from the height field; only nearer ones can be "
                    "judged",
                    part.first_beyond));
  }
  return places;
}

}  // namespace scarp::judge
