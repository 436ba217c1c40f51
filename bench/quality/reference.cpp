// The reference rows: Scape's fields, refined exactly like Scape to its vertex counts, judged by measure().
//
//   scarp_reference PROJECT TABLE.md     exit 3 if a row is outside its tolerance

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <optional>
#include <utility>

#include "../harness.h"
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

}  // namespace

int main(int argc, char** argv) {
  const bench::Arguments arguments(argc, argv, "scarp_reference PROJECT TABLE.md");
  std::string table = kHeader, field_name;
  scarp::OwnedHeightField field;
  std::optional<scarp::Refiner> refiner;
  scarp::MeasureOptions heights_only;
  heights_only.topology = false;
  double worst_rmse = 0, worst_triangles = 0;
  for (const auto& row : bench::kReferenceRows) {
    if (field_name != row.field) {
      field_name = row.field;
      const std::string file = fmt::format("scape_{}.stm", row.field);
      const auto path = bench::find_raster(arguments[0], file);
      if (!path) bench::die(fmt::format("{} is not there: {} is left as it was", file, arguments[1]));
      refiner.reset();
      field = bench::check(scarp::read_height_field(*path));
      refiner = bench::check(scarp::Refiner::create(field));
    }
    while (refiner->vertex_count() < row.vertices && refiner->insert_worst()) {
    }
    const auto judged = bench::check(scarp::measure(field, refiner->mesh(), heights_only));
    const double rmse = percent(judged.rmse, row.rmse);
    const double triangles = percent(static_cast<double>(judged.triangles), static_cast<double>(row.triangles));
    worst_rmse = std::max(worst_rmse, std::abs(rmse));
    worst_triangles = std::max(worst_triangles, std::abs(triangles));
    const std::string line =
        fmt::format("| {} | {} | {} | {} | {:+.3f} % | {:.4f} | {:.4f} | {:+.2f} % | {:.3f} | {:.3f} |\n", row.field,
                    judged.vertices, judged.triangles, row.triangles, triangles, judged.rmse, row.rmse, rmse,
                    judged.max_error, row.max_error);
    fmt::print("{}", line);
    table += line;
  }
  table += fmt::format("\nLargest differences: RMSE {:.2f} %, triangles {:.3f} %.\n", worst_rmse, worst_triangles);
  bench::write_file(arguments[1], table);
  const bool kept = worst_rmse <= 100 * bench::kRmseTolerance && worst_triangles <= 100 * bench::kTriangleTolerance;
  return kept ? 0 : 3;
}
