// Triangles before and after removal, and the time of both, one thread: the greedy mesh at goals from coarse to fine.
//
//   scarp_fit PROJECT SIDE [RASTER]...     patches of SIDE samples, 0: as the library chooses

#include "fit/fit.h"

#include <fmt/format.h>

#include <cmath>
#include <cstdio>
#include <ctime>
#include <optional>

#include "files.h"
#include "refine/domain.h"
#include "refine/height_judge.h"
#include "refine/refinement.h"
#include "refine/samples.h"
#include "scarp/scarp.h"

namespace {

constexpr double kErrorsOfRelief[] = {0.05, 0.02, 0.01, 0.005, 0.002};
constexpr const char* kRasters[] = {"fuji.tif", "crater.tif", "jacksboro_fault.tif", "bigtujunga30m.tif",
                                    "nrw_dom1_essen.tif"};

/// Of this process: other programs on the machine count less.
double seconds() { return static_cast<double>(std::clock()) / CLOCKS_PER_SEC; }

std::size_t count_inside(const scarp::Triangulation& tin) {
  std::size_t count = 0;
  for (scarp::Triangle t = 0; t < tin.triangle_count(); ++t) count += !tin.is_outside(t);
  return count;
}

bool measure(const std::string& name, const scarp::OwnedHeightField& field, std::int32_t side) {
  const auto samples = scarp::Samples::of(field);
  if (!samples) return false;
  const scarp::Raster raster = samples->raster();
  for (const double share : kErrorsOfRelief) {
    const double error = share * (field.info.max - field.info.min);
    const double start = seconds();
    auto domain = scarp::build_domain(raster, 0, field.frame);
    if (!domain) return false;
    const scarp::HeightJudge judge(raster, error);
    {
      scarp::Refinement refinement(judge, domain->tin);
      while (!refinement.done()) refinement.insert_worst();
    }
    const double greedy = seconds() - start;
    const std::size_t before = count_inside(domain->tin);
    const double again = seconds();
    const auto fitted =
        scarp::fit(raster, std::move(domain->tin), {.threshold = error, .threads = 1, .patch_side = side});
    const double fit = seconds() - again;
    const std::size_t after = count_inside(fitted.tin);
    fmt::print("{:22} {:5.1f} %  {:8}  {:8}  {:.4f}   {:8.4f} s  {:8.4f} s  {:.2f}x  {:.2f} searches a vertex\n", name,
               100 * share, before, after, static_cast<double>(after) / static_cast<double>(before), greedy, fit,
               fit / greedy, static_cast<double>(fitted.counts.searches) / (static_cast<double>(before) / 2));
    std::fflush(stdout);
  }
  return true;
}

}  // namespace

int main(int argc, char** argv) {
  if (argc < 3) {
    fmt::print(stderr, "usage: scarp_fit PROJECT SIDE [RASTER]...\n");
    return 1;
  }
  std::vector<std::string> names(argv + 3, argv + argc);
  if (names.empty()) names.assign(std::begin(kRasters), std::end(kRasters));
  fmt::print("{:22} {:>7}  {:>8}  {:>8}  {:>6}   {:>10}  {:>10}\n", "raster", "error", "greedy", "fitted", "ratio",
             "greedy", "fit");
  for (const std::string& name : names) {
    const auto path = bench::find_raster(argv[1], name);
    const auto field = path ? scarp::read_height_field(*path)
                            : scarp::Result<scarp::OwnedHeightField>(
                                  tl::unexpected(scarp::Error{scarp::ErrorKind::kInput, name + " is not there"}));
    if (!field) {
      fmt::print(stderr, "{}\n", field.error().message);
      return 2;
    }
    if (!measure(name, *field, std::atoi(argv[2]))) return 3;
  }
  return 0;
}
