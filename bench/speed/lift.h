// The meshes of programs that keep vertices on samples, for measure().
#pragma once

#include <cstdint>
#include <utility>

#include "raw.h"
#include "scarp/mesh.h"

namespace bench {

/// The mesh with the raster's own heights, counter-clockwise in the frame of the raster.
inline scarp::Mesh lift(const RawMesh& raw, const RawRaster& raster) {
  scarp::Mesh mesh;
  for (std::size_t v = 0; v < raw.vertices.size(); v += 2) {
    const std::uint32_t x = raw.vertices[v], y = raw.vertices[v + 1];
    if (x >= static_cast<std::uint32_t>(raster.cols) || y >= static_cast<std::uint32_t>(raster.rows))
      die("a vertex lies outside the raster");
    const std::size_t sample = std::size_t{y} * static_cast<std::size_t>(raster.cols) + x;
    mesh.positions.insert(mesh.positions.end(), {double(x), double(raster.rows - 1) - y, raster.samples[sample]});
  }
  mesh.triangles = raw.triangles;
  for (std::size_t t = 0; t < mesh.triangles.size(); t += 3) {
    const double* a = &mesh.positions[3 * mesh.triangles[t]];
    const double* b = &mesh.positions[3 * mesh.triangles[t + 1]];
    const double* c = &mesh.positions[3 * mesh.triangles[t + 2]];
    if ((b[0] - a[0]) * (c[1] - a[1]) < (b[1] - a[1]) * (c[0] - a[0]))
      std::swap(mesh.triangles[t + 1], mesh.triangles[t + 2]);
  }
  return mesh;
}

}  // namespace bench
