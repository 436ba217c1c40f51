// Times the updates of live fields, on one thread, by effort and cell size, against one simplify() of the whole field.
//
//   speed_live [RASTER COLS ROWS] [--error E] [--window N] [--updates N] [--effort E] [--cells N...]
//   speed_live --readers N [--error E] [--window N] [--updates N]
//   speed_live [RASTER COLS ROWS] --budget TRIANGLES [--error E] [--window N] [--updates N] [--effort E] [--cells N...]
//
// Without a raster: an elevation map of 500 × 500 cells of 5 cm, with boxes on a floor with 5 mm of noise, and holes;
// errors of 2 cm. An update writes a window of N × N samples (50) at a random place: the field's samples with new noise
// of a quarter of the error. CSV: milliseconds of CPU time of an update (mean, 99th percentile, worst) and of
// simplify() on the whole field, and the triangles of both. With --readers: updates per second (wall clock) at fast
// effort while N other threads query changes every millisecond, and the slowest update. With --budget: an update digs a
// crater or raises a hill of up to 40 errors; CSV: the smallest and largest count of triangles as parts of the budget,
// updates that moved bounds, and triangles of changed cells per update.

#include <algorithm>
#include <atomic>
#include <chrono>
#include <cmath>
#include <cstdint>
#include <limits>
#include <numeric>
#include <random>
#include <string>
#include <thread>
#include <vector>

#include "field.h"
#include "scarp/live.h"
#include "scarp/simplify.h"

namespace {

bench::RawRaster make_map(std::uint32_t seed) {
  bench::RawRaster map{{}, 500, 500};
  std::mt19937 random(seed);
  const auto uniform = [&] { return static_cast<float>(random()) / 4294967296.0f; };
  for (int k = 0; k < map.cols * map.rows; ++k)
    map.samples.push_back(0.01f * (uniform() + uniform() + uniform() - 1.5f));  // 5 mm
  const auto fill = [&](int count, int least, int most, auto height) {
    for (int k = 0; k < count; ++k) {
      const int cols = least + static_cast<int>(uniform() * static_cast<float>(most - least)), rows = cols;
      const int col = static_cast<int>(uniform() * static_cast<float>(map.cols - cols));
      const int row = static_cast<int>(uniform() * static_cast<float>(map.rows - rows));
      const float add = height();
      for (int y = row; y < row + rows; ++y) {
        for (int x = col; x < col + cols; ++x) map.samples[static_cast<std::size_t>(y * map.cols + x)] += add;
      }
    }
  };
  fill(60, 8, 40, uniform);
  fill(30, 2, 9, [] { return std::numeric_limits<float>::quiet_NaN(); });
  return map;
}

struct Bench {
  const bench::RawRaster& raster;
  double error;
  int window, updates;

  /// Calls note(times) after each update. `hill`: the largest height, in errors, that an update raises or digs.
  template <class Note>
  void update(scarp::LiveField& live, double hill, const Note& note) const {
    std::mt19937 random(1);
    const auto uniform = [&] { return static_cast<double>(random()) / 4294967296.0 - 0.5; };
    for (int k = 0; k < updates; ++k) {
      const int col = static_cast<int>(random() % static_cast<unsigned>(raster.cols - window + 1));
      const int row = static_cast<int>(random() % static_cast<unsigned>(raster.rows - window + 1));
      bench::RawRaster part = bench::window_of(raster, col, row, window, window);
      const double height = hill > 0 ? 2 * hill * uniform() : 0;
      for (int at = 0; at < window * window; ++at) {
        const double x = 2.0 * (at % window + 1) / (window + 1) - 1, y = 2.0 * (at / window + 1) / (window + 1) - 1;
        const double bump = std::max(0.0, 1 - x * x - y * y);
        part.samples[static_cast<std::size_t>(at)] +=
            static_cast<float>(error * (uniform() / 4 + height * bump * bump));
      }
      const bench::Stopwatch watch;
      const auto updated = live.update({col, row, window, window}, part.samples);
      note(watch.read());
      if (!updated) bench::die(updated.error().message);
    }
  }

  void run_with_readers(int count) const {
    scarp::LiveField live = bench::check(scarp::LiveField::create(bench::field_of(raster), {error}));
    std::atomic<bool> is_done = false;
    std::vector<std::thread> readers;
    for (int k = 0; k < count; ++k) {
      readers.emplace_back([&] {
        for (std::uint64_t version = 0; !is_done; std::this_thread::sleep_for(std::chrono::milliseconds(1)))
          version = live.changes(version).version;
      });
    }
    double sum = 0, worst = 0;
    update(live, 0, [&](const bench::Times& times) {
      sum += times.wall;
      worst = std::max(worst, times.wall);
    });
    is_done = true;
    for (std::thread& reader : readers) reader.join();
    std::printf("readers,updates_per_second,worst_ms\n%d,%.0f,%.2f\n", count, updates / sum, 1e3 * worst);
  }

  void run_with_budget(const std::string& effort, int cell, std::uint64_t budget) const {
    scarp::LiveOptions options{0, bench::effort_of(effort), cell};
    options.max_triangles = budget;
    scarp::LiveField live = bench::check(scarp::LiveField::create(bench::field_of(raster), options));
    std::vector<double> milliseconds;
    std::uint64_t least = budget, most = 0, changed = 0, version = live.changes().version;
    std::int64_t level = live.level();
    int moved = 0;
    update(live, 40, [&](const bench::Times& times) {
      milliseconds.push_back(1e3 * times.cpu());
      least = std::min(least, live.triangle_count());
      most = std::max(most, live.triangle_count());
      moved += live.level() != level ? 1 : 0;
      level = live.level();
      const scarp::LiveChanges changes = live.changes(version);
      version = changes.version;
      changed += changes.triangle_count();
    });
    std::sort(milliseconds.begin(), milliseconds.end());
    const auto count = static_cast<double>(milliseconds.size());
    std::printf("%s,%d,%d,%d,%g,%llu,%.3f,%.3f,%.3f,%.4f,%.4f,%d,%.1f\n", effort.c_str(), raster.cols, window, cell,
                error, static_cast<unsigned long long>(budget),
                std::accumulate(milliseconds.begin(), milliseconds.end(), 0.0) / count,
                milliseconds[(milliseconds.size() - 1) * 99 / 100], milliseconds.back(),
                static_cast<double>(least) / static_cast<double>(budget),
                static_cast<double>(most) / static_cast<double>(budget), moved, static_cast<double>(changed) / count);
    std::fflush(stdout);
  }

  void run(const std::string& effort, int cell) const {
    const scarp::HeightField field = bench::field_of(raster);
    scarp::SimplifyOptions whole;
    whole.goals.max_error = error;
    whole.quality.effort = bench::effort_of(effort);
    whole.run.threads = 1;
    const bench::Stopwatch once;
    const auto mesh = bench::check(scarp::simplify(field, whole));
    const double whole_ms = 1e3 * once.read().cpu();
    scarp::LiveField live =
        bench::check(scarp::LiveField::create(field, {error, bench::effort_of(effort), cell, 1, {}}));
    const std::uint64_t triangles = live.triangle_count();
    std::vector<double> milliseconds;
    update(live, 0, [&](const bench::Times& times) { milliseconds.push_back(1e3 * times.cpu()); });
    std::sort(milliseconds.begin(), milliseconds.end());
    const double sum = std::accumulate(milliseconds.begin(), milliseconds.end(), 0.0);
    const std::size_t last = milliseconds.size() - 1;
    std::printf("%s,%d,%d,%d,%g,%.3f,%.3f,%.3f,%.1f,%llu,%zu,%.3f\n", effort.c_str(), raster.cols, window, cell, error,
                sum / static_cast<double>(milliseconds.size()), milliseconds[last * 99 / 100], milliseconds[last],
                whole_ms, static_cast<unsigned long long>(triangles), mesh.mesh.triangle_count(),
                static_cast<double>(triangles) / static_cast<double>(mesh.mesh.triangle_count()));
    std::fflush(stdout);
  }
};

}  // namespace

int main(int argc, char** argv) {
  const bench::Arguments arguments(
      argc, argv,
      "speed_live [RASTER] [COLS] [ROWS] [--readers N] [--budget TRIANGLES] [--error E] [--window N] "
      "[--updates N] [--effort E] [--cells N...]");
  const bool has_raster = arguments.count() == 3;
  const bench::RawRaster raster = has_raster ? bench::read_raw(arguments) : make_map(3);
  const double error = arguments.number("--error", 0.02);
  const Bench bench{raster, error, arguments.number("--window", 50), arguments.number("--updates", 500)};
  if (arguments.has("--readers")) {
    bench.run_with_readers(arguments.number("--readers", 0));
    return 0;
  }
  std::vector<int> cells;
  for (const std::string& cell : arguments.values("--cells")) cells.push_back(std::stoi(cell));
  if (cells.empty()) cells = {32, 48, 64, 96, 128};
  const int budget = arguments.number("--budget", 0);
  std::printf("effort,field,window,cell,error,%s\n",
              budget > 0 ? "budget,mean_ms,p99_ms,worst_ms,least,most,moved,changed_triangles"
                         : "mean_ms,p99_ms,worst_ms,whole_ms,triangles,whole_triangles,triangle_ratio");
  for (const std::string effort : {"fast", "normal", "high"}) {
    if (arguments.value("--effort", effort) != effort) continue;
    for (const int cell : cells) {
      if (budget > 0)
        bench.run_with_budget(effort, cell, static_cast<std::uint64_t>(budget));
      else
        bench.run(effort, cell);
    }
  }
}
