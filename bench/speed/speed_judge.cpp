// Judges a mesh written by one of the timed programs with measure(), so that each peer's true error is known.
//
//   speed_judge RASTER COLS ROWS MESH     one JSON line

#include <utility>

#include "raw.h"
#include "scarp/measure.h"

namespace {

/// The mesh with the raster's own heights, counter-clockwise in the frame of the raster.
scarp::Mesh lift(const bench::RawMesh& raw, const bench::RawRaster& raster) {
  scarp::Mesh mesh;
  for (std::size_t v = 0; v < raw.vertices.size(); v += 2) {
    const std::uint32_t x = raw.vertices[v], y = raw.vertices[v + 1];
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

}  // namespace

int main(int argc, char** argv) {
  if (argc != 5) bench::die("usage: speed_judge RASTER COLS ROWS MESH");
  const bench::RawRaster raster = bench::read_raw(argv[1], argv[2], argv[3]);
  scarp::HeightField field;
  field.samples = raster.samples.data();
  field.cols = raster.cols;
  field.rows = raster.rows;
  field.frame = scarp::grid_frame(raster.rows);
  scarp::MeasureOptions options;
  options.topology = false;
  const auto measured = scarp::measure(field, lift(bench::read_raw_mesh(argv[4]), raster), options);
  if (!measured) bench::die(measured.error().message);
  std::printf("{\"max_error\": %.9g, \"rmse\": %.9g, \"uncovered\": %llu}\n", measured->max_error, measured->rmse,
              static_cast<unsigned long long>(measured->uncovered));
}
