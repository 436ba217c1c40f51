// Judges a peer's mesh with measure(): its true max error, and the part of the raster that it does not cover or covers
// twice.
//
//   peer_judge RASTER COLS ROWS lattice|surface MESH     one JSON line

#include <string_view>

#include "../speed/lift.h"
#include "scarp/measure.h"
#include "surface.h"

namespace {

scarp::Mesh read_mesh(std::string_view format, const char* path, const bench::RawRaster& raster) {
  if (format == "lattice") return bench::lift(bench::read_raw_mesh(path), raster);
  bench::Surface surface = bench::read_surface(path);
  scarp::Mesh mesh;
  mesh.positions = std::move(surface.points);
  mesh.triangles = std::move(surface.triangles);
  return mesh;
}

}  // namespace

int main(int argc, char** argv) {
  if (argc != 6) bench::die("usage: peer_judge RASTER COLS ROWS lattice|surface MESH");
  const bench::RawRaster raster = bench::read_raw(argv[1], argv[2], argv[3]);
  scarp::HeightField field;
  field.samples = raster.samples.data();
  field.cols = raster.cols;
  field.rows = raster.rows;
  field.frame = scarp::grid_frame(raster.rows);
  const auto measured = scarp::measure(field, read_mesh(argv[4], argv[5], raster));
  if (!measured) bench::die(measured.error().message);
  std::printf(
      "{\"triangles\": %llu, \"max_error\": %.9g, \"rmse\": %.9g, \"uncovered\": %llu, \"folded\": %llu, "
      "\"min_angle\": %.6g, \"angle_p1\": %.6g, \"angle_median\": %.6g, \"min_height\": %.9g, \"max_height\": %.9g}\n",
      static_cast<unsigned long long>(measured->triangles), measured->max_error, measured->rmse,
      static_cast<unsigned long long>(measured->uncovered),
      static_cast<unsigned long long>(measured->down_facing + measured->overlaps), measured->min_angle,
      measured->angle_percentiles[0], measured->angle_percentiles[2], measured->heights.min, measured->heights.max);
}
