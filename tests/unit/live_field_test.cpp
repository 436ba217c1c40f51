// Live fields: refusals, failures that change nothing, and slots.
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <cmath>
#include <limits>
#include <map>
#include <string>
#include <vector>

#include "laws/fields.h"
#include "scarp/live.h"

namespace scarp::live_field_test {
namespace {

using testing::Field;
using ::testing::HasSubstr;
using testing::random_field;
using testing::Relief;

const Field& hills() {
  static const Field field = random_field(3, 70, 50, Relief::kRidges, 0.1);
  return field;
}

LiveField make(const LiveOptions& options) {
  auto live = LiveField::create(hills().view(), options);
  EXPECT_TRUE(live.has_value());
  return std::move(*live);
}

bool is_same(const Mesh& a, const Mesh& b) { return a.positions == b.positions && a.triangles == b.triangles; }

TEST(live_field, refuses_what_it_cannot_follow) {
  const auto error_of = [](const HeightField& field, const LiveOptions& options, std::size_t tolerances = 0) {
    const auto made = LiveField::create(field, options, std::vector<float>(tolerances, -1.0f));
    EXPECT_FALSE(made.has_value());
    return made ? std::string() : made.error().message;
  };
  HeightField field = hills().view();
  EXPECT_THAT(error_of(field, {.max_error = -1}), HasSubstr("max error of at least 0, not -1"));
  EXPECT_THAT(error_of(field, {.max_error = 1, .effort = Effort::kMax}), HasSubstr("efforts fast, normal and high"));
  EXPECT_THAT(error_of(field, {.max_error = 1, .cell = 7}), HasSubstr("cells of 8 to 254 samples, not 7"));
  EXPECT_THAT(error_of(field, {.max_error = 1}, 5), HasSubstr("of 3500 samples cannot have 5 tolerances"));
  EXPECT_THAT(error_of(field, {.max_error = 1}, 3500), HasSubstr("tolerance 0 (counted from 0) is -1"));
  EXPECT_THAT(error_of(field, {.max_error = 1, .place = {2'000'000'000, 0}}), HasSubstr("within 2^30 samples"));
  EXPECT_THAT(error_of(field, {.max_error = 1, .max_triangles = 9}, 3500), HasSubstr("a budget or tolerances"));
  EXPECT_THAT(error_of(field, {.max_error = 1, .max_triangles = 0}), HasSubstr("a budget of at least 1"));
  EXPECT_THAT(error_of(field, {.max_error = 1, .max_triangles = 900, .level = 1'000'000'000}), HasSubstr("no level"));
  EXPECT_THAT(error_of(field, {.max_error = 1, .level = 0}), HasSubstr("only with a budget"));
  field.sample_rounding = 2;
  EXPECT_THAT(error_of(field, {.max_error = 1}), HasSubstr("max error of at least 2, the rounding"));
  field.sample_rounding = 0;
  field.height_scale = 0;
  EXPECT_THAT(error_of(field, {.max_error = 1}), HasSubstr("a weight above 0"));
  field.channels.push_back({hills().samples.data(), -1});
  EXPECT_THAT(error_of(field, {.max_error = 1}), HasSubstr("not -1 for channel 1"));
  field.channels.front() = {nullptr};
  EXPECT_THAT(error_of(field, {.max_error = 1}), HasSubstr("lacks the values of channel 1"));
}

TEST(live_field, names_a_wrong_window_and_stays_as_it_was) {
  LiveField live = make({.max_error = 2});
  const Mesh before = live.mesh();
  const auto error_of = [&](const LiveWindow& window, std::size_t heights, std::size_t tolerances = 0) {
    const auto done = live.update(window, std::vector<float>(heights, 9.0f), std::vector<float>(tolerances, 1.0f));
    EXPECT_FALSE(done.has_value());
    return done ? std::string() : done.error().message;
  };
  EXPECT_THAT(error_of({60, 0, 11, 1}, 11), HasSubstr("11 columns and 1 rows at column 60, row 0 is not within"));
  EXPECT_THAT(error_of({-1, 0, 2, 1}, 2), HasSubstr("is not within the live field of 70 columns and 50 rows"));
  EXPECT_THAT(error_of({0, 0, 0, 1}, 0), HasSubstr("is not within"));
  EXPECT_THAT(error_of({0, 0, std::numeric_limits<int>::max(), 1}, 1), HasSubstr("is not within"));
  EXPECT_THAT(error_of({0, 0, 2, 2}, 3), HasSubstr("needs 4 heights, not 3"));
  EXPECT_THAT(error_of({0, 0, 2, 2}, 4, 4), HasSubstr("made without tolerances"));
  EXPECT_FALSE(live.scroll(std::numeric_limits<int>::max(), 0).has_value());
  EXPECT_TRUE(is_same(live.mesh(), before));
}

TEST(live_field, puts_samples_back_that_no_mesh_can_follow) {
  LiveField live = make({.max_error = 1e-3});
  const Mesh before = live.mesh();
  const auto heights = live.heights();
  std::vector<float> patch(400);
  for (std::size_t k = 0; k < patch.size(); ++k) patch[k] = k % 2 == 0 ? 3e38f : -1e-38f;
  const auto done = live.update({30, 20, 20, 20}, patch);
  ASSERT_FALSE(done.has_value());
  EXPECT_TRUE(is_same(live.mesh(), before));
  const std::vector<float> after = live.heights();
  for (std::size_t k = 0; k < after.size(); ++k) EXPECT_TRUE(after[k] == heights[k] || std::isnan(heights[k])) << k;
  ASSERT_TRUE(live.set(30, 20, 5).has_value()) << "the field goes on";
}

TEST(live_field, keeps_slots_while_it_moves) {
  LiveField live = make({.max_error = 2, .cell = 16});
  const auto slots = [&] {
    std::map<std::pair<int, int>, std::uint32_t> found;
    for (const auto& cell : live.changes().cells) {
      EXPECT_LT(cell->slot, live.slot_count());
      if (!cell->triangles.empty()) found[{cell->place.col, cell->place.row}] = cell->slot;
    }
    return found;
  };
  auto before = slots();
  for (const int step : {1, 16, 5, -30}) {
    ASSERT_TRUE(live.scroll(step, step / 2).has_value());
    const auto after = slots();
    for (const auto& [place, slot] : after) {
      if (before.contains(place)) {
        EXPECT_EQ(before[place], slot);
      }
    }
    before = after;
  }
}

}  // namespace
}  // namespace scarp::live_field_test
