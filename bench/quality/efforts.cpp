// The results of each effort for an error: rasters × goals × variants → triangles, their ratio to greedy insertion,
// errors and angles as measure() judges them. Times go to a table of their own: this one is the same on every machine.
//
//   scarp_efforts PROJECT EFFORTS.csv SECONDS.csv [NAME...]
//
// All of PROJECT/bench/quality/efforts.txt, or the named ones, whose rows then are put in place of the old ones. Ends
// with 3 as soon as a mesh breaks its bound, does not cover a sample, or is not sound.

#include <fmt/format.h>

#include <cstdio>

#include "files.h"
#include "judge.h"
#include "scarp/scarp.h"
#include "variants.h"

namespace {

constexpr double kPercentsOfRelief[] = {5, 2, 1, 0.5, 0.2};

constexpr const char* kHeader =
    "raster,cols,rows,valid,percent_of_relief,max_error_asked,effort,vertices,triangles,ratio,percent_of_full,max_"
    "error,"
    "rmse,min_angle,angle_p1,angle_median\n";
constexpr const char* kSecondsHeader = "raster,percent_of_relief,effort,vertices,cpu_seconds\n";

struct Tables {
  std::string efforts = kHeader, seconds = kSecondsHeader;
};

void add_rows(const std::string& name, const scarp::OwnedHeightField& field, double percent, double max_error,
              const bench::Variant& variant, const bench::Made& made, double greedy_triangles, Tables& tables) {
  const scarp::Measurement& judged = made.judged;
  const auto triangles = static_cast<double>(judged.triangles);
  tables.efforts += fmt::format(
      "{},{},{},{},{:g},{:.9g},{},{},{},{:.4f},{:.4f},{:.7g},{:.7g},{:.4f},{:.3f},{:.2f}\n", name, field.cols,
      field.rows, field.info.valid, percent, max_error, variant.name, variant.vertices, judged.triangles,
      triangles / greedy_triangles, 100 * triangles / (2.0 * (field.cols - 1) * (field.rows - 1)), judged.max_error,
      judged.rmse, judged.min_angle, judged.angle_percentiles[0], judged.angle_percentiles[2]);
  tables.seconds += fmt::format("{},{:g},{},{},{:.3f}\n", name, percent, variant.name, variant.vertices, made.seconds);
}

/// All goals and variants of one raster; the program's exit code.
int run(const std::string& name, const scarp::OwnedHeightField& field, Tables& tables) {
  const double relief = field.info.max - field.info.min;
  for (const double percent : kPercentsOfRelief) {
    const double max_error = percent / 100 * relief;
    double greedy_triangles = 0;
    for (const bench::Variant& variant : bench::kVariants) {
      if (greedy_triangles > variant.most_greedy_triangles) continue;
      const auto made = bench::make(field, bench::options_of(variant, max_error));
      const std::string fault = made ? bench::find_fault(made->judged, max_error) : made.error().message;
      if (!fault.empty()) {
        fmt::print(stderr, "{}, {:g} % of the relief, {}: {}\n", name, percent, variant.name, fault);
        return 3;
      }
      if (greedy_triangles == 0) greedy_triangles = static_cast<double>(made->judged.triangles);
      add_rows(name, field, percent, max_error, variant, *made, greedy_triangles, tables);
      fmt::print("{:28}{:4g} %  {:8}{:9}{:8.4f}{:9.3f} s\n", name, percent, variant.name, made->judged.triangles,
                 static_cast<double>(made->judged.triangles) / greedy_triangles, made->seconds);
      std::fflush(stdout);
    }
  }
  return 0;
}

}  // namespace

int main(int argc, char** argv) {
  if (argc < 4) {
    fmt::print(stderr, "usage: scarp_efforts PROJECT EFFORTS.csv SECONDS.csv [NAME...]\n");
    return 1;
  }
  const std::filesystem::path project = argv[1];
  const std::vector<std::string> all = bench::read_names(project / "bench/quality/efforts.txt");
  std::vector<std::string> names(argv + 4, argv + argc);
  if (names.empty()) names = all;
  for (const std::string& name : names) {
    const auto field = bench::read_field(project, name);
    if (!field) {
      fmt::print(stderr, "{}\n", field.error().message);
      return 2;
    }
    Tables tables;
    if (const int code = run(name, *field, tables)) return code;
    for (const auto& [path, table] : {std::pair{argv[2], &tables.efforts}, {argv[3], &tables.seconds}}) {
      if (const int code = bench::write_table(path, bench::replace_rows(path, *table, name, all))) return code;
    }
  }
  return 0;
}
