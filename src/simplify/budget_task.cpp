#include "simplify/budget_task.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <utility>
#include <vector>

#include "grid/bands.h"
#include "grid/source_failure.h"
#include "metric/criterion.h"
#include "pieces/checks.h"
#include "simplify/run.h"

namespace scarp::run {

namespace {

constexpr double kInfinity = std::numeric_limits<double>::infinity();

/// Throws SourceFailure.
HeightRange read_range(const HeightField& field) {
  HeightRange range;
  auto swept = grid::sweep_rows(field, 0, [&](const grid::RowRange& rows) -> Result<void> {
    HeightField part = field;
    part.samples = rows.samples.samples;
    part.rows = rows.samples.rows;
    range.add(height_range(part));
    return {};
  });
  if (!swept) throw grid::SourceFailure{swept.error()};
  return range;
}

/// An error that no mesh with these lines exceeds: twice the range of the samples and of the heights of breaklines.
double largest_error(const HeightField& field, const SimplifyOptions& options) {
  const HeightRange samples = field.samples != nullptr ? height_range(field) : read_range(field);
  double low = samples.min, high = samples.max;
  const LineConstraints lines = options.features.fixed_lines();
  for (const Line& line : lines.lines) {
    for (const auto& point : line.points) {
      if (std::isnan(point[2])) continue;
      low = std::min(low, point[2]);
      high = std::max(high, point[2]);
    }
  }
  return 2 * (high - low);
}

/// Range of the tolerances or weights of all samples, including nodata.
struct ToleranceRange {
  double least = kInfinity;  ///< least of those above 0
  double largest = 0;        ///< largest of those that are finite
  bool has_zeros = false;

  void add(float tolerance) {
    has_zeros = has_zeros || tolerance == 0;
    if (tolerance > 0) least = std::min(least, double{tolerance});
    if (!std::isinf(tolerance)) largest = std::max(largest, double{tolerance});
  }
};

/// Range of values in memory, or in a source (null: none). Throws SourceFailure.
ToleranceRange range_of(std::span<const float> values, const SampleSource* source, const HeightField& field) {
  ToleranceRange range;
  for (const float value : values) range.add(value);
  if (source == nullptr) return range;
  const int rows = std::clamp((1 << 18) / field.cols, 1, field.rows);
  std::vector<float> held(static_cast<std::size_t>(rows) * static_cast<std::size_t>(field.cols));
  for (int row = 0; row < field.rows; row += rows) {
    const int count = std::min(rows, field.rows - row);
    const auto read = source->read(0, row, field.cols, count, held.data(), field.cols);
    if (!read) throw grid::SourceFailure{read.error()};
    const auto all =
        std::span<const float>(held).first(static_cast<std::size_t>(count) * static_cast<std::size_t>(field.cols));
    for (const float value : all) range.add(value);
  }
  return range;
}

/// A max error, or a factor of all tolerances, at which no sample needs a vertex for its bound, except samples with
/// bound 0.
double largest_number(const pieces::Recipe& recipe, const ToleranceRange& tolerances) {
  const HeightField& field = recipe.field;
  const SimplifyOptions& options = recipe.options;
  const double error = largest_error(field, options);
  if (metric::has_tolerances(options)) {
    const double max_error = options.goals.max_error.value_or(kInfinity);
    return error / (max_error > 0 ? std::min(max_error, tolerances.least) : tolerances.least);
  }
  const Tolerances& asked = options.tolerances;
  if (asked.weights.empty() && asked.weights_source == nullptr) return error;
  return error * range_of(asked.weights, asked.weights_source, field).largest;
}

/// The subject of a refusal: the mesh for which every budget must have room.
std::string name_least(const pieces::Recipe& recipe, bool has_zeros) {
  const char* zeros = has_zeros ? " and the samples with a tolerance of 0" : "";
  if (recipe.has_lines) return std::string("the lines and the outline of the valid data") + zeros + " alone need";
  if (recipe.options.quality.shape.any()) return std::string("the angles and edges") + zeros + " alone need";
  return std::string("the outline of the valid data and its strips") + zeros + " alone need";
}

}  // namespace

BudgetTask make_budget_task(const pieces::Recipe& recipe) {
  const Tolerances& asked = recipe.options.tolerances;
  const ToleranceRange tolerances = range_of(asked.values, asked.source, recipe.field);
  const double reach = recipe.has_lines ? tolerances.largest : 0;
  BudgetTask task;
  task.run = [&recipe, reach](const SimplifyOptions& options, const pieces::Scale& scale) -> Result<Simplified> {
    SCARP_RETURN_IF_ERROR(pieces::check_values(recipe.field, options));
    pieces::Scale with_lines = scale;
    with_lines.line_error = scale.factor * reach;
    const metric::Request request(options);
    return run(pieces::Recipe(recipe.field, request, with_lines));
  };
  task.traits = recipe.traits;
  task.insertion_stops = recipe.insertion_stops;
  task.raises_bound = recipe.insertion_stops && !recipe.has_own_bounds && !pieces::has_norm(recipe.field) &&
                      !recipe.options.domain.border.is_locked;
  task.samples = static_cast<std::uint64_t>(recipe.field.cols) * static_cast<unsigned>(recipe.field.rows);
  task.most = [&recipe, tolerances] { return largest_number(recipe, tolerances); };
  task.least = name_least(recipe, tolerances.has_zeros);
  return task;
}

}  // namespace scarp::run
