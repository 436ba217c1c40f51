// Times the judge on Scarp's finished mesh of a raw raster: what simplify() and `scarp measure` pay for their proof.
//
//   speed_proof RASTER COLS ROWS ERROR [--effort fast|normal|high] [--frame grid|degrees] [--repeat N] [--threads N]
//
// degrees: positions are rounded to float32 offsets, as `--crs source` writes GLB. One JSON line. "seconds" are those
// of measure() without topology (the proof of simplify()), "topology_seconds" those of the topology in addition. The
// least CPU time of N calls (5), after one unseen. Divided by the seconds of speed_verify for the same raster and error
// this shows how far the judge is from one scan of the triangles.

#include <algorithm>
#include <limits>

#include "engines.h"
#include "scarp/measure.h"
#include "scarp/simplify.h"
#include "scarp/version.h"

namespace {

struct Options {
  scarp::SimplifyOptions simplify;
  bool degrees = false;
  int calls = 5;
};

[[noreturn]] void show_usage() {
  bench::die(
      "usage: speed_proof RASTER COLS ROWS ERROR [--effort fast|normal|high] [--frame grid|degrees] [--repeat N] "
      "[--threads N]");
}

scarp::Effort effort_of(const std::string& name) {
  if (name == "fast") return scarp::Effort::kFast;
  if (name == "normal") return scarp::Effort::kNormal;
  if (name == "high") return scarp::Effort::kHigh;
  show_usage();
}

Options parse(int argc, char** argv) {
  Options options;
  if (argc < 5 || argc % 2 == 0) show_usage();
  options.simplify.goals.max_error = std::atof(argv[4]);
  options.simplify.quality.effort = scarp::Effort::kFast;
  for (int i = 5; i < argc; i += 2) {
    const std::string name = argv[i], value = argv[i + 1];
    if (name == "--effort")
      options.simplify.quality.effort = effort_of(value);
    else if (name == "--frame")
      options.degrees = value == "degrees";
    else if (name == "--repeat")
      options.calls = std::atoi(value.c_str());
    else if (name == "--threads")
      options.simplify.run.threads = std::atoi(value.c_str());
    else
      show_usage();
  }
  return options;
}

/// Cells of 3 arc seconds, whose offsets are no float32.
scarp::Frame degrees() {
  scarp::Frame frame;
  frame.kind = scarp::Frame::Kind::kSource;
  frame.affine = {-119.99958, 1.0 / 1200, 0, 39.99958, 0, -1.0 / 1200};
  return frame;
}

bench::Times least_of(int calls, const scarp::HeightField& field, const scarp::Mesh& mesh, bool topology, int threads,
                      scarp::Measurement& measured) {
  scarp::MeasureOptions options;
  options.topology = topology;
  options.run.threads = threads;
  bench::Times least;
  least.user = std::numeric_limits<double>::infinity();
  for (int call = 0; call <= calls; ++call) {
    const bench::Stopwatch watch;
    auto result = scarp::measure(field, mesh, options);
    const bench::Times times = watch.read();
    if (!result) bench::die(result.error().message);
    measured = std::move(*result);
    if (call > 0 && times.cpu() < least.cpu()) least = times;
  }
  return least;
}

}  // namespace

int main(int argc, char** argv) {
  const Options options = parse(argc, argv);
  const bench::RawRaster raster = bench::read_raw(argv[1], argv[2], argv[3]);
  scarp::HeightField field = bench::field_of(raster);
  if (options.degrees) field.frame = degrees();
  const bench::Stopwatch watch;
  const auto made = scarp::simplify(field, options.simplify);
  if (!made) bench::die(made.error().message);
  const double all = watch.cpu();
  scarp::Measurement measured;
  const int threads = options.simplify.run.threads;
  const bench::Times heights = least_of(options.calls, field, made->mesh, false, threads, measured);
  const bench::Times whole = least_of(options.calls, field, made->mesh, true, threads, measured);
  char text[300];
  std::snprintf(text, sizeof text,
                ", \"topology_seconds\": %.6f, \"simplify_seconds\": %.6f, \"max_error\": %.17g, \"rmse\": %.17g, "
                "\"p95\": %.17g",
                whole.cpu() - heights.cpu(), all, measured.max_error, measured.rmse, measured.p95);
  bench::print_result(scarp::version(), heights, made->mesh.vertex_count(), made->mesh.triangle_count(), text);
}
