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

  HeightField view() const {
    HeightField field;
    field.samples = heights.data();
    field.cols = cols;
    field.rows = rows;
    field.frame = frame;
    return field;
  }
  float& height(int col, int row) { return heights[std::size_t(row) * std::size_t(cols) + std::size_t(col)]; }
  float& tolerance(int col, int row) { return tolerances[std::size_t(row) * std::size_t(cols) + std::size_t(col)]; }

  void scroll(int by_cols, int by_rows) {
    Model moved = *this;
    for (int row = 0; row < rows; ++row) {
      for (int col = 0; col < cols; ++col) {
        const int from_col = col + by_cols, from_row = row + by_rows;
        const bool stays = from_col >= 0 && from_col < cols && from_row >= 0 && from_row < rows;
        moved.height(col, row) = stays ? height(from_col, from_row) : kVoid;
        if (has_tolerances) moved.tolerance(col, row) = stays ? tolerance(from_col, from_row) : kNoBound;
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

Model any_model() {
  Model model;
  model.cols = *rc::gen::inRange(2, 40);
  model.rows = *rc::gen::inRange(2, 40);
  const auto relief = *rc::gen::elementOf(std::vector(std::begin(testing::kReliefs), std::end(testing::kReliefs)));
  model.heights = random_field(*rc::gen::arbitrary<std::uint32_t>(), model.cols, model.rows, relief,
                               *rc::gen::element(0.0, 0.0, 0.1, 0.5))
                      .samples;
  // Frames whose offsets float32 and doubles hold exactly, as a bound in exact arithmetic needs them.
  const double cell = *rc::gen::element(1.0, 0.125, 8.0);
  model.frame.affine = {*rc::gen::element(0.0, 1024.0), cell, 0, 0, 0, *rc::gen::element(-cell, cell)};
  model.options.max_error = *rc::gen::element(0.0, 0.5, 2.0, 20.0);
  model.options.effort = *rc::gen::element(Effort::kFast, Effort::kFast, Effort::kNormal, Effort::kHigh);
  model.options.cell = *rc::gen::element(8, 9, 16);
  model.options.place = {*rc::gen::inRange(-50, 50), *rc::gen::inRange(-50, 50)};
  model.has_tolerances = *rc::gen::inRange(0, 4) == 0;
  if (model.has_tolerances) model.tolerances = any_tolerances(model.heights.size(), model.options.max_error);
  return model;
}

/// One change of the live field and of the model alike.
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
  RC_ASSERT(live.update(window, patch.samples, tolerances).has_value());
  for (int row = 0; row < window.rows; ++row) {
    for (int col = 0; col < window.cols; ++col) {
      const std::size_t k = std::size_t(row) * std::size_t(window.cols) + std::size_t(col);
      model.height(window.col + col, window.row + row) = patch.samples[k];
      if (!tolerances.empty()) model.tolerance(window.col + col, window.row + row) = tolerances[k];
    }
  }
}

bool is_same(const Mesh& a, const Mesh& b) {
  return a.origin == b.origin && a.positions == b.positions && a.triangles == b.triangles;
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
    return one.first == other.first && p.place == q.place && p.positions == q.positions && p.triangles == q.triangles &&
           p.max_error == q.max_error;
  });
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
    RC_ASSERT(measured->max_error <= model.options.max_error);
    RC_ASSERT(measured->over_tolerance == 0u);
    RC_ASSERT(measured->max_error == live->max_error());
  }
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
