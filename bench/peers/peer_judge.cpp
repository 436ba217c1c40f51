// Judges a mesh with measure(): its true max error, and the uncovered or doubly covered parts of the raster.
//
//   peer_judge RASTER COLS ROWS lattice|surface MESH     one JSON line
//
// MESH: a RawMesh (lattice: its heights are the raster's own) or a Surface of ../speed/raw.h.

#include <utility>

#include "../speed/field.h"
#include "scarp/measure.h"
#include "scarp/mesh.h"

namespace {

/// The mesh, counter-clockwise in the frame of the raster.
scarp::Mesh lift(const bench::RawMesh& raw, const bench::RawRaster& raster) {
  scarp::Mesh mesh;
  for (std::size_t v = 0; v < raw.points.size(); v += 2) {
    const std::uint32_t x = raw.points[v], y = raw.points[v + 1];
    if (x >= static_cast<std::uint32_t>(raster.cols) || y >= static_cast<std::uint32_t>(raster.rows))
      bench::die("a vertex lies outside the raster");
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

scarp::Mesh read_mesh(const std::string& format, const std::string& path, const bench::RawRaster& raster) {
  if (format == "lattice") return lift(bench::read_mesh<bench::RawMesh>(path), raster);
  auto surface = bench::read_mesh<bench::Surface>(path);
  scarp::Mesh mesh;
  mesh.positions = std::move(surface.points);
  mesh.triangles = std::move(surface.triangles);
  return mesh;
}

}  // namespace

int main(int argc, char** argv) {
  const bench::Arguments arguments(argc, argv, "peer_judge RASTER COLS ROWS lattice|surface MESH");
  const bench::RawRaster raster = bench::read_raw(arguments);
  const auto measured =
      bench::check(scarp::measure(bench::field_of(raster), read_mesh(arguments[3], arguments[4], raster)));
  std::printf(
      "{\"triangles\": %llu, \"max_error\": %.9g, \"rmse\": %.9g, \"uncovered\": %llu, \"folded\": %llu, "
      "\"min_angle\": %.6g, \"angle_p1\": %.6g, \"angle_median\": %.6g, \"min_height\": %.9g, \"max_height\": %.9g}\n",
      static_cast<unsigned long long>(measured.triangles), measured.max_error, measured.rmse,
      static_cast<unsigned long long>(measured.uncovered),
      static_cast<unsigned long long>(measured.down_facing + measured.overlaps), measured.min_angle,
      measured.angle_percentiles[0], measured.angle_percentiles[2], measured.heights.min, measured.heights.max);
}
