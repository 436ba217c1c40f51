// Scarp on a raw raster, run like its peers. The time covers all of simplify(), its proof included.
//
//   peer_scarp RASTER COLS ROWS -e ERROR VARIANT [SURFACE]         VARIANT: one of kVariants of ../quality/variants.h
//   peer_scarp RASTER COLS ROWS -t TRIANGLES VARIANT [SURFACE]     one of its kBudgetVariants

#include "../quality/variants.h"
#include "../speed/field.h"
#include "scarp/scarp.h"

namespace {

scarp::SimplifyOptions options_of(const bench::Arguments& arguments) {
  if (arguments[3] == "-t") {
    if (const auto* variant = bench::find_budget_variant(arguments[5]))
      return bench::options_of(*variant, std::stoull(arguments[4]));
  } else if (const auto* variant = bench::find_variant(arguments[5])) {
    return bench::options_of(*variant, arguments.number(4));
  }
  bench::die("there is no variant " + arguments[5]);
}

}  // namespace

int main(int argc, char** argv) {
  const bench::Arguments arguments(argc, argv, "peer_scarp RASTER COLS ROWS -e|-t GOAL VARIANT [SURFACE]");
  const bench::RawRaster raster = bench::read_raw(arguments);
  const scarp::HeightField field = bench::field_of(raster);
  const scarp::SimplifyOptions options = options_of(arguments);
  const bench::Stopwatch watch;
  const auto made = bench::check(scarp::simplify(field, options));
  bench::print_result(scarp::version(), watch.read(), made.mesh.vertex_count(), made.mesh.triangle_count());
  if (arguments.count() == 6) return 0;
  bench::Surface surface;
  for (std::size_t v = 0; v < made.mesh.vertex_count(); ++v) {
    const auto point = made.mesh.vertex(v);
    surface.points.insert(surface.points.end(), point.begin(), point.end());
  }
  surface.triangles = made.mesh.triangles;
  bench::write_mesh(arguments[6], surface);
}
