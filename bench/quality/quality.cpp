// Measures meshes and updates the tables bench/quality/SUITE.csv. The tables contain no times, so they change only with
// the meshes. A run over all rasters writes mean ratios of CPU times to times.csv.
//
//   scarp_quality PROJECT SUITE [NAME...]     all rasters of the suite, or the named ones, whose rows are replaced
//
// SUITE: efforts, budgets, high_normal, edges, optimum, orders, ridges, pictures. Exit code 2: a raster is missing and
// its rows are unchanged; 3: a mesh is faulty.

#include <algorithm>
#include <array>
#include <cmath>
#include <numbers>

#include "grid/generate.h"
#include "suite.h"

namespace bench {
namespace {

constexpr std::array kSuites{&kEfforts, &kBudgets, &kHighNormal, &kEdges, &kOptimum, &kOrders, &kRidges, &kPictures};

double smallest_angle(const scarp::Mesh& mesh, std::size_t triangle) {
  std::array<std::array<double, 2>, 3> at{};
  for (std::size_t k = 0; k < 3; ++k) {
    const auto point = mesh.vertex(mesh.triangles[3 * triangle + k]);
    at[k] = {point[0], point[1]};
  }
  double least = 180;
  for (std::size_t k = 0; k < 3; ++k) {
    const auto &p = at[k], &q = at[(k + 1) % 3], &r = at[(k + 2) % 3];
    const double ax = q[0] - p[0], ay = q[1] - p[1], bx = r[0] - p[0], by = r[1] - p[1];
    least = std::min(least, std::atan2(std::abs(ax * by - ay * bx), ax * bx + ay * by) * 180 / std::numbers::pi);
  }
  return least;
}

double thin_percent(const scarp::Mesh& mesh) {
  std::size_t thin = 0;
  for (std::size_t t = 0; t < mesh.triangle_count(); ++t) thin += smallest_angle(mesh, t) < 5 ? 1 : 0;
  return 100.0 * static_cast<double>(thin) / static_cast<double>(std::max<std::size_t>(1, mesh.triangle_count()));
}

/// The fault of a mesh, if any.
std::string find_fault(const scarp::Measurement& judged, const scarp::SimplifyOptions& options) {
  // Planes through vertices between samples are not exact in double.
  constexpr double kRounding = 1 + 1e-12;
  const auto& goals = options.goals;
  if (goals.max_error && judged.max_error > kRounding * *goals.max_error)
    return fmt::format("its max error is {:.9g}", judged.max_error);
  if (goals.max_triangles && judged.triangles > *goals.max_triangles)
    return fmt::format("it has {} triangles", judged.triangles);
  if (judged.uncovered > 0) return fmt::format("{} samples are uncovered", judged.uncovered);
  return judged.is_sound() ? "" : "it folds, gapes or degenerates";
}

std::string times_of(const Suite& suite, const std::map<std::string, std::vector<double>>& times) {
  std::string rows;
  for (const auto& [variant, ratios] : times) {
    double logs = 0;
    for (const double ratio : ratios) logs += std::log(ratio);
    const auto [least, most] = std::minmax_element(ratios.begin(), ratios.end());
    rows += fmt::format("{},{},{:.4g},{:.4g},{:.4g}\n", suite.name, variant,
                        std::exp(logs / static_cast<double>(ratios.size())), *least, *most);
  }
  return rows;
}

int run(const Suite& suite, const std::filesystem::path& project, const std::vector<std::string>& some) {
  const std::filesystem::path folder = project / "bench/quality", path = folder / (std::string(suite.name) + ".csv");
  const std::vector<std::string> all = suite.names(project);
  std::map<std::string, std::vector<double>> times;
  int code = 0;
  for (const std::string& name : some.empty() ? all : some) {
    const auto field = suite.read != nullptr ? suite.read(project, name) : read_field(project, name);
    if (!field) {
      fmt::print(stderr, "{}\n", field.error().message);
      code = 2;
      continue;
    }
    Rows rows(project, suite.header);
    suite.measure(name, *field, rows);
    keep_rows(path, rows.table(), name, all);
    for (const auto& [variant, ratios] : rows.times())
      times[variant].insert(times[variant].end(), ratios.begin(), ratios.end());
  }
  if (some.empty() && code == 0 && !times.empty())
    keep_rows(folder / "times.csv", "table,variant,mean,least,most\n" + times_of(suite, times), suite.name,
              {"efforts", "budgets", "peers"});
  return code;
}

}  // namespace

void Rows::add(const std::string& row) {
  table_ += row + "\n";
  fmt::print("{}\n", row);
  std::fflush(stdout);
}

void Rows::add_time(std::string_view variant, double ratio) { times_[std::string(variant)].push_back(ratio); }

scarp::Result<scarp::OwnedHeightField> read_field(const std::filesystem::path& project, const std::string& name,
                                                  int generated_side) {
  if (const auto style = scarp::grid::find_field_style(name))
    return scarp::grid::generate_field(*style, generated_side, generated_side);
  const auto path = find_raster(project, name);
  if (!path) return tl::unexpected(scarp::Error{scarp::ErrorKind::kInput, name + " is not there"});
  return scarp::read_height_field(*path);
}

Made make(const std::string& what, const scarp::OwnedHeightField& field, const scarp::SimplifyOptions& options) {
  const Stopwatch watch;
  const auto simplified = scarp::simplify(field, options);
  Made made;
  made.seconds = watch.cpu();
  if (!simplified) die(what + ": " + simplified.error().message, 3);
  made.judged = check(scarp::measure(field, simplified->mesh));
  if (const std::string fault = find_fault(made.judged, options); !fault.empty()) die(what + ": " + fault, 3);
  made.thin_percent = thin_percent(simplified->mesh);
  return made;
}

}  // namespace bench

int main(int argc, char** argv) {
  const bench::Arguments arguments(argc, argv, "scarp_quality PROJECT SUITE [NAME...]");
  for (const bench::Suite* suite : bench::kSuites) {
    if (arguments[1] == suite->name) return bench::run(*suite, arguments[0], arguments.from(2));
  }
  bench::die("there is no suite " + arguments[1], 1);
}
