// Scarp itself on a raw raster, as its peers are run; the time is all of simplify(), its own proof included.
//
//   peer_scarp RASTER COLS ROWS ERROR VARIANT [SURFACE]     VARIANT: one of ../quality/variants.h

#include <algorithm>

#include "../quality/variants.h"
#include "scarp/scarp.h"
#include "surface.h"

int main(int argc, char** argv) {
  if (argc != 6 && argc != 7) bench::die("usage: peer_scarp RASTER COLS ROWS ERROR VARIANT [SURFACE]");
  const bench::RawRaster raster = bench::read_raw(argv[1], argv[2], argv[3]);
  const bench::Variant* variant = bench::find_variant(argv[5]);
  if (variant == nullptr) bench::die(std::string("there is no variant ") + argv[5]);
  scarp::HeightField field;
  field.samples = raster.samples.data();
  field.cols = raster.cols;
  field.rows = raster.rows;
  field.frame = scarp::grid_frame(raster.rows);
  const scarp::SimplifyOptions options = bench::options_of(*variant, std::atof(argv[4]));

  const bench::Stopwatch watch;
  const auto made = scarp::simplify(field, options);
  const bench::Times times = watch.read();
  if (!made) bench::die(made.error().message);
  bench::print_result(scarp::version(), times, made->mesh.vertex_count(), made->mesh.triangle_count());
  if (argc == 6) return 0;
  bench::Surface surface;
  for (std::size_t v = 0; v < made->mesh.vertex_count(); ++v) {
    const auto point = made->mesh.vertex(v);
    surface.points.insert(surface.points.end(), point.begin(), point.end());
  }
  surface.triangles = made->mesh.triangles;
  bench::write_surface(argv[6], surface);
}
