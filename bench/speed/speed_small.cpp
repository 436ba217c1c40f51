// Times simplify(), proof included, on small windows of a raw raster, as a maker of tiles calls it: one after the other
// in one process, on one thread.
//
//   speed_small RASTER COLS ROWS [--side N] [--triangles N] [--error E] [--effort fast|normal|high] [--rounds N]
//
// One JSON line. Windows of N by N samples (64) from all over the raster, 100 at most; towards a budget, an error, or
// both. "milliseconds" are CPU time a window: of each the least of N rounds (7), then the median of the windows, and
// the dearest. "mean_error": of the max errors.

#include <algorithm>
#include <limits>

#include "engines.h"
#include "scarp/simplify.h"
#include "scarp/version.h"

namespace {

struct Options {
  scarp::SimplifyOptions simplify;
  int side = 64, rounds = 7;
};

[[noreturn]] void show_usage() {
  bench::die(
      "usage: speed_small RASTER COLS ROWS [--side N] [--triangles N] [--error E] [--effort fast|normal|high] "
      "[--rounds N]");
}

scarp::Effort effort_of(const std::string& name) {
  if (name == "fast") return scarp::Effort::kFast;
  if (name == "normal") return scarp::Effort::kNormal;
  if (name == "high") return scarp::Effort::kHigh;
  show_usage();
}

Options parse(int argc, char** argv) {
  Options options;
  options.simplify.quality.effort = scarp::Effort::kNormal;
  options.simplify.run.threads = 1;
  if (argc < 4 || argc % 2 != 0) show_usage();
  for (int i = 4; i < argc; i += 2) {
    const std::string name = argv[i], value = argv[i + 1];
    if (name == "--effort")
      options.simplify.quality.effort = effort_of(value);
    else if (name == "--side")
      options.side = std::atoi(value.c_str());
    else if (name == "--rounds")
      options.rounds = std::atoi(value.c_str());
    else if (name == "--triangles")
      options.simplify.goals.max_triangles = std::strtoull(value.c_str(), nullptr, 10);
    else if (name == "--error")
      options.simplify.goals.max_error = std::atof(value.c_str());
    else
      show_usage();
  }
  if (options.side < 2 || options.rounds < 1) show_usage();
  return options;
}

/// Evenly from all over the raster.
std::vector<bench::RawRaster> cut_windows(const bench::RawRaster& raster, int side) {
  constexpr int kMost = 10;  // in a row, and rows
  const int across = std::min(raster.cols / side, kMost), down = std::min(raster.rows / side, kMost);
  if (across < 1 || down < 1) bench::die("the raster is smaller than a window");
  std::vector<bench::RawRaster> windows;
  for (int j = 0; j < down; ++j) {
    for (int i = 0; i < across; ++i) {
      const int col = across > 1 ? i * ((raster.cols - side) / (across - 1)) : 0;
      const int row = down > 1 ? j * ((raster.rows - side) / (down - 1)) : 0;
      bench::RawRaster window;
      window.cols = window.rows = side;
      for (int y = 0; y < side; ++y) {
        const auto begin = raster.samples.begin() + static_cast<std::ptrdiff_t>(row + y) * raster.cols + col;
        window.samples.insert(window.samples.end(), begin, begin + side);
      }
      windows.push_back(std::move(window));
    }
  }
  return windows;
}

}  // namespace

int main(int argc, char** argv) {
  const Options options = parse(argc, argv);
  const std::vector<bench::RawRaster> windows = cut_windows(bench::read_raw(argv[1], argv[2], argv[3]), options.side);
  std::vector<bench::Times> least(windows.size());
  std::uint64_t triangles = 0, vertices = 0;
  double sum_of_errors = 0;
  for (int round = 0; round < options.rounds; ++round) {
    triangles = vertices = 0;
    sum_of_errors = 0;
    for (std::size_t i = 0; i < windows.size(); ++i) {
      const scarp::HeightField field = bench::field_of(windows[i]);
      const bench::Stopwatch watch;
      const auto made = scarp::simplify(field, options.simplify);
      const bench::Times times = watch.read();
      if (!made) bench::die(made.error().message);
      if (round == 0 || times.cpu() < least[i].cpu()) least[i] = times;
      triangles += made->mesh.triangle_count();
      vertices += made->mesh.vertex_count();
      sum_of_errors += made->judged_max_error;
    }
  }
  std::sort(least.begin(), least.end(), [](const auto& a, const auto& b) { return a.cpu() < b.cpu(); });
  const auto count = static_cast<double>(windows.size());
  std::string more = ", \"windows\": " + std::to_string(windows.size()) +
                     ", \"milliseconds\": " + std::to_string(1e3 * least[least.size() / 2].cpu()) +
                     ", \"dearest\": " + std::to_string(1e3 * least.back().cpu()) +
                     ", \"mean_error\": " + std::to_string(sum_of_errors / count);
  bench::print_result(scarp::version(), least[least.size() / 2], vertices, triangles, more);
}
