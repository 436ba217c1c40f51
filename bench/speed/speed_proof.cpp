// Times the judge on Scarp's finished mesh of a raw raster: the cost of the proof in simplify() and `scarp measure`.
//
//   speed_proof RASTER COLS ROWS ERROR [--effort fast|normal|high] [--frame grid|degrees] [--repeat N] [--threads N]
//
// degrees: positions are rounded to float32 offsets, as `--crs source` writes GLB. One JSON line. "seconds": measure()
// without topology (the proof of simplify()); "topology_seconds": its topology. Both are the least CPU time of N calls
// (5), after a warm-up. The ratio to the seconds of speed_verify for the same raster and error compares the judge with
// one scan of the triangles.

#include "field.h"
#include "scarp/measure.h"
#include "scarp/simplify.h"
#include "scarp/version.h"

namespace {

/// Cells of 3 arc seconds, whose offsets are not exact in float32.
scarp::Frame degrees() {
  scarp::Frame frame;
  frame.kind = scarp::Frame::Kind::kSource;
  frame.affine = {-119.99958, 1.0 / 1200, 0, 39.99958, 0, -1.0 / 1200};
  return frame;
}

}  // namespace

int main(int argc, char** argv) {
  const bench::Arguments arguments(argc, argv,
                                   "speed_proof RASTER COLS ROWS ERROR [--effort fast|normal|high] "
                                   "[--frame grid|degrees] [--repeat N] [--threads N]");
  scarp::SimplifyOptions options;
  options.goals.max_error = arguments.number(3);
  options.quality.effort = bench::effort_of(arguments.value("--effort", "fast"));
  options.run.threads = arguments.number("--threads", options.run.threads);
  const bench::RawRaster raster = bench::read_raw(arguments);
  scarp::HeightField field = bench::field_of(raster);
  if (arguments.value("--frame", "grid") == "degrees") field.frame = degrees();
  const bench::Stopwatch watch;
  const auto made = bench::check(scarp::simplify(field, options));
  const double all = watch.cpu();
  scarp::Measurement measured;
  const auto time = [&](bool topology) {
    scarp::MeasureOptions asked;
    asked.topology = topology;
    asked.run.threads = options.run.threads;
    const auto work = [&] { measured = bench::check(scarp::measure(field, made.mesh, asked)); };
    work();
    return bench::least_of(arguments.number("--repeat", 5), work);
  };
  const bench::Times heights = time(false), whole = time(true);
  char text[300];
  std::snprintf(text, sizeof text,
                ", \"topology_seconds\": %.6f, \"simplify_seconds\": %.6f, \"max_error\": %.17g, \"rmse\": %.17g, "
                "\"p95\": %.17g",
                whole.cpu() - heights.cpu(), all, measured.max_error, measured.rmse, measured.p95);
  bench::print_result(scarp::version(), heights, made.mesh.vertex_count(), made.mesh.triangle_count(), text);
}
