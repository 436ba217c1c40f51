// Times Scarp's triangulation of a raw raster until every sample is within ERROR, without reading, measuring and
// writing.
//
//   speed_scarp RASTER COLS ROWS ERROR [--order dominant|greedy] [--threads N] [--tile SIDE] [--mesh FILE]
//                                      [--repeat N]
//   speed_scarp RASTER COLS ROWS --find SHARE...
//
// One JSON line; the environment variable SCARP_KERNEL forces an instruction set. --mesh: writes a mesh for peer_judge.
// --repeat: N calls without warm-up; the first is reported as "first", the mean of the others as the result. --find:
// the errors at which the greedy order keeps about SHARE... (ascending) of the samples.

#include <algorithm>
#include <limits>
#include <vector>

#include "engines.h"
#include "geom/scan_kernels.h"
#include "scarp/version.h"

namespace {

struct Options {
  double error;
  bool is_greedy;
  int threads, side, calls;
};

bench::EngineRun refine(const bench::RawRaster& raw, const Options& options) {
  if (options.is_greedy) return bench::refine_greedily(raw, options.error);
  return bench::refine_dominantly(raw, options.error, options.threads, options.side);
}

/// Prints the smallest max error reached up to each share, since max error is not monotone in the vertices.
void print_errors(const bench::RawRaster& raw, const std::vector<std::string>& shares) {
  const scarp::grid::Raster raster = bench::view_of(raw);
  scarp::refine::DomainMesh domain = bench::start_greedy(raster);
  const scarp::metric::HeightMetric metric(raster, 0);
  scarp::refine::Refinement refinement(metric, domain.tin);
  double error = std::numeric_limits<double>::infinity();
  for (const std::string& share : shares) {
    const double most = std::stod(share) * static_cast<double>(raw.samples.size());
    while (!refinement.done() && static_cast<double>(domain.tin.vertex_count()) < most) {
      refinement.insert_worst();
      error = std::min(error, refinement.worst_error());
    }
    std::printf("%.9g\n", error);
  }
}

bench::RawMesh mesh_of(const scarp::tin::Triangulation& tin) {
  bench::RawMesh mesh;
  for (scarp::tin::Vertex v = 0; v < tin.vertex_count(); ++v) {
    mesh.points.push_back(static_cast<std::uint32_t>(tin.point(v).x));
    mesh.points.push_back(static_cast<std::uint32_t>(tin.point(v).y));
  }
  for (scarp::tin::HalfEdge h = 0; h < 3 * tin.triangle_count(); ++h) mesh.triangles.push_back(tin.origin(h));
  return mesh;
}

/// Times of one call, including the release of its triangulation.
bench::Times time_call(const bench::RawRaster& raw, const Options& options) {
  const bench::Stopwatch watch;
  refine(raw, options);
  return watch.read();
}

bench::Times mean_of_calls(const bench::RawRaster& raw, const Options& options, int calls) {
  const bench::Stopwatch watch;
  for (int call = 0; call < calls; ++call) refine(raw, options);
  bench::Times sum = watch.read();
  for (double* value : {&sum.wall, &sum.user, &sum.system, &sum.page_faults}) *value /= calls;
  return sum;
}

}  // namespace

int main(int argc, char** argv) {
  const bench::Arguments arguments(argc, argv,
                                   "speed_scarp RASTER COLS ROWS [ERROR] [--order dominant|greedy] [--threads N] "
                                   "[--tile SIDE] [--mesh FILE] [--repeat N] [--find SHARE...]");
  const bench::RawRaster raster = bench::read_raw(arguments);
  if (arguments.has("--find")) {
    print_errors(raster, arguments.values("--find"));
    return 0;
  }
  if (arguments.count() < 4) bench::die("give an ERROR, or --find");
  const Options options{arguments.number(3), arguments.value("--order", "dominant") == "greedy",
                        arguments.number("--threads", 1), arguments.number("--tile", 0),
                        arguments.number("--repeat", 0)};
  std::string more;
  if (options.calls > 0) {
    const bench::Times first = time_call(raster, options);
    more += ", \"calls\": " + std::to_string(options.calls) + ", \"first\": {" + bench::json_of(first) + "}";
  } else {
    refine(bench::warm_up_part(raster), options);
  }
  bench::Times times;
  if (options.calls > 1) times = mean_of_calls(raster, options, options.calls - 1);
  const bench::Stopwatch watch;
  const bench::EngineRun run = refine(raster, options);
  if (options.calls <= 1) times = watch.read();
  more += std::string(", \"order\": \"") + bench::name_of(run.order) + "\", \"kernel\": \"" +
          scarp::geom::scan_kernels().name + "\", \"threads\": " + std::to_string(options.threads) +
          ", \"triangles_scanned\": " + std::to_string(run.work.triangles_scanned) +
          ", \"insertions\": " + std::to_string(run.work.passes);
  const scarp::tin::Triangulation& tin = run.domain.tin;
  bench::print_result(scarp::version(), times, tin.vertex_count(), tin.triangle_count(), more);
  if (arguments.has("--mesh")) bench::write_mesh(arguments.value("--mesh", ""), mesh_of(tin));
}
