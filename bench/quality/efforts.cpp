// Each effort for a max error: rasters × goals × variants → triangles, their ratio to greedy insertion, errors, angles.

#include "suite.h"
#include "variants.h"

namespace bench {
namespace {

constexpr char kList[] = "efforts";
constexpr double kPercentsOfRelief[] = {5, 2, 1, 0.5, 0.2};

void measure(const std::string& name, const scarp::OwnedHeightField& field, Rows& rows) {
  for (const double percent : kPercentsOfRelief) {
    const double max_error = percent / 100 * relief_of(field);
    double greedy_triangles = 0, greedy_seconds = 0;
    for (const Variant& variant : kVariants) {
      if (greedy_triangles > variant.most_greedy_triangles) continue;
      const Made made = make(fmt::format("{}, {:g} % of the relief, {}", name, percent, variant.name), field,
                             options_of(variant, max_error));
      const scarp::Measurement& judged = made.judged;
      const auto triangles = static_cast<double>(judged.triangles);
      if (greedy_triangles == 0) {
        greedy_triangles = triangles;
        greedy_seconds = made.seconds;
      }
      rows.add_time(variant.name, made.seconds / greedy_seconds);
      rows.add(fmt::format("{},{},{},{},{:g},{:.9g},{},{},{},{:.4f},{:.4f},{:.7g},{:.7g},{:.4f},{:.3f},{:.2f}", name,
                           field.cols, field.rows, field.info.valid, percent, max_error, variant.name, variant.vertices,
                           judged.triangles, triangles / greedy_triangles,
                           100 * triangles / (2.0 * (field.cols - 1) * (field.rows - 1)), judged.max_error, judged.rmse,
                           judged.min_angle, judged.angle_percentiles[0], judged.angle_percentiles[2]));
    }
  }
}

}  // namespace

const Suite kEfforts{"efforts",
                     "raster,cols,rows,valid,percent_of_relief,max_error_asked,effort,vertices,triangles,ratio,"
                     "percent_of_full,max_error,rmse,min_angle,angle_p1,angle_median",
                     names_in<kList>, measure};

}  // namespace bench
