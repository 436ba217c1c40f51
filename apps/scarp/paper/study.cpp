#include "paper/study.h"

#include <fmt/format.h>
#include <time.h>

#include <algorithm>
#include <cmath>

#include "scarp/measure.h"
#include "session/text/text.h"
#include "terminal/signals.h"

namespace scarp::paper {
namespace {

constexpr double kThinDegrees = 5;

/// Tests the triangle's corners in plan view.
bool is_thin(const Mesh& mesh, std::size_t triangle) {
  std::array<std::array<double, 2>, 3> p;
  for (std::size_t k = 0; k < 3; ++k) {
    const std::size_t v = mesh.triangles[3 * triangle + k];
    p[k] = {mesh.positions[3 * v], mesh.positions[3 * v + 1]};
  }
  for (std::size_t k = 0; k < 3; ++k) {
    const auto &a = p[k], &b = p[(k + 1) % 3], &c = p[(k + 2) % 3];
    const double ux = b[0] - a[0], uy = b[1] - a[1], vx = c[0] - a[0], vy = c[1] - a[1];
    const double angle = std::atan2(std::abs(ux * vy - uy * vx), ux * vx + uy * vy);
    if (angle * 180 < kThinDegrees * 3.14159265358979323846) return true;
  }
  return false;
}

Trial summarize(const Simplified& run) {
  Trial trial;
  trial.vertices = run.mesh.vertex_count();
  trial.triangles = run.mesh.triangle_count();
  trial.max_error = run.measurement.max_error;
  trial.rmse = run.measurement.rmse;
  std::size_t thin = 0;
  for (std::size_t t = 0; t < run.mesh.triangle_count(); ++t) thin += is_thin(run.mesh, t) ? 1 : 0;
  trial.thin_share = 100 * static_cast<double>(thin) / static_cast<double>(std::max<std::uint64_t>(trial.triangles, 1));
  trial.work = run.work;
  return trial;
}

/// CPU time of the whole process so far.
double cpu_seconds() {
  timespec now{};
  clock_gettime(CLOCK_PROCESS_CPUTIME_ID, &now);
  return static_cast<double>(now.tv_sec) + 1e-9 * static_cast<double>(now.tv_nsec);
}

}  // namespace

Study::Study(Fields given, std::string data, bool timed, bool quiet)
    : fields(std::move(given)), folder(std::move(data)), timing(timed), quiet_(quiet) {}

void Study::note(const std::string& what) const {
  if (!quiet_) cli::print_to_stderr(fmt::format("paper: {}\n", what));
}

const Field* Study::find(const std::string& key) const {
  for (const Field& field : fields.all) {
    if (field.key == key) return &field;
  }
  return nullptr;
}

namespace {

bool goes_on(const Progress&) { return !cli::interrupted(); }

Result<Simplified> name_complaints(Result<Simplified> result, const std::string& name) {
  if (cli::interrupted()) return fail(ErrorKind::kCancelled, "interrupted");
  if (!result) return fail(result.error().kind, fmt::format("{}: {}", name, result.error().message));
  return result;
}

}  // namespace

Result<Simplified> Study::run(const HeightField& field, const std::string& name, PaperOptions options) const {
  options.run.progress = goes_on;
  return name_complaints(simplify_by_paper(field, options), name);
}

Result<Simplified> Study::run_by_effort(const HeightField& field, const std::string& name,
                                        SimplifyOptions options) const {
  options.run.progress = goes_on;
  return name_complaints(simplify(field, options), name);
}

Result<Trial> Study::reach(const Field& field, PaperOptions options) const {
  SCARP_TRY(const Simplified& result, run(field.heights, field.file, std::move(options)));
  return summarize(result);
}

Result<Trial> Study::refine(const Field& field, std::uint64_t vertices, PaperOptions options) const {
  return reach(field, exactly(vertices, std::move(options)));
}

Result<double> Study::time(const Field& field, std::uint64_t vertices, PaperOptions options) const {
  options = exactly(vertices, std::move(options));
  options.run.threads = 1;
  const double start = cpu_seconds();
  SCARP_TRY(const Simplified& result, run(field.heights, field.file, std::move(options)));
  const double judging = cpu_seconds();
  MeasureOptions heights_only;
  heights_only.topology = false;
  heights_only.run.threads = 1;
  SCARP_RETURN_IF_ERROR(measure(field.heights, result.mesh, heights_only));
  return std::max(judging - start - (cpu_seconds() - judging), 1e-6);
}

Result<Trial> Study::delaunay(const Field& field, std::uint64_t vertices) {
  const auto key = std::pair(field.key, vertices);
  if (const auto known = delaunay_.find(key); known != delaunay_.end()) return known->second;
  Result<Trial> trial = refine(field, vertices);
  if (trial) delaunay_[key] = *trial;
  return trial;
}

Result<void> Study::add_picture(const std::string& name, const std::string& caption, std::vector<std::uint8_t> png) {
  pictures_.push_back({fmt::format("images/paper/{}.png", name), std::move(png)});
  page.picture(pictures_.back().path, caption);
  return {};
}

Result<void> Study::add_plot(const std::string& name, const Plot& plot) {
  SCARP_TRY(std::vector<std::uint8_t> png, draw_plot(plot));
  return add_picture(name, plot.title, std::move(png));
}

PaperOptions exactly(std::uint64_t vertices, PaperOptions options) {
  options.goals.max_vertices = std::max<std::uint64_t>(vertices, 4);
  options.strategy.best_of_budget = false;
  return options;
}

EdgeRule scape_edges(EdgeScore score, double shape_threshold) { return {true, score, shape_threshold, 0, false}; }

PaperOptions with_edges(const EdgeRule& edges) {
  PaperOptions options;
  options.strategy.edges = edges;
  return options;
}

UniformGrid uniform_grid(int field_cols, int field_rows, std::uint64_t vertices) {
  const double aspect = static_cast<double>(field_cols) / field_rows, count = static_cast<double>(vertices);
  UniformGrid grid;
  grid.cols = std::clamp(static_cast<int>(std::lround(std::sqrt(count * aspect))), 2, field_cols);
  grid.rows = std::clamp(static_cast<int>(std::lround(count / grid.cols)), 2, field_rows);
  const auto spread = [](int k, int of, int over) {
    return static_cast<std::int32_t>((static_cast<std::int64_t>(2 * k) * (over - 1) + of - 1) / (2 * (of - 1)));
  };
  for (int j = 0; j < grid.rows; ++j) {
    for (int i = 0; i < grid.cols; ++i) {
      grid.steps.push_back({spread(i, grid.cols, field_cols), spread(j, grid.rows, field_rows)});
    }
  }
  return grid;
}

}  // namespace scarp::paper
