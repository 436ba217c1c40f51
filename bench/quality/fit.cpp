// Triangles and time with removal after refinement, at goals from coarse to fine, on one thread. Ratios are to the
// greedy mesh at the same max error, and to its time.
//
//   scarp_fit PROJECT SIDE [RASTER]...     patches of SIDE samples; 0: as the library chooses
//
// +fit: removal; +repair: two rounds besides, on samples; +free: with free vertices; high: the preset with a floor of
// shapes of a tenth; max: the preset without.

#include <fmt/format.h>

#include <cmath>
#include <cstdio>
#include <ctime>
#include <optional>

#include "files.h"
#include "scarp/scarp.h"
//
#include "fit/fit.h"
#include "grid/samples.h"
#include "metric/height_metric.h"
#include "pieces/release.h"
#include "pieces/tiled.h"
#include "refine/domain.h"
#include "refine/refinement.h"

namespace {

constexpr double kErrorsOfRelief[] = {0.05, 0.02, 0.01, 0.005, 0.002};
constexpr const char* kRasters[] = {"fuji.tif", "crater.tif", "jacksboro_fault.tif", "bigtujunga30m.tif",
                                    "nrw_dom1_essen.tif"};

/// CPU time of this process: other programs on the machine count less.
double cpu_seconds() { return static_cast<double>(std::clock()) / CLOCKS_PER_SEC; }

struct Stage {
  std::optional<scarp::Triangulation> tin;
  double seconds = 0;
  std::size_t triangles = 0;

  void finish(scarp::Triangulation made, double start) {
    seconds = cpu_seconds() - start;
    for (scarp::Triangle t = 0; t < made.triangle_count(); ++t) triangles += !made.is_outside(t);
    tin = std::move(made);
  }
};

Stage refine_greedily(const scarp::Raster& raster, const scarp::Frame& frame, double error) {
  Stage stage;
  const double start = cpu_seconds();
  auto domain = scarp::build_domain(raster, 0, frame);
  const scarp::HeightMetric metric(raster, error);
  {
    scarp::Refinement refinement(metric, domain->tin);
    while (!refinement.done()) refinement.insert_worst();
  }
  stage.finish(std::move(domain->tin), start);
  return stage;
}

/// Refines like the library by default; nothing where it would rather be greedy.
Stage refine_in_tiles(const scarp::HeightField& field, const scarp::Raster& raster, double error) {
  Stage stage;
  const double start = cpu_seconds();
  auto tiled = scarp::refine_tiled(field, {.threshold = error, .threads = 1, .may_decline = true});
  if (!tiled || !*tiled) return stage;
  const scarp::HeightMetric metric(raster, error);
  scarp::release_seams((*tiled)->domain.tin, metric, std::move((*tiled)->seams));
  stage.finish(std::move((*tiled)->domain.tin), start);
  return stage;
}

Stage fit(const scarp::Raster& raster, Stage from, const scarp::FitOptions& options) {
  Stage stage;
  if (!from.tin) return stage;
  const double start = cpu_seconds();
  auto fitted = *scarp::fit(raster, std::move(*from.tin), options);
  stage.finish(std::move(fitted.tin), start);
  return stage;
}

void measure(const std::string& name, const scarp::OwnedHeightField& field, std::int32_t side) {
  const auto samples = scarp::Samples::of(field);
  const scarp::Raster raster = samples->raster();
  for (const double share : kErrorsOfRelief) {
    const double error = share * (field.info.max - field.info.min);
    Stage greedy = refine_greedily(raster, field.frame, error);
    Stage tiled = refine_in_tiles(field, raster, error);
    const scarp::FitOptions removal{.threshold = error, .threads = 1, .patch_side = side};
    scarp::FitOptions repair = removal;
    repair.depth.rounds = 2;
    scarp::FitOptions free = repair;
    free.vertices_are_free = true;
    const Stage after_greedy = fit(raster, std::move(greedy), removal),
                after_tiled = fit(raster, std::move(tiled), removal);
    const Stage freed = fit(raster, refine_greedily(raster, field.frame, error), free);
    scarp::FitOptions high = free;
    high.depth = scarp::kHighDepth;
    high.min_shape = 0.1;
    scarp::FitOptions deepest = free;
    deepest.depth = scarp::kMaxDepth;
    const Stage shapely = fit(raster, refine_greedily(raster, field.frame, error), high);
    const Stage deep = fit(raster, refine_greedily(raster, field.frame, error), deepest);
    const Stage repaired = fit(raster, refine_greedily(raster, field.frame, error), repair);
    const auto triangles = static_cast<double>(greedy.triangles);
    const auto ratio = [&](const Stage& stage) { return static_cast<double>(stage.triangles) / triangles; };
    fmt::print("{:20} {:4.1f} %{:9}{:9.3f}{:8.2f}{:9.3f}{:8.2f}{:9.3f}{:8.2f}{:9.3f}{:8.2f}{:9.3f}{:8.2f}   ", name,
               100 * share, greedy.triangles, ratio(after_greedy), after_greedy.seconds / greedy.seconds,
               ratio(repaired), repaired.seconds / greedy.seconds, ratio(freed), freed.seconds / greedy.seconds,
               ratio(shapely), shapely.seconds / greedy.seconds, ratio(deep), deep.seconds / greedy.seconds);
    if (after_tiled.tin) {
      fmt::print("{:8.3f}{:8.3f}{:8.2f}{:8.2f}", ratio(tiled), ratio(after_tiled), tiled.seconds / greedy.seconds,
                 (tiled.seconds + after_tiled.seconds) / greedy.seconds);
    }
    fmt::print("   {:.3f} s\n", greedy.seconds);
    std::fflush(stdout);
  }
}

}  // namespace

int main(int argc, char** argv) {
  if (argc < 3) {
    fmt::print(stderr, "usage: scarp_fit PROJECT SIDE [RASTER]...\n");
    return 1;
  }
  std::vector<std::string> names(argv + 3, argv + argc);
  if (names.empty()) names.assign(std::begin(kRasters), std::end(kRasters));
  fmt::print("{:27}{:>9}{:>9}{:>8}{:>9}{:>8}{:>9}{:>8}{:>9}{:>8}{:>9}{:>8}   {:>8}{:>8}{:>8}{:>8}\n",
             "raster, error of relief", "greedy", "+fit", "time", "+repair", "time", "+free", "time", "high", "time",
             "max", "time", "tiles", "+fit", "time", "in all");
  for (const std::string& name : names) {
    const auto path = bench::find_raster(argv[1], name);
    if (!path) {
      fmt::print(stderr, "{} is not there\n", name);
      return 2;
    }
    const auto field = scarp::read_height_field(*path);
    if (!field) {
      fmt::print(stderr, "{}\n", field.error().message);
      return 2;
    }
    measure(name, *field, std::atoi(argv[2]));
  }
  return 0;
}
