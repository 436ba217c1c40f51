// The rolling elevation map of a robot: 20 times a second, a simulated range sensor measures a sector in front of the
// robot, the map follows the robot, and the mesh follows the map.
//
//   rolling_map [SECONDS] [MESH]      10 s by default; MESH: the last mesh as GLB, OBJ, PLY ...
#include <scarp/scarp.h>

#include <algorithm>
#include <chrono>
#include <cmath>
#include <cstdio>
#include <cstdlib>
#include <limits>
#include <random>
#include <vector>

namespace {

constexpr double kCell = 0.05, kSpeed = 1.0, kRate = 20;  // metres, metres and scans per second
constexpr int kSide = 200;                                // cells of the map: 10 m
constexpr float kUnknown = std::numeric_limits<float>::quiet_NaN();

/// The ground: hills, and a step like a kerb every 4 m.
double ground(double x, double y) {
  return 0.3 * std::sin(0.5 * x) * std::cos(0.4 * y) + (std::fmod(x + 400, 4.0) < 2 ? 0.15 : 0.0);
}

/// A measured window of the map; cells that the sensor did not reach are unknown.
struct Scan {
  scarp::LiveWindow window;
  std::vector<float> heights;
};

/// Measures cells up to 3 m ahead, within 35 degrees of the direction of travel, with 3 mm of noise. The robot is in
/// the middle of the map and walks east; it is `east` cells from its start.
Scan measure(int east, const std::vector<float>& map, std::mt19937& random) {
  constexpr int kReach = 60, kMiddle = kSide / 2;
  Scan scan{{kMiddle, kMiddle - kReach * 7 / 10, kReach, kReach * 7 / 5}, {}};
  std::normal_distribution<double> noise(0, 0.003);
  for (int row = scan.window.row; row < scan.window.row + scan.window.rows; ++row) {
    for (int col = scan.window.col; col < scan.window.col + scan.window.cols; ++col) {
      const double x = col - kMiddle, y = row - kMiddle;
      const bool is_seen = std::hypot(x, y) <= kReach && std::abs(std::atan2(y, x)) <= 0.61;
      const double z = ground((east + col) * kCell, row * kCell) + noise(random);
      scan.heights.push_back(is_seen ? static_cast<float>(z) : map[static_cast<std::size_t>(row * kSide + col)]);
    }
  }
  return scan;
}

/// Measures time until stopped, without the simulated sensor.
class Clock {
 public:
  void start() { start_ = std::chrono::steady_clock::now(); }
  void stop() { sum_ += std::chrono::steady_clock::now() - start_; }
  double milliseconds() const { return std::chrono::duration<double, std::milli>(sum_).count(); }

 private:
  std::chrono::steady_clock::time_point start_ = std::chrono::steady_clock::now();
  std::chrono::steady_clock::duration sum_{};
};

scarp::Result<void> run(double seconds, const char* path) {
  const std::vector<float> unknown(kSide * kSide, kUnknown);
  scarp::HeightField map;
  map.samples = unknown.data();
  map.cols = map.rows = kSide;
  map.frame.affine = {0, kCell, 0, 0, 0, -kCell};
  SCARP_TRY(auto&& live, scarp::LiveField::create(map, {.max_error = 0.02}));
  std::mt19937 random(1);
  std::vector<double> milliseconds;
  std::uint64_t version = 0, sent = 0;
  int east = 0;
  for (int scan = 0; scan < seconds * kRate; ++scan) {
    const int step = static_cast<int>(scan * kSpeed / kRate / kCell) - east;
    Clock clock;
    SCARP_RETURN_IF_ERROR(live.scroll(step, 0));
    clock.stop();
    east += step;
    const Scan seen = measure(east, live.heights(), random);
    clock.start();
    SCARP_RETURN_IF_ERROR(live.update(seen.window, seen.heights));
    const scarp::LiveChanges changes = live.changes(version);
    clock.stop();
    milliseconds.push_back(clock.milliseconds());
    version = changes.version;
    for (const auto& cell : changes.cells) sent += cell->triangle_count();
  }
  const scarp::Mesh mesh = live.mesh();
  const std::vector<float> heights = live.heights();
  scarp::HeightField now = map;
  now.samples = heights.data();
  now.frame = live.frame();
  SCARP_TRY(const auto& measured, scarp::measure(now, mesh));
  std::sort(milliseconds.begin(), milliseconds.end());
  std::printf("%zu scans: %.2f ms each in the middle, %.2f at worst; %.0f triangles sent a scan\n", milliseconds.size(),
              milliseconds[milliseconds.size() / 2], milliseconds.back(),
              static_cast<double>(sent) / static_cast<double>(milliseconds.size()));
  std::printf("now: %zu triangles for %llu cells, max error %.4f m, sound: %s\n", mesh.triangle_count(),
              static_cast<unsigned long long>(measured.samples), measured.max_error,
              measured.is_sound() ? "yes" : "no");
  if (path != nullptr) {
    SCARP_RETURN_IF_ERROR(scarp::write_mesh(mesh, path));
  }
  return {};
}

}  // namespace

int main(int argc, char** argv) {
  const double seconds = argc > 1 ? std::atof(argv[1]) : 10;
  if (!(seconds > 0)) {
    std::fprintf(stderr, "usage: rolling_map [SECONDS] [MESH]\n");
    return 1;
  }
  const auto done = run(seconds, argc > 2 ? argv[2] : nullptr);
  if (!done) std::fprintf(stderr, "%s\n", done.error().message.c_str());
  return done ? 0 : 1;
}
