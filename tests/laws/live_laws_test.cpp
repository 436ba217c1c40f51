// Laws of fields that change: after any changes the mesh is that of the final samples, sound and within the bound.
#include <gtest/gtest.h>
#include <rapidcheck/gtest.h>

#include <cmath>
#include <cstdint>
#include <limits>
#include <map>
#include <vector>

#include "laws/fields.h"
#include "laws/sanitized.h"
#include "scarp/live.h"
#include "scarp/measure.h"
#include "scarp/simplify.h"

namespace scarp::live_laws_test {
namespace {

using testing::Field;
using testing::random_field;

constexpr float kVoid = std::numeric_limits<float>::quiet_NaN(), kNoBound = std::numeric_limits<float>::infinity();

/// The samples that a live field should have, kept by place.
struct Model {
  LiveOptions options;
  int cols = 0, rows = 0;
  Frame frame;
  bool has_tolerances = false;
  std::vector<float> heights, tolerances;
  std::vector<std::vector<float>> channels;
  std::vector<double> scales;

  HeightField view() const {
    HeightField field;
    field.samples = heights.data();
    field.cols = cols;
    field.rows = rows;
    field.frame = frame;
    for (std::size_t k = 0; k < channels.size(); ++k) field.channels.push_back({channels[k].data(), scales[k]});
    return field;
  }
  std::size_t index(int col, int row) const {
    return static_cast<std::size_t>(row) * static_cast<std::size_t>(cols) + static_cast<std::size_t>(col);
  }
  float& height(int col, int row) { return heights[index(col, row)]; }
  float& tolerance(int col, int row) { return tolerances[index(col, row)]; }

  void scroll(int by_cols, int by_rows) {
    Model moved = *this;
    for (int row = 0; row < rows; ++row) {
      for (int col = 0; col < cols; ++col) {
        const int from_col = col + by_cols, from_row = row + by_rows;
        const bool stays = from_col >= 0 && from_col < cols && from_row >= 0 && from_row < rows;
        moved.height(col, row) = stays ? height(from_col, from_row) : kVoid;
        if (has_tolerances) moved.tolerance(col, row) = stays ? tolerance(from_col, from_row) : kNoBound;
        for (std::size_t k = 0; k < channels.size(); ++k)
          moved.channels[k][index(col, row)] = stays ? channels[k][index(from_col, from_row)] : 0;
      }
    }
    moved.options.place = {options.place.col + by_cols, options.place.row + by_rows};
    const auto [x, y] = frame.apply_affine(by_cols, by_rows);
    moved.frame.affine[0] = x;
    moved.frame.affine[3] = y;
    *this = moved;
  }
};

std::vector<float> any_tolerances(std::size_t count, double bound) {
  std::vector<float> tolerances(count);
  for (float& t : tolerances) t = *rc::gen::element(kNoBound, static_cast<float>(bound), static_cast<float>(bound / 4));
  return tolerances;
}

std::vector<float> any_channel(int cols, int rows) {
  const auto relief = *rc::gen::element(testing::Relief::kTies, testing::Relief::kFlat, testing::Relief::kRidges);
  return random_field(*rc::gen::arbitrary<std::uint32_t>(), cols, rows, relief).samples;
}

Model any_model() {
  Model model;
  model.cols = *rc::gen::inRange(2, 40);
  model.rows = *rc::gen::inRange(2, 40);
  const auto relief = *rc::gen::elementOf(std::vector(std::begin(testing::kReliefs), std::end(testing::kReliefs)));
  model.heights = random_field(*rc::gen::arbitrary<std::uint32_t>(), model.cols, model.rows, relief,
                               *rc::gen::element(0.0, 0.0, 0.1, 0.5))
                      .samples;
  // Frames with offsets that are exact in float32 and double, as a bound in exact arithmetic needs.
  const double cell = *rc::gen::element(1.0, 0.125, 8.0);
  model.frame.affine = {*rc::gen::element(0.0, 1024.0), cell, 0, 0, 0, *rc::gen::element(-cell, cell)};
  model.options.max_error = *rc::gen::element(0.0, 0.5, 2.0, 20.0);
  model.options.effort = *rc::gen::element(Effort::kFast, Effort::kFast, Effort::kNormal, Effort::kHigh);
  model.options.cell = *rc::gen::element(8, 9, 16);
  model.options.place = {*rc::gen::inRange(-50, 50), *rc::gen::inRange(-50, 50)};
  model.has_tolerances = *rc::gen::inRange(0, 4) == 0;
  if (model.has_tolerances) model.tolerances = any_tolerances(model.heights.size(), model.options.max_error);
  for (int k = *rc::gen::element(0, 0, 1, 2); k > 0; --k) {
    model.channels.push_back(any_channel(model.cols, model.rows));
    model.scales.push_back(*rc::gen::element(1.0, 0.25, 2.0));
  }
  model.options.norm = *rc::gen::element(Norm::kSum, Norm::kSquares, Norm::kMax);
  return model;
}

/// Makes the same change to the live field and the model.
void change(LiveField& live, Model& model) {
  const int kind = *rc::gen::inRange(0, 8);
  if (kind == 0 || kind == 7) {
    const int far = kind == 0 ? model.cols + 2 : 4;
    const int cols = *rc::gen::inRange(-far, far + 1), rows = *rc::gen::inRange(-4, 5);
    RC_ASSERT(live.scroll(cols, rows).has_value());
    return model.scroll(cols, rows);
  }
  if (kind == 1) {
    const int col = *rc::gen::inRange(0, model.cols), row = *rc::gen::inRange(0, model.rows);
    model.height(col, row) = *rc::gen::element(kVoid, 0.0f, 3.0f, 500.0f, kNoBound);
    RC_ASSERT(live.set(col, row, model.height(col, row)).has_value());
    return;
  }
  LiveWindow window;
  window.col = *rc::gen::inRange(0, model.cols);
  window.row = *rc::gen::inRange(0, model.rows);
  window.cols = *rc::gen::inRange(1, model.cols - window.col + 1);
  window.rows = *rc::gen::inRange(1, model.rows - window.row + 1);
  const auto relief = *rc::gen::elementOf(std::vector(std::begin(testing::kReliefs), std::end(testing::kReliefs)));
  Field patch = random_field(*rc::gen::arbitrary<std::uint32_t>(), window.cols, window.rows, relief,
                             *rc::gen::element(0.0, 0.0, 0.3));
  if (kind == 2) patch.samples.assign(patch.samples.size(), kVoid);
  for (std::size_t k = 0; kind == 3 && k < patch.samples.size(); ++k) {  // a ramp
    const auto col = static_cast<float>(k % std::size_t(window.cols)),
               row = static_cast<float>(k / std::size_t(window.cols));
    patch.samples[k] = 3 * col + row / 4;
  }
  std::vector<float> tolerances;
  if (model.has_tolerances && *rc::gen::arbitrary<bool>())
    tolerances = any_tolerances(patch.samples.size(), model.options.max_error);
  std::vector<std::vector<float>> channels;
  if (*rc::gen::arbitrary<bool>()) channels.resize(model.channels.size());
  for (std::vector<float>& channel : channels) channel = any_channel(window.cols, window.rows);
  const std::vector<std::span<const float>> values(channels.begin(), channels.end());
  RC_ASSERT(live.update(window, patch.samples, tolerances, values).has_value());
  for (int row = 0; row < window.rows; ++row) {
    for (int col = 0; col < window.cols; ++col) {
      const std::size_t k = std::size_t(row) * std::size_t(window.cols) + std::size_t(col);
      model.height(window.col + col, window.row + row) = patch.samples[k];
      if (!tolerances.empty()) model.tolerance(window.col + col, window.row + row) = tolerances[k];
      for (std::size_t c = 0; c < channels.size(); ++c)
        model.channels[c][model.index(window.col + col, window.row + row)] = channels[c][k];
    }
  }
}

bool is_same(const Mesh& a, const Mesh& b) {
  return a.origin == b.origin && a.positions == b.positions && a.triangles == b.triangles && a.channels == b.channels;
}

/// Cells with a surface, by slot.
using Cells = std::map<std::uint32_t, std::shared_ptr<const LiveCell>>;

void take(const LiveChanges& changes, Cells& cells) {
  for (const auto& cell : changes.cells) {
    if (cell->triangles.empty())
      cells.erase(cell->slot);
    else
      cells[cell->slot] = cell;
  }
}

bool are_same(const Cells& a, const Cells& b) {
  return std::equal(a.begin(), a.end(), b.begin(), b.end(), [](const auto& one, const auto& other) {
    const LiveCell &p = *one.second, &q = *other.second;
    return one.first == other.first && p.place == q.place && p.positions == q.positions && p.channels == q.channels &&
           p.triangles == q.triangles && p.max_error == q.max_error;
  });
}

/// The norm of the errors at each sample, from each channel as if it were the heights; NaN at voids.
std::vector<double> norms_of(const Model& model, const Mesh& mesh) {
  std::vector<double> norms(model.heights.size(), 0);
  for (std::size_t k = 0; k <= model.channels.size(); ++k) {
    Mesh raised = mesh;
    HeightField field = model.view();
    std::vector<float> values = model.heights;
    for (std::size_t i = 0; k > 0 && i < values.size(); ++i)
      values[i] = std::isfinite(values[i]) ? model.channels[k - 1][i] : kVoid;
    for (std::size_t v = 0; k > 0 && v < mesh.vertex_count(); ++v)
      raised.positions[3 * v + 2] = mesh.channels[model.channels.size() * v + k - 1];
    field.samples = values.data();
    const double scale = k == 0 ? 1 : model.scales[k - 1];
    MeasureOptions judge;
    judge.topology = false;
    judge.on_row = [&](int row, std::span<const float> errors) {
      for (std::size_t x = 0; x < errors.size(); ++x) {
        double& norm = norms[static_cast<std::size_t>(row) * errors.size() + x];
        const double error = scale * std::abs(double{errors[x]});
        if (model.options.norm == Norm::kSum)
          norm += error;
        else if (model.options.norm == Norm::kSquares)
          norm = std::hypot(norm, error);
        else
          norm = std::isnan(error) ? error : std::max(norm, error);
      }
    };
    RC_ASSERT(measure(field, raised, judge).has_value());
  }
  return norms;
}

RC_GTEST_PROP(live_field, equals_a_new_field_of_the_final_samples, ()) {
  Model model = any_model();
  auto live = LiveField::create(model.view(), model.options, model.tolerances);
  RC_ASSERT(live.has_value());
  Cells followed;
  std::uint64_t version = 0;
  const int count = *rc::gen::inRange(1, 8);
  for (int k = 0; k < count; ++k) {
    change(*live, model);
    const LiveChanges changes = live->changes(version);
    version = changes.version;
    take(changes, followed);
  }
  model.options.threads = 2;
  const auto made = LiveField::create(model.view(), model.options, model.tolerances);
  RC_ASSERT(made.has_value());
  RC_ASSERT(is_same(live->mesh(), made->mesh()));
  RC_ASSERT(live->max_error() == made->max_error());
  RC_ASSERT(live->triangle_count() == live->mesh().triangle_count());
  Cells whole, anew;
  take(live->changes(), whole);
  take(made->changes(), anew);
  RC_ASSERT(are_same(followed, whole));
  RC_ASSERT(are_same(whole, anew));
  const std::vector<float> heights = live->heights();
  for (std::size_t k = 0; k < heights.size(); ++k)
    RC_ASSERT(heights[k] == model.heights[k] || !std::isfinite(model.heights[k]));
}

RC_GTEST_PROP(live_field, keeps_the_bound_without_a_crack_after_each_change, ()) {
  Model model = any_model();
  auto live = LiveField::create(model.view(), model.options, model.tolerances);
  RC_ASSERT(live.has_value());
  const int count = *rc::gen::inRange(1, 5);
  for (int k = 0; k < count; ++k) {
    change(*live, model);
    const Mesh mesh = live->mesh();
    MeasureOptions judge;
    judge.tolerance = model.tolerances;
    const HeightField field = model.view();
    if (mesh.triangles.empty()) {
      RC_ASSERT(!simplify(field, {.max_error = 1}).has_value());
      continue;
    }
    const auto measured = measure(field, mesh, judge);
    RC_ASSERT(measured.has_value());
    RC_ASSERT(measured->is_sound());
    if (!model.channels.empty()) {
      double largest = 0;
      const std::vector<double> norms = norms_of(model, mesh);
      for (std::size_t i = 0; i < norms.size(); ++i) {
        if (std::isnan(norms[i])) continue;
        largest = std::max(largest, norms[i]);
        if (model.has_tolerances) RC_ASSERT(norms[i] <= model.tolerances[i] * (1 + 1e-6));
      }
      RC_ASSERT(largest <= model.options.max_error * (1 + 1e-6));
      RC_ASSERT(std::abs(largest - live->max_error()) <= 1e-6 * largest);
      continue;
    }
    RC_ASSERT(measured->max_error <= model.options.max_error);
    RC_ASSERT(measured->over_tolerance == 0u);
    RC_ASSERT(measured->max_error == live->max_error());
  }
}

RC_GTEST_PROP(live_field, keeps_a_budget_and_the_bounds_that_it_needs, ()) {
  Model model = any_model();
  model.has_tolerances = false;
  model.tolerances.clear();
  for (float& z : model.heights) z = std::isfinite(z) ? z : 7;
  model.channels.clear();
  model.options.max_triangles = *rc::gen::element(300u, 600u, 1500u);
  auto live = LiveField::create(model.view(), model.options);
  RC_ASSERT(live.has_value());
  const int count = *rc::gen::inRange(1, 6);
  for (int k = 0; k < count; ++k) {
    if (*rc::gen::inRange(0, 4) == 0) {
      const int cols = *rc::gen::inRange(-5, 6), rows = *rc::gen::inRange(-5, 6);
      RC_ASSERT(live->scroll(cols, rows).has_value());
      model.scroll(cols, rows);
    } else {
      Field anew = random_field(*rc::gen::arbitrary<std::uint32_t>(), model.cols, model.rows,
                                *rc::gen::element(testing::Relief::kRidges, testing::Relief::kReal));
      if (*rc::gen::inRange(0, 4) == 0) anew.samples[*rc::gen::inRange<std::size_t>(0, anew.samples.size())] *= 0x1p40f;
      const int rows = *rc::gen::inRange(1, model.rows + 1);
      const auto samples = static_cast<std::size_t>(model.cols) * static_cast<std::size_t>(rows);
      std::copy_n(anew.samples.begin(), samples, model.heights.begin());
      RC_ASSERT(live->update({0, 0, model.cols, rows}, std::span(anew.samples).first(samples)).has_value());
    }
    RC_ASSERT(live->triangle_count() <= *model.options.max_triangles);
    const Mesh mesh = live->mesh();
    RC_ASSERT(mesh.triangle_count() == live->triangle_count());
    if (mesh.triangles.empty()) continue;  // scrolled away
    const auto measured = measure(model.view(), mesh);
    RC_ASSERT(measured.has_value());
    RC_ASSERT(measured->is_sound());
    RC_ASSERT(measured->max_error == live->max_error());
    for (const auto& cell : live->changes().cells) RC_ASSERT(cell->max_error <= measured->max_error);
  }
  model.options.threads = 2;
  model.options.level = live->level();
  const auto made = LiveField::create(model.view(), model.options);
  RC_ASSERT(made.has_value());
  RC_ASSERT(is_same(live->mesh(), made->mesh()));
}

TEST(live_field, uses_a_budget_and_changes_few_cells_for_it) {
  const int side = testing::fewer(400), window = 40, updates = testing::fewer(40, 4);
  const auto budget = static_cast<std::uint64_t>(testing::fewer(4000, 4));
  const Field field = random_field(3, side, side, testing::Relief::kRidges);
  LiveOptions options;
  options.max_triangles = budget;
  auto live = LiveField::create(field.view(), options);
  ASSERT_TRUE(live.has_value());
  std::uint64_t changed = 0, version = live->changes().version;
  for (int k = 0; k < updates; ++k) {
    std::vector<float> heights(static_cast<std::size_t>(window * window));
    for (int at = 0; at < window * window; ++at)
      heights[static_cast<std::size_t>(at)] = static_cast<float>(10 * k * std::sin(0.2 * (at % window) + at / window));
    ASSERT_TRUE(live->update({9 * k, 5 * k, window, window}, heights).has_value());
    EXPECT_LE(live->triangle_count(), budget);
    EXPECT_GE(live->triangle_count(), budget - budget / 20);
    const LiveChanges changes = live->changes(version);
    version = changes.version;
    changed += changes.triangle_count();
  }
  EXPECT_LE(changed, static_cast<std::uint64_t>(updates) * budget / 3);
}

TEST(live_field, refuses_heights_without_a_channel_and_stays_as_it_was) {
  const Field field = random_field(1, 40, 40, testing::Relief::kRidges);
  std::vector<float> colour = random_field(2, 40, 40, testing::Relief::kRidges).samples;
  HeightField view = field.view();
  view.channels.push_back({colour.data(), 1});
  auto live = LiveField::create(view, {.max_error = 1});
  ASSERT_TRUE(live.has_value());
  const Mesh before = live->mesh();
  EXPECT_EQ(before.channel_count, 1);
  colour = {1, 2, kVoid, 4};
  const std::span<const float> values(colour);
  const std::vector<float> heights(4, 3.0f);
  const auto updated = live->update({6, 7, 2, 2}, heights, {}, std::span(&values, 1));
  ASSERT_FALSE(updated.has_value());
  EXPECT_EQ(
      updated.error().message,
      "channel 1 at column 6, row 8 has no value, though the height has one: give it a value, or make the height a "
      "void");
  EXPECT_TRUE(is_same(live->mesh(), before));
  const auto none = live->update({6, 7, 2, 2}, heights, {}, std::vector<std::span<const float>>(2, values));
  EXPECT_EQ(none.error().message, "the live field has 1 channels: give a window values of all, or of none, not of 2");
}

TEST(live_field, refuses_a_budget_that_no_bound_keeps) {
  const Field field = random_field(3, 40, 40, testing::Relief::kReal);
  LiveOptions options;
  options.cell = 8;
  options.max_triangles = 20;
  const auto live = LiveField::create(field.view(), options);
  ASSERT_FALSE(live.has_value());
  EXPECT_EQ(live.error().message, "the live field needs 50 triangles with any bound, more than its budget of 20");
}

TEST(live_field, changes_only_the_cells_that_a_window_touches) {
  const Field flat = random_field(1, 100, 100, testing::Relief::kRidges);
  auto live = LiveField::create(flat.view(), {.max_error = 1, .cell = 20});
  ASSERT_TRUE(live.has_value());
  const std::uint64_t version = live->changes().version;
  ASSERT_TRUE(live->update({5, 5, 10, 10}, std::vector<float>(100, 7.0f)).has_value());
  EXPECT_EQ(live->changes(version).cells.size(), 1u);
  ASSERT_TRUE(live->update({15, 25, 10, 10}, std::vector<float>(100, 7.0f)).has_value());
  EXPECT_EQ(live->changes(version).cells.size(), 3u);
  ASSERT_TRUE(live->update({15, 25, 10, 10}, std::vector<float>(100, 7.0f)).has_value());
  EXPECT_EQ(live->changes().version, version + 2) << "equal samples change nothing";
}

}  // namespace
}  // namespace scarp::live_laws_test
