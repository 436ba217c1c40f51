// Vertices of the dominant and the greedy order: rasters of a million samples or more, and those of orders.txt.

#include "suite.h"

namespace bench {
namespace {

constexpr std::size_t kLeastSamples = 1'000'000;
constexpr double kErrorsOfRelief[] = {0.05, 0.02, 0.01, 0.005, 0.002};

std::vector<std::string> names(const std::filesystem::path& project) {
  std::vector<std::string> all = read_names(project / "bench/quality/rasters.txt");
  const std::vector<std::string> larger = read_names(project / "bench/quality/orders.txt");
  all.insert(all.end(), larger.begin(), larger.end());
  return all;
}

std::size_t count_vertices(const scarp::OwnedHeightField& field, double error, scarp::Order order) {
  scarp::SimplifyOptions options;
  options.goals.max_error = error;
  options.quality.order = order;
  options.quality.effort = scarp::Effort::kFast;
  return check(scarp::simplify(field, options)).mesh.vertex_count();
}

void measure(const std::string& name, const scarp::OwnedHeightField& source, Rows& rows) {
  if (source.samples.size() < kLeastSamples) return;
  scarp::OwnedHeightField field = source;
  field.frame = scarp::grid_frame(field.rows);
  for (const double share : kErrorsOfRelief) {
    const double asked = share * relief_of(field);
    if (asked < field.sample_rounding) continue;
    const auto few = count_vertices(field, asked, scarp::Order::kGreedy);
    const auto many = count_vertices(field, asked, scarp::Order::kDominant);
    rows.add(fmt::format("{},{},{:.9g},{:.3f},{},{},{:.4f}", name, field.samples.size(), asked,
                         100 * static_cast<double>(few) / static_cast<double>(field.samples.size()), few, many,
                         static_cast<double>(many) / static_cast<double>(few)));
  }
}

}  // namespace

const Suite kOrders{"orders", "raster,samples,asked,greedy_percent_kept,greedy,dominant,ratio", names, measure};

}  // namespace bench
