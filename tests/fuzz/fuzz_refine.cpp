// Any small raster, any goal, any effort and any strategy: the bound holds, every sample of the domain is covered, and
// the mesh is sound; or there is an error with a message. The bytes choose the size, the goals, the steepness, then one
// height each: some values mean nodata and infinities, and few levels cause many ties.
#include <algorithm>
#include <cmath>
#include <cstdint>
#include <cstdlib>
#include <limits>
#include <vector>

#include "bytes.h"
#include "scarp/measure.h"
#include "scarp/paper.h"
#include "scarp/simplify.h"

namespace {

constexpr int kMaxSide = 24;

float decode_height(std::uint8_t byte, int levels, float step) {
  if (byte >= 250)
    return byte == 255 ? std::numeric_limits<float>::infinity() : std::numeric_limits<float>::quiet_NaN();
  return static_cast<float>(byte % levels) * step;
}

void require(bool holds) {
  if (!holds) std::abort();
}

double largest_height(const scarp::HeightField& field) {
  double largest = 0;
  for (int i = 0; i < field.cols * field.rows; ++i) {
    const double height = std::abs(double{field.samples[i]});
    if (std::isfinite(height)) largest = std::max(largest, height);
  }
  return largest;
}

void check_made(const scarp::HeightField& field, const scarp::SimplifyOptions& options,
                const scarp::Result<scarp::Simplified>& result) {
  if (!result) {
    require(!result.error().message.empty());
    require(result.error().kind != scarp::ErrorKind::kInternal);
    return;
  }
  const scarp::Measurement& proof = result->measurement;
  if (result->stop == scarp::StopReason::kMaxError) {
    require(options.goals.max_error || !options.tolerances.values.empty());
    // Planes through vertices between samples are not exact in double; the judge's rounding is not the mesh's.
    const double rounding = result->vertices == scarp::Vertices::kFree ? 1e-12 * largest_height(field) : 0;
    if (options.goals.max_error) require(proof.max_error <= *options.goals.max_error + rounding);
  }
  if (result->stop == scarp::StopReason::kExact) require(proof.max_error == 0);
  if (options.goals.max_triangles) require(result->mesh.triangle_count() <= *options.goals.max_triangles);
  if (options.goals.max_vertices) require(result->mesh.vertex_count() <= *options.goals.max_vertices);
  require(proof.uncovered == 0);

  scarp::MeasureOptions judge;
  judge.tolerance = options.tolerances.values;
  const auto judged = scarp::measure(field, result->mesh, judge);
  require(judged.has_value());
  require(judged->is_sound());
  require(judged->max_error == proof.max_error && judged->rmse == proof.rmse && judged->uncovered == 0);
  require(judged->over_tolerance == 0 || result->stop != scarp::StopReason::kMaxError);
  require(judged->nodata_cells_covered == 0 || options.domain.outline_tolerance > 0);
}

/// Two bytes choose a strategy; a contradictory one must be refused with a message.
void choose_strategy(Bytes& bytes, scarp::PaperOptions& options) {
  const std::uint8_t first = bytes.next(), second = bytes.next();
  options.strategy.algorithm = static_cast<scarp::Algorithm>(first % 3);
  options.strategy.batch = {static_cast<scarp::Batch::Rule>(first / 3 % 4), (second % 8) / 7.0};
  options.strategy.importance.feature = static_cast<scarp::Importance::Feature>(first / 12 % 4);
  options.strategy.importance.global = first < 200;
  options.strategy.importance.one_pass = first > 230;
  options.strategy.importance.damping = static_cast<scarp::Importance::Damping>(second % 3);
  options.strategy.edges.data_dependent = second % 2 == 1;
  options.strategy.edges.score = static_cast<scarp::EdgeScore>(second / 2 % 5);
  options.strategy.edges.shape_threshold = second / 10 % 5 / 4.0 - 0.25;
  options.strategy.edges.supersample = second / 50 % 2 * 0.8;
  options.strategy.edges.settle = second > 127;
}

void check_refiner(const scarp::HeightField& field, double outline_tolerance, int steps) {
  auto refiner = scarp::Refiner::create(field, outline_tolerance);
  if (!refiner) {
    require(!refiner.error().message.empty());
    return;
  }
  for (int step = 0; step < steps; ++step) {
    const std::uint64_t vertices = refiner->vertex_count();
    const bool exact = refiner->max_error() == 0;
    const bool inserted = refiner->insert_worst();
    require(inserted == !exact);
    require(refiner->vertex_count() == vertices + (inserted ? 1 : 0));
    if (!inserted) break;
  }
  const scarp::Mesh mesh = refiner->mesh();
  require(mesh.vertex_count() == refiner->vertex_count() && mesh.triangle_count() == refiner->triangle_count());
  const auto judged = scarp::measure(field, mesh);
  require(judged && judged->is_sound() && judged->uncovered == 0);
  require(std::abs(judged->max_error - refiner->max_error()) <= 1e-9 * (1 + refiner->max_error()));
}

}  // namespace

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  Bytes bytes(data, size);
  const int cols = bytes.next() % kMaxSide + 1, rows = bytes.next() % kMaxSide + 1;
  const int levels = bytes.next() % 250 + 1;
  const float step = std::ldexp(1.0F, bytes.next() % 24 - 12);
  const std::uint8_t goals = bytes.next();
  scarp::SimplifyOptions options;
  if (goals & 1) options.goals.max_error = static_cast<double>(bytes.next()) * static_cast<double>(step) / 16;
  if (goals & 2) options.goals.max_triangles = bytes.next();
  if (goals & 4) options.goals.max_vertices = bytes.next();
  if (goals & 8) options.domain.outline_tolerance = bytes.next() / 32.0;
  options.output.normals = (goals & 16) != 0;
  options.run.threads = 1;
  const std::uint8_t steps_and_effort = bytes.next();
  const int steps = steps_and_effort % 32;
  options.quality.effort = static_cast<scarp::Effort>(steps_and_effort / 32 % 5);
  if (steps_and_effort >= 160) options.goals.objective = scarp::Objective::kRms;
  if (steps_and_effort % 2 == 1) options.quality.vertices = scarp::Vertices::kSamples;
  scarp::PaperOptions paper;
  if (goals & 64) choose_strategy(bytes, paper);

  std::vector<float> samples(static_cast<std::size_t>(cols) * static_cast<std::size_t>(rows));
  for (float& sample : samples) sample = decode_height(bytes.next(), levels, step);
  scarp::HeightField field;
  field.samples = samples.data();
  field.cols = cols;
  field.rows = rows;
  if (goals & 32) field.nodata = 0.0F;
  field.frame = scarp::grid_frame(rows);

  std::vector<float> tolerance;
  if (goals & 128) {
    for (std::size_t i = 0; i < samples.size(); ++i) {
      const std::uint8_t byte = bytes.next();
      tolerance.push_back(byte == 255 ? std::numeric_limits<float>::infinity() : static_cast<float>(byte) * step / 8);
    }
    options.tolerances.values = tolerance;
  }

  check_made(field, options, scarp::simplify(field, options));
  if (goals & 64) {
    paper.goals = options.goals;
    paper.tolerances = options.tolerances;
    paper.domain = options.domain;
    paper.output = options.output;
    paper.run = options.run;
    check_made(field, options, scarp::simplify_by_paper(field, paper));
  }
  check_refiner(field, options.domain.outline_tolerance, steps);
  return 0;
}
