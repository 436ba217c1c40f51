// The quality table: rasters × goals → vertices, triangles, max error and RMSE as measure() judges the mesh. No times
// in it: the file is the same on every machine and only changes when the meshes do.
//
//   scarp_quality PROJECT RESULTS.csv [NAME...]     all of PROJECT/bench/quality/rasters.txt, or the named ones

#include <fmt/format.h>

#include <cstdio>
#include <iostream>
#include <vector>

#include "files.h"
#include "scarp/scarp.h"

namespace {

struct Goal {
  const char* name;
  double error_of_relief;    ///< max error as a share of the relief; 0: none
  double vertices_of_valid;  ///< vertex budget as a share of the valid samples; 0: none
};

constexpr Goal kGoals[] = {
    {"error 0.5%", 0.005, 0}, {"error 2%", 0.02, 0}, {"error 10%", 0.1, 0}, {"vertices 1%", 0, 0.01}};

constexpr const char* kHeader =
    "raster,cols,rows,valid,relief,goal,asked,vertices,triangles,percent_of_full,max_error,rmse,uncovered\n";

std::string run(const std::string& name, const scarp::OwnedHeightField& field, const Goal& goal) {
  const double relief = field.info.max - field.info.min;
  scarp::SimplifyOptions options;
  options.quality.effort = scarp::Effort::kFast;
  double asked = 0;
  if (goal.error_of_relief > 0) {
    asked = goal.error_of_relief * relief;
    options.goals.max_error = asked;
  } else {
    options.goals.max_vertices =
        static_cast<std::uint64_t>(goal.vertices_of_valid * static_cast<double>(field.info.valid));
    asked = static_cast<double>(*options.goals.max_vertices);
  }
  const std::string key = fmt::format("{},{},{},{},{:.9g},{},{:.9g}", name, field.cols, field.rows, field.info.valid,
                                      relief, goal.name, asked);
  const auto result = scarp::simplify(field, options);
  if (!result) {
    fmt::print(stderr, "{}, {}: {}\n", name, goal.name, result.error().message);
    return fmt::format("{},,,,,,\n", key);
  }
  scarp::MeasureOptions heights_only;
  heights_only.topology = false;
  const auto judged = scarp::measure(field, result->mesh, heights_only);
  if (!judged) {
    fmt::print(stderr, "{}, {}: {}\n", name, goal.name, judged.error().message);
    return fmt::format("{},,,,,,\n", key);
  }
  const double full = 2.0 * (field.cols - 1) * (field.rows - 1);
  return fmt::format("{},{},{},{:.4f},{:.7g},{:.7g},{}\n", key, judged->vertices, judged->triangles,
                     100 * static_cast<double>(judged->triangles) / full, judged->max_error, judged->rmse,
                     judged->uncovered);
}

}  // namespace

int main(int argc, char** argv) {
  if (argc < 3) {
    fmt::print(stderr, "usage: scarp_quality PROJECT RESULTS.csv [NAME...]\n");
    return 1;
  }
  const std::filesystem::path project = argv[1];
  std::vector<std::string> names(argv + 3, argv + argc);
  if (names.empty()) names = bench::read_names(project / "bench/quality/rasters.txt");
  std::string table = kHeader;
  int missing = 0;
  for (const auto& name : names) {
    const auto path = bench::find_raster(project, name);
    if (!path) {
      fmt::print(stderr, "{} is not there\n", name);
      ++missing;
      continue;
    }
    const auto field = scarp::read_height_field(*path);
    if (!field) {
      fmt::print(stderr, "{}\n", field.error().message);
      return 2;
    }
    for (const Goal& goal : kGoals) {
      const std::string row = run(name, *field, goal);
      table += row;
      std::cout << row << std::flush;
    }
  }
  if (missing > 0) {
    fmt::print(stderr, "{} rasters are not there: {} is left as it was\n", missing, argv[2]);
    return 2;
  }
  return bench::write_table(argv[2], table);
}
