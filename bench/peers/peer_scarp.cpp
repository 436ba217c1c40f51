// Scarp itself on a raw raster, as its peers are run; the time is all of simplify(), its own proof included.
//
//   peer_scarp RASTER COLS ROWS -e ERROR VARIANT [SURFACE]         VARIANT: one of kVariants of ../quality/variants.h
//   peer_scarp RASTER COLS ROWS -t TRIANGLES VARIANT [SURFACE]     one of its kBudgetVariants

#include <string_view>

#include "../quality/variants.h"
#include "scarp/scarp.h"
#include "surface.h"

namespace {

scarp::SimplifyOptions options_of(std::string_view goal, const char* amount, const char* name) {
  if (goal == "-t") {
    const bench::BudgetVariant* variant = bench::find_budget_variant(name);
    if (variant != nullptr) return bench::options_of(*variant, std::strtoull(amount, nullptr, 10));
  } else {
    const bench::Variant* variant = bench::find_variant(name);
    if (variant != nullptr) return bench::options_of(*variant, std::atof(amount));
  }
  bench::die(std::string("there is no variant ") + name);
}

}  // namespace

int main(int argc, char** argv) {
  if (argc != 7 && argc != 8) bench::die("usage: peer_scarp RASTER COLS ROWS -e|-t GOAL VARIANT [SURFACE]");
  const bench::RawRaster raster = bench::read_raw(argv[1], argv[2], argv[3]);
  scarp::HeightField field;
  field.samples = raster.samples.data();
  field.cols = raster.cols;
  field.rows = raster.rows;
  field.frame = scarp::grid_frame(raster.rows);
  const scarp::SimplifyOptions options = options_of(argv[4], argv[5], argv[6]);

  const bench::Stopwatch watch;
  const auto made = scarp::simplify(field, options);
  const bench::Times times = watch.read();
  if (!made) bench::die(made.error().message);
  bench::print_result(scarp::version(), times, made->mesh.vertex_count(), made->mesh.triangle_count());
  if (argc == 7) return 0;
  bench::Surface surface;
  for (std::size_t v = 0; v < made->mesh.vertex_count(); ++v) {
    const auto point = made->mesh.vertex(v);
    surface.points.insert(surface.points.end(), point.begin(), point.end());
  }
  surface.triangles = made->mesh.triangles;
  bench::write_surface(argv[7], surface);
}
