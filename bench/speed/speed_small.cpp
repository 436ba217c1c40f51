// Times simplify(), including proof, on small windows of a raw raster, as in tile production: sequentially in one
// process, on one thread.
//
//   speed_small RASTER COLS ROWS [--side N] [--triangles N] [--error E] [--effort fast|normal|high] [--rounds N]
//
// One JSON line. Uses at most 100 windows of N by N samples (64), spread over the raster, for a budget, an error, or
// both. "milliseconds" are CPU time per window: the least of N rounds (7) for each window, then the median and the
// maximum over windows. "mean_error" is the mean of max errors.

#include <algorithm>

#include "field.h"
#include "scarp/simplify.h"
#include "scarp/version.h"

namespace {

/// Windows evenly spaced over the raster.
std::vector<bench::RawRaster> cut_windows(const bench::RawRaster& raster, int side) {
  constexpr int kMost = 10;  // windows per row, and rows
  const int across = std::min(raster.cols / side, kMost), down = std::min(raster.rows / side, kMost);
  if (across < 1 || down < 1) bench::die("the raster is smaller than a window");
  std::vector<bench::RawRaster> windows;
  for (int j = 0; j < down; ++j) {
    for (int i = 0; i < across; ++i) {
      const int col = across > 1 ? i * ((raster.cols - side) / (across - 1)) : 0;
      const int row = down > 1 ? j * ((raster.rows - side) / (down - 1)) : 0;
      windows.push_back(bench::window_of(raster, col, row, side, side));
    }
  }
  return windows;
}

}  // namespace

int main(int argc, char** argv) {
  const bench::Arguments arguments(argc, argv,
                                   "speed_small RASTER COLS ROWS [--side N] [--triangles N] [--error E] "
                                   "[--effort fast|normal|high] [--rounds N]");
  scarp::SimplifyOptions options;
  options.quality.effort = bench::effort_of(arguments.value("--effort", "normal"));
  options.run.threads = 1;
  if (arguments.has("--triangles")) options.goals.max_triangles = arguments.number("--triangles", std::uint64_t{0});
  if (arguments.has("--error")) options.goals.max_error = arguments.number("--error", 0.0);
  const int side = arguments.number("--side", 64), rounds = arguments.number("--rounds", 7);
  if (side < 2 || rounds < 1) bench::die("--side is at least 2, --rounds at least 1");
  const std::vector<bench::RawRaster> windows = cut_windows(bench::read_raw(arguments), side);
  std::vector<bench::Times> least(windows.size());
  std::uint64_t triangles = 0, vertices = 0;
  double sum_of_errors = 0;
  for (int round = 0; round < rounds; ++round) {
    triangles = vertices = 0;
    sum_of_errors = 0;
    for (std::size_t i = 0; i < windows.size(); ++i) {
      const scarp::HeightField field = bench::field_of(windows[i]);
      const bench::Stopwatch watch;
      const auto made = scarp::simplify(field, options);
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
