// Triangles at equal max error under each edge rule and batch rule: what they save or cost against Delaunay, one
// sample at a time. All in the greedy order, so that the rules alone differ. No times in it: the file only changes when
// the meshes do.
//
//   scarp_edges PROJECT RESULTS.csv     the rasters of PROJECT/bench/quality/rasters.txt up to 2 million samples

#include <fmt/format.h>

#include <cmath>
#include <cstdio>
#include <iostream>

#include "files.h"
#include "scarp/scarp.h"

namespace {

constexpr std::size_t kMostSamples = 2'000'000;
constexpr double kErrorOfRelief = 0.02;

struct Rule {
  const char* name;
  scarp::EdgeRule edges;
  scarp::Batch batch;
};

const Rule kRules[] = {
    {"delaunay", {}, {}},
    {"sum", {true, scarp::EdgeScore::kSum}, {}},
    {"max", {true, scarp::EdgeScore::kMax}, {}},
    {"sqerr", {true, scarp::EdgeScore::kSquares}, {}},
    {"max0.2", {true, scarp::EdgeScore::kMax, 0.2}, {}},
    {"tight", {true, scarp::EdgeScore::kTight}, {}},
    {"independent", {}, {scarp::Batch::Rule::kIndependent}},
    {"const", {}, {scarp::Batch::Rule::kConstant}},
};

std::optional<std::uint64_t> count_triangles(const scarp::OwnedHeightField& field, double error, const Rule& rule) {
  scarp::PaperOptions options;
  options.goals.max_error = error;
  options.strategy.edges = rule.edges;
  options.strategy.batch = rule.batch;
  const auto result = scarp::simplify_by_paper(field, options);
  if (!result) {
    fmt::print(stderr, "{}, {}: {}\n", field.info.path, rule.name, result.error().message);
    return std::nullopt;
  }
  return result->mesh.triangle_count();
}

}  // namespace

int main(int argc, char** argv) {
  if (argc != 3) {
    fmt::print(stderr, "usage: scarp_edges PROJECT RESULTS.csv\n");
    return 1;
  }
  const std::filesystem::path project = argv[1];
  std::string table = "raster,asked";
  for (const Rule& rule : kRules) table += fmt::format(",{}", rule.name);
  table += "\n";
  std::vector<double> logs(std::size(kRules), 0);
  int rasters = 0;
  for (const auto& name : bench::read_names(project / "bench/quality/rasters.txt")) {
    const auto path = bench::find_raster(project, name);
    if (!path) {
      fmt::print(stderr, "{} is not there: {} is left as it was\n", name, argv[2]);
      return 2;
    }
    const auto field = scarp::read_height_field(*path);
    if (!field) {
      fmt::print(stderr, "{}\n", field.error().message);
      return 2;
    }
    if (field->samples.size() > kMostSamples) continue;
    const double asked = kErrorOfRelief * (field->info.max - field->info.min);
    std::string row = fmt::format("{},{:.9g}", name, asked);
    std::vector<double> counts;
    for (const Rule& rule : kRules) {
      const auto count = count_triangles(*field, asked, rule);
      if (!count) return 3;
      counts.push_back(static_cast<double>(*count));
      row += fmt::format(",{}", *count);
    }
    for (std::size_t k = 0; k < counts.size(); ++k) logs[k] += std::log(counts[k] / counts[0]);
    ++rasters;
    std::cout << row << std::endl;
    table += row + "\n";
  }
  table += fmt::format("geometric mean of the ratios to delaunay over {} rasters,", rasters);
  for (const double sum : logs) table += fmt::format(",{:.4f}", std::exp(sum / rasters));
  table += "\n";
  return bench::write_table(argv[2], table);
}
