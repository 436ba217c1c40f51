// Vertices in the locally dominant order compared with those in the greedy one, at goals from coarse to fine. No times
// in it: the file only changes when the meshes do.
//
//   scarp_orders PROJECT RESULTS.csv     the rasters of PROJECT/bench/quality/rasters.txt of a million samples or more,
//                                        and those of orders.txt

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <iostream>

#include "files.h"
#include "scarp/scarp.h"

namespace {

constexpr std::size_t kLeastSamples = 1'000'000;
constexpr double kErrorsOfRelief[] = {0.05, 0.02, 0.01, 0.005, 0.002};

std::optional<scarp::Simplified> refine(const scarp::OwnedHeightField& field, double error, scarp::Order order) {
  scarp::SimplifyOptions options;
  options.goals.max_error = error;
  options.quality.order = order;
  options.quality.effort = scarp::Effort::kFast;
  auto result = scarp::simplify(field, options);
  if (!result) {
    fmt::print(stderr, "{}: {}\n", field.info.path, result.error().message);
    return std::nullopt;
  }
  return std::move(*result);
}

/// The ratios of one group of goals.
struct Summary {
  std::vector<double> ratios;

  std::string line(const std::string& what) {
    std::sort(ratios.begin(), ratios.end());
    double logs = 0;
    for (const double ratio : ratios) logs += std::log(ratio);
    const double mean = ratios.empty() ? 1 : std::exp(logs / static_cast<double>(ratios.size()));
    return ratios.empty()
               ? ""
               : fmt::format(
                     "\"dominant ÷ greedy, {}: {} meshes, lowest, geometric mean, highest\",,,,{:.4f},{:.4f},{:.4f}\n",
                     what, ratios.size(), ratios.front(), mean, ratios.back());
  }
};

}  // namespace

int main(int argc, char** argv) {
  if (argc != 3) {
    fmt::print(stderr, "usage: scarp_orders PROJECT RESULTS.csv\n");
    return 1;
  }
  const std::filesystem::path project = argv[1];
  std::vector<std::string> names = bench::read_names(project / "bench/quality/rasters.txt");
  const std::vector<std::string> larger = bench::read_names(project / "bench/quality/orders.txt");
  names.insert(names.end(), larger.begin(), larger.end());
  std::string table = "raster,samples,asked,greedy_percent_kept,greedy,dominant,ratio\n";
  Summary coarse, fine;
  for (const auto& name : names) {
    const auto path = bench::find_raster(project, name);
    if (!path) {
      fmt::print(stderr, "{} is not there: {} is left as it was\n", name, argv[2]);
      return 2;
    }
    auto field = scarp::read_height_field(*path);
    if (!field) {
      fmt::print(stderr, "{}\n", field.error().message);
      return 2;
    }
    if (field->samples.size() < kLeastSamples) continue;
    field->frame = scarp::grid_frame(field->rows);
    for (const double share : kErrorsOfRelief) {
      const double asked = share * (field->info.max - field->info.min);
      if (asked < field->sample_rounding) continue;
      const auto greedy = refine(*field, asked, scarp::Order::kGreedy);
      const auto dominant = refine(*field, asked, scarp::Order::kDominant);
      if (!greedy || !dominant) return 3;
      const auto few = greedy->mesh.vertex_count(), many = dominant->mesh.vertex_count();
      const double ratio = static_cast<double>(many) / static_cast<double>(few);
      const double kept = static_cast<double>(few) / static_cast<double>(field->samples.size());
      (kept < 0.001 ? coarse : fine).ratios.push_back(ratio);
      const std::string row = fmt::format("{},{},{:.9g},{:.3f},{},{},{:.4f}\n", name, field->samples.size(), asked,
                                          100 * kept, few, many, ratio);
      std::cout << row << std::flush;
      table += row;
    }
  }
  table += coarse.line("below 0.1 % kept") + fine.line("0.1 % kept or more");
  return bench::write_table(argv[2], table);
}
