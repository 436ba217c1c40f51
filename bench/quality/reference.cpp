// The reference rows: Scape's own fields, refined to Scape's vertex counts exactly as Scape did, judged by measure().
//
//   scarp_reference PROJECT TABLE.md     exit 3 if a row misses its tolerance

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <optional>
#include <utility>

#include "files.h"
#include "reference_rows.h"
#include "scarp/scarp.h"

namespace {

constexpr const char* kHeader =
    "# Reference rows\n"
    "\n"
    "Written by `scarp_reference` (see `bench/README.md`). Scape 1.2, the program of Garland & Heckbert 1995, was\n"
    "run on its own five fields, Delaunay, to the given numbers of vertices (corners included); Scarp inserts worst\n"
    "samples up to the same numbers, with no choice of a best prefix, and `measure()` judges the mesh over all\n"
    "samples. The max error is set by ties and the first diagonal and is not monotone in the vertices: it is given, "
    "and\n"
    "nothing is asked of it. Asked of every row: RMSE within 1 %, triangles within 0.5 %.\n"
    "The paper's other experiments are in [paper.md](paper.md).\n"
    "\n"
    "| field | vertices | triangles Scarp | Scape | difference | RMSE Scarp | Scape | difference | max Scarp | Scape "
    "|\n"
    "|---|---|---|---|---|---|---|---|---|---|\n";

double percent(double ours, double theirs) { return 100 * (ours / theirs - 1); }

/// A field that is refined further and further.
struct Run {
  scarp::OwnedHeightField field;
  std::optional<scarp::Refiner> refiner;

  scarp::Result<void> start() {
    auto created = scarp::Refiner::create(field);
    if (!created) return tl::unexpected(created.error());
    refiner = std::move(*created);
    return {};
  }

  scarp::Result<scarp::Measurement> refine_to(std::uint64_t vertices) {
    while (refiner->vertex_count() < vertices && refiner->insert_worst()) {
    }
    scarp::MeasureOptions heights_only;
    heights_only.topology = false;
    return scarp::measure(field, refiner->mesh(), heights_only);
  }
};

}  // namespace

int main(int argc, char** argv) {
  if (argc != 3) {
    fmt::print(stderr, "usage: scarp_reference PROJECT TABLE.md\n");
    return 1;
  }
  std::string table = kHeader, field_name;
  Run run;
  double worst_rmse = 0, worst_triangles = 0;
  for (const auto& row : bench::kReferenceRows) {
    if (field_name != row.field) {
      field_name = row.field;
      const std::string file = fmt::format("scape_{}.stm", row.field);
      const auto path = bench::find_raster(argv[1], file);
      if (!path) return bench::fail_with(fmt::format("{} is not there: {} is left as it was", file, argv[2]));
      auto field = scarp::read_height_field(*path);
      if (!field) return bench::fail_with(field.error().message);
      run.field = std::move(*field);
      if (auto started = run.start(); !started) return bench::fail_with(started.error().message);
    }
    const auto judged = run.refine_to(row.vertices);
    if (!judged) return bench::fail_with(judged.error().message);
    const double rmse = percent(judged->rmse, row.rmse);
    const double triangles = percent(static_cast<double>(judged->triangles), static_cast<double>(row.triangles));
    worst_rmse = std::max(worst_rmse, std::abs(rmse));
    worst_triangles = std::max(worst_triangles, std::abs(triangles));
    const std::string line =
        fmt::format("| {} | {} | {} | {} | {:+.3f} % | {:.4f} | {:.4f} | {:+.2f} % | {:.3f} | {:.3f} |\n", row.field,
                    judged->vertices, judged->triangles, row.triangles, triangles, judged->rmse, row.rmse, rmse,
                    judged->max_error, row.max_error);
    fmt::print("{}", line);
    table += line;
  }
  table += fmt::format("\nLargest differences: RMSE {:.2f} %, triangles {:.3f} %.\n", worst_rmse, worst_triangles);
  if (const int code = bench::write_table(argv[2], table); code != 0) return code;
  const bool kept = worst_rmse <= 100 * bench::kRmseTolerance && worst_triangles <= 100 * bench::kTriangleTolerance;
  return kept ? 0 : 3;
}
