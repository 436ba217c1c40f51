// What effort makes of a budget: max error and RMSE for as many triangles as greedy insertion takes at 1 % of the
// relief, as ratios to the greedy mesh, and the share of the budget that is used.
//
//   scarp_budget PROJECT [RASTER]...

#include <fmt/format.h>

#include <cstdio>
#include <ctime>
#include <optional>
#include <string>
#include <vector>

#include "files.h"
#include "scarp/scarp.h"

namespace {

constexpr double kErrorOfRelief = 0.01;
constexpr const char* kRasters[] = {"fuji.tif", "bigtujunga30m.tif", "crater.tif", "jacksboro_fault.tif"};

struct Level {
  const char* name;
  scarp::Effort effort;
  scarp::Objective objective;
};
constexpr Level kLevels[] = {{"normal", scarp::Effort::kNormal, scarp::Objective::kMax},
                             {"high", scarp::Effort::kHigh, scarp::Objective::kMax},
                             {"high, rms", scarp::Effort::kHigh, scarp::Objective::kRms}};

/// Of this process: other programs on the machine count less.
double cpu_seconds() { return static_cast<double>(std::clock()) / CLOCKS_PER_SEC; }

bool measure(const std::string& name, const scarp::OwnedHeightField& field) {
  scarp::SimplifyOptions options;
  options.goals.max_error = kErrorOfRelief * (field.info.max - field.info.min);
  options.quality.order = scarp::Order::kGreedy;
  options.run.threads = 1;
  const double start = cpu_seconds();
  const auto greedy = scarp::simplify(field, options);
  if (!greedy) return false;
  const double greedy_seconds = cpu_seconds() - start;
  options.quality.order = scarp::Order::kAuto;
  options.goals.max_error = std::nullopt;
  options.goals.max_triangles = greedy->mesh.triangle_count();
  for (const Level& level : kLevels) {
    options.quality.effort = level.effort;
    options.goals.objective = level.objective;
    const double begin = cpu_seconds();
    const auto made = scarp::simplify(field, options);
    if (!made) return false;
    const scarp::Measurement &before = greedy->measurement, &after = made->measurement;
    fmt::print("{:20}{:>9}  {:10}{:9.4f}{:12.3f}{:8.3f}{:8.1f}\n", name, *options.goals.max_triangles, level.name,
               static_cast<double>(made->mesh.triangle_count()) / static_cast<double>(*options.goals.max_triangles),
               after.max_error / before.max_error, after.rmse / before.rmse, (cpu_seconds() - begin) / greedy_seconds);
    std::fflush(stdout);
  }
  return true;
}

}  // namespace

int main(int argc, char** argv) {
  if (argc < 2) {
    fmt::print(stderr, "usage: scarp_budget PROJECT [RASTER]...\n");
    return 1;
  }
  std::vector<std::string> names(argv + 2, argv + argc);
  if (names.empty()) names.assign(std::begin(kRasters), std::end(kRasters));
  fmt::print("{:20}{:>9}  {:10}{:>9}{:>12}{:>8}{:>8}\n", "raster", "budget", "effort", "used", "max error", "RMSE",
             "time");
  for (const std::string& name : names) {
    const auto path = bench::find_raster(argv[1], name);
    if (!path) {
      fmt::print(stderr, "{} is not there\n", name);
      return 2;
    }
    const auto field = scarp::read_height_field(*path);
    if (!field || !measure(name, *field)) {
      fmt::print(stderr, "{} cannot be read or simplified\n", name);
      return 2;
    }
  }
  return 0;
}
