// Laws of lakes: each sample is the result of all lakes in order; flat areas equal those of a flood fill; streamed
// samples equal samples in memory.
#include <gtest/gtest.h>
#include <rapidcheck/gtest.h>

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <limits>
#include <memory>
#include <random>
#include <string>
#include <utility>
#include <vector>

#include "grid/line_marks.h"
#include "grid/outline.h"
#include "grid/window.h"
#include "laws/any_field.h"
#include "laws/array_source.h"
#include "scarp/features.h"
#include "scarp/measure.h"
#include "scarp/simplify.h"

namespace scarp {
namespace {
namespace water_laws {

using testing::any_field;
using testing::ArraySource;
using testing::Field;

OwnedHeightField in_memory(const Field& field) {
  OwnedHeightField owned;
  owned.samples = field.samples;
  owned.cols = field.cols;
  owned.rows = field.rows;
  owned.frame = grid_frame(field.rows);
  return owned;
}

/// The same field, read in windows.
OwnedHeightField in_source(const Field& field) {
  OwnedHeightField owned = in_memory(field);
  owned.samples.clear();
  owned.source = std::make_shared<ArraySource>(field.view());
  return owned;
}

bool is_same(float a, float b) { return a == b || (std::isnan(a) && std::isnan(b)); }

bool are_same(const std::vector<float>& a, const std::vector<float>& b) {
  return std::equal(a.begin(), a.end(), b.begin(), b.end(), is_same);
}

std::vector<float> samples_of(const OwnedHeightField& field) {
  std::vector<float> samples(static_cast<std::size_t>(field.cols) * static_cast<std::size_t>(field.rows));
  RC_ASSERT(grid::read_window(field, 0, 0, field.cols, field.rows, samples.data(), field.cols).has_value());
  return samples;
}

bool are_same(const Line& a, const Line& b) {
  return a.points == b.points && a.role == b.role && a.polygon == b.polygon && a.name == b.name;
}

bool are_same(const std::vector<Lake>& a, const std::vector<Lake>& b) {
  return std::equal(a.begin(), a.end(), b.begin(), b.end(), [](const Lake& x, const Lake& y) {
    return x.name == y.name && x.level == y.level && x.samples == y.samples && x.raised == y.raised &&
           x.largest_change == y.largest_change &&
           std::equal(x.shore.begin(), x.shore.end(), y.shore.begin(), y.shore.end(),
                      [](const Line& p, const Line& q) { return are_same(p, q); });
  });
}

/// Arbitrary polygons, with and without holes, overlapping, across the border and outside the raster.
std::vector<Line> any_lakes(const Field& field) {
  std::mt19937 random(*rc::gen::arbitrary<std::uint32_t>());
  const auto between = [&](double low, double high) {
    return low + (high - low) * (static_cast<double>(random()) / 4294967296.0);
  };
  const bool is_on_samples = *rc::gen::arbitrary<bool>();
  std::vector<Line> lakes;
  const auto count = *rc::gen::inRange<std::uint32_t>(0, 6);
  for (std::uint32_t k = 0; k < count; ++k) {
    const double reach = random() % 4 == 0 ? 1.5 : 0.6;
    const double left = between(-0.3, 0.9) * field.cols, top = between(-0.3, 0.9) * field.rows;
    for (auto rings = 1 + random() % 2; rings > 0; --rings) {
      Line ring;
      ring.name = "lake " + std::to_string(k);
      ring.role = lakes.empty() || lakes.back().polygon != k ? LineRole::kOuter : LineRole::kHole;
      ring.polygon = k;
      for (auto n = 3 + random() % 5; n > 0; --n) {
        double x = left + between(0, reach) * field.cols, y = top + between(0, reach) * field.rows;
        if (is_on_samples) x = std::round(x), y = std::round(y);
        ring.points.push_back({x, y, std::numeric_limits<double>::quiet_NaN()});
      }
      ring.points.push_back(ring.points.front());
      lakes.push_back(ring);
    }
  }
  return lakes;
}

struct Flattened {
  OwnedHeightField field;
  std::vector<Lake> lakes;
};

Flattened flatten(OwnedHeightField field, const std::vector<Line>& lines) {
  WaterOptions options;
  options.affine = field.frame.affine;
  options.percentile = 20;
  options.freeboard = 0.75;
  auto lakes = flatten_lakes(field, lines, options);
  RC_ASSERT(lakes.has_value());
  return {std::move(field), std::move(*lakes)};
}

/// Processes lake by lake, sample by sample: counts and samples.
class SlowWater {
 public:
  explicit SlowWater(const Field& field) : field_(field), is_water_(field.samples.size(), false) {}

  void add(Lake& lake) {
    grid::LineRuns runs(grid_frame(field_.rows).affine, field_.cols, field_.rows);
    runs.add_polygons(lake.shore);
    for (const Line& ring : lake.shore) runs.add_course(ring, 1.0 / 128);
    const grid::SampleSet marks(runs.runs(), field_.rows);
    lake.samples = lake.raised = 0;
    lake.largest_change = 0;
    for (const grid::SampleRun& run : runs.runs()) {
      for (std::int32_t x = run.begin; x < run.end; ++x) {
        is_water_[index(x, run.row)] = true;
        lake.samples += put(index(x, run.row), static_cast<float>(lake.level), lake);
      }
    }
    const auto rim = static_cast<float>(lake.level + 0.75);
    for (std::int32_t y = 0; y < field_.rows; ++y) {
      for (std::int32_t x = 0; x < field_.cols; ++x) {
        const std::size_t i = index(x, y);
        if (!is_water_[i] && field_.samples[i] < rim && is_beside(marks, x, y)) lake.raised += put(i, rim, lake);
      }
    }
  }
  const std::vector<float>& samples() const { return field_.samples; }

 private:
  std::size_t index(std::int32_t x, std::int32_t y) const { return static_cast<std::size_t>(y * field_.cols + x); }
  bool is_beside(const grid::SampleSet& marks, std::int32_t col, std::int32_t row) const {
    for (std::int32_t y = std::max(row - 1, 0); y <= std::min(row + 1, field_.rows - 1); ++y) {
      for (std::int32_t x = std::max(col - 1, 0); x <= std::min(col + 1, field_.cols - 1); ++x) {
        if (marks.has({x, y})) return true;
      }
    }
    return false;
  }
  std::uint64_t put(std::size_t i, float height, Lake& lake) {
    float& sample = field_.samples[i];
    if (std::isnan(sample) || sample == height) return 0;
    lake.largest_change = std::max(lake.largest_change, std::abs(double{sample} - double{height}));
    sample = height;
    return 1;
  }

  Field field_;
  std::vector<bool> is_water_;
};

RC_GTEST_PROP(water, changes_samples_as_one_lake_after_the_other_does, ()) {
  const Field field = any_field(30);
  const Flattened made = flatten(in_memory(field), any_lakes(field));
  SlowWater slow(field);
  std::vector<Lake> lakes = made.lakes;
  for (Lake& lake : lakes) slow.add(lake);
  RC_ASSERT(are_same(made.field.samples, slow.samples()));
  RC_ASSERT(are_same(made.lakes, lakes));
}

RC_GTEST_PROP(water, in_a_source_is_that_in_memory, ()) {
  const Field field = any_field(40);
  const std::vector<Line> lines = any_lakes(field);
  const Flattened held = flatten(in_memory(field), lines), streamed = flatten(in_source(field), lines);
  RC_ASSERT(are_same(streamed.lakes, held.lakes));
  RC_ASSERT(are_same(samples_of(streamed.field), held.field.samples));
  // Any window.
  const auto col = *rc::gen::inRange(0, field.cols), row = *rc::gen::inRange(0, field.rows);
  const auto cols = *rc::gen::inRange(1, field.cols - col + 1), rows = *rc::gen::inRange(1, field.rows - row + 1);
  std::vector<float> window(static_cast<std::size_t>(cols * rows)), wanted(window);
  RC_ASSERT(streamed.field.source->read(col, row, cols, rows, window.data(), cols).has_value());
  RC_ASSERT(grid::read_window(held.field, col, row, cols, rows, wanted.data(), cols).has_value());
  RC_ASSERT(are_same(window, wanted));
}

RC_GTEST_PROP(water, that_rivers_meet_in_a_source_is_that_in_memory, ()) {
  const Field field = any_field(40);
  const std::vector<Line> lines = any_lakes(field);
  const Flattened held = flatten(in_memory(field), lines), streamed = flatten(in_source(field), lines);
  std::vector<Line> streams;
  for (Line line : any_lakes(field)) {
    line.role = LineRole::kLine;
    line.points.pop_back();
    streams.push_back(std::move(line));
  }
  const RiverOptions options{held.field.frame.affine, 0.5};
  const auto a = carve_rivers(held.field, streams, held.lakes, options),
             b = carve_rivers(streamed.field, streams, streamed.lakes, options);
  RC_ASSERT(a.has_value() && b.has_value());
  RC_ASSERT(a->size() == b->size());
  const auto same_height = [](double x, double y) { return x == y || (std::isnan(x) && std::isnan(y)); };
  for (std::size_t k = 0; k < a->size(); ++k) {
    const River &x = (*a)[k], &y = (*b)[k];
    RC_ASSERT(x.source == y.source && x.mouth == y.mouth && x.deepest_cut == y.deepest_cut);
    RC_ASSERT(x.course.points.size() == y.course.points.size());
    for (std::size_t i = 0; i < x.course.points.size(); ++i) {
      for (std::size_t axis = 0; axis < 3; ++axis)
        RC_ASSERT(same_height(x.course.points[i][axis], y.course.points[i][axis]));
    }
  }
}

/// The expected result of find_flats(), by flood fill, with each area's outline traced in a separate raster.
std::vector<Lake> flood_flats(const Field& field, std::uint64_t min_samples) {
  std::vector<bool> is_seen(field.samples.size(), false);
  const auto index = [&](Point p) { return static_cast<std::size_t>(p.y * field.cols + p.x); };
  std::vector<Lake> flats;
  for (std::int32_t i = 0; i < field.cols * field.rows; ++i) {
    const Point first{i % field.cols, i / field.cols};
    if (is_seen[index(first)] || std::isnan(field.samples[index(first)])) continue;
    std::vector<Point> members{first};
    std::vector<float> alone(field.samples.size(), std::numeric_limits<float>::quiet_NaN());
    is_seen[index(first)] = true;
    for (std::size_t k = 0; k < members.size(); ++k) {
      const Point p = members[k];
      alone[index(p)] = field.samples[index(p)];
      for (const Point q : {Point{p.x - 1, p.y}, Point{p.x + 1, p.y}, Point{p.x, p.y - 1}, Point{p.x, p.y + 1}}) {
        if (q.x < 0 || q.y < 0 || q.x >= field.cols || q.y >= field.rows || is_seen[index(q)]) continue;
        if (field.samples[index(q)] != field.samples[index(first)]) continue;
        is_seen[index(q)] = true;
        members.push_back(q);
      }
    }
    if (members.size() < min_samples) continue;
    Lake flat;
    flat.level = field.samples[index(first)];
    flat.name = "flat at column " + std::to_string(first.x) + ", row " + std::to_string(first.y);
    for (const auto& polygon : grid::trace_outline(grid::Raster{alone.data(), field.cols, field.rows})) {
      Line ring;
      ring.name = flat.name;
      ring.role = flat.shore.empty() ? LineRole::kOuter : LineRole::kHole;
      ring.polygon = static_cast<std::uint32_t>(flats.size());
      for (const Point p : polygon)
        ring.points.push_back({double{1} * p.x, double{1} * (field.rows - 1 - p.y), flat.level});
      ring.points.push_back(ring.points.front());
      flat.shore.push_back(std::move(ring));
    }
    if (!flat.shore.empty()) flats.push_back(std::move(flat));
  }
  return flats;
}

RC_GTEST_PROP(flats, are_those_that_a_flood_finds_in_memory_and_in_a_source, ()) {
  const auto cols = *rc::gen::inRange(2, 24), rows = *rc::gen::inRange(2, 24);
  const auto relief = *rc::gen::element(testing::Relief::kTies, testing::Relief::kFlat, testing::Relief::kCliff);
  Field field =
      testing::random_field(*rc::gen::arbitrary<std::uint32_t>(), cols, rows, relief, *rc::gen::element(0.0, 0.1, 0.5));
  // Only two heights: large areas that wind around each other.
  if (*rc::gen::arbitrary<bool>()) {
    for (float& z : field.samples) z = std::isnan(z) ? z : static_cast<float>(z > 1);
  }
  const auto min_samples = *rc::gen::element<std::uint64_t>(3, 4, 9, 40);
  const FlatOptions options{grid_frame(field.rows).affine, min_samples};
  const auto held = find_flats(in_memory(field), options), streamed = find_flats(in_source(field), options);
  RC_ASSERT(held.has_value() && streamed.has_value());
  RC_ASSERT(are_same(*held, flood_flats(field, min_samples)));
  RC_ASSERT(are_same(*streamed, *held));
}

/// Waves with a plateau across strips.
Field terrace() {
  Field field{500, 900, {}};
  for (std::int32_t y = 0; y < field.rows; ++y) {
    for (std::int32_t x = 0; x < field.cols; ++x) {
      const bool is_flat = std::hypot(x - 380, (y - 500) / 3.0) < 90;
      field.samples.push_back(is_flat ? 55.5F : static_cast<float>(50 * std::sin(0.05 * x) + 30 * std::cos(0.07 * y)));
    }
  }
  return field;
}

/// Number of triangles at height `level` with their centre in a box; rows count from above.
std::size_t count_level(const Mesh& mesh, const Field& field, std::array<double, 4> box, double level) {
  std::size_t count = 0;
  for (std::size_t t = 0; t < mesh.triangles.size(); t += 3) {
    double x = 0, y = 0;
    bool is_level = true;
    for (std::size_t k = 0; k < 3; ++k) {
      const auto v = mesh.vertex(mesh.triangles[t + k]);
      x += v[0] / 3;
      y += (field.rows - 1 - v[1]) / 3;
      is_level = is_level && v[2] == level;
    }
    if (!(x > box[0] && x < box[1] && y > box[2] && y < box[3])) continue;
    EXPECT_TRUE(is_level) << x << ", " << y;
    ++count;
  }
  return count;
}

TEST(water, is_level_in_a_mesh_whose_samples_stay_in_a_source) {
  const Field field = terrace();
  Line ring;
  ring.role = LineRole::kOuter;
  ring.polygon = 0;
  const double nan = std::numeric_limits<double>::quiet_NaN();
  ring.points = {{50.3, 80.2, nan}, {250.1, 60.9, nan}, {240.7, 830.3, nan}, {60.2, 850.8, nan}, {50.3, 80.2, nan}};
  const Flattened held = flatten(in_memory(field), {ring}), streamed = flatten(in_source(field), {ring});
  const auto flats = find_flats(streamed.field, {streamed.field.frame.affine, 20000});
  ASSERT_TRUE(flats);
  ASSERT_EQ(flats->size(), 2u) << "the lake, too";
  EXPECT_GT(streamed.lakes.front().bytes, 0u);
  EXPECT_LT(streamed.lakes.front().bytes, 200'000u) << "for its 140,000 samples";
  SimplifyOptions options;
  options.goals.max_error = 5;
  options.run.memory.limit = 4ull * 4 * 256 * static_cast<std::uint64_t>(field.cols);
  options.run.threads = 1;
  options.quality.vertices = Vertices::kSamples;
  options.output.float32_positions = false;
  options.features.breaklines.affine = held.field.frame.affine;
  options.features.breaklines.lines = {streamed.lakes.front().shore.front(), flats->back().shore.front()};
  for (const Effort effort : {Effort::kFast, Effort::kNormal, Effort::kHigh}) {
    options.quality.effort = effort;
    const auto made = simplify(streamed.field, options);
    ASSERT_TRUE(made) << made.error().message;
    EXPECT_GT(count_level(made->mesh, field, {62, 238, 90, 800}, streamed.lakes.front().level), 0u);
    EXPECT_GT(count_level(made->mesh, field, {330, 430, 350, 650}, 55.5), 0u);
    EXPECT_LE(measure(held.field, made->mesh)->max_error, 5 + 1e-9);
    EXPECT_GT(measure(field.view(), made->mesh)->max_error, 10) << "the raster as it was";
  }
}

TEST(water, and_flats_say_what_memory_they_need) {
  const Field field = terrace();
  OwnedHeightField streamed = in_source(field);
  FlatOptions flats{streamed.frame.affine, 20};
  flats.run.memory.taken = 1000;
  flats.run.memory.limit = 11'000;
  const auto none = find_flats(streamed, flats);
  ASSERT_FALSE(none);
  EXPECT_EQ(none.error().kind, ErrorKind::kMemory);
  EXPECT_TRUE(none.error().message.starts_with("the memory limit is too little: flat areas")) << none.error().message;
  flats.run.memory.limit = 1'000'000;
  EXPECT_TRUE(find_flats(streamed, flats));
  WaterOptions water;
  Line ring;
  ring.role = LineRole::kOuter;
  ring.polygon = 0;
  ring.points = {{10, 10, NAN}, {200, 10, NAN}, {100, 400, NAN}, {10, 10, NAN}};
  water.run.memory.limit = 50'000;
  const auto lakes = flatten_lakes(streamed, {&ring, 1}, water);
  ASSERT_FALSE(lakes);
  EXPECT_TRUE(lakes.error().message.starts_with("the memory limit is too little")) << lakes.error().message;
  water.run.memory.limit = 500'000;
  EXPECT_TRUE(flatten_lakes(streamed, {&ring, 1}, water));
}

TEST(water, and_flats_tell_what_the_source_says) {
  const Field field = terrace();
  OwnedHeightField broken = in_source(field);
  broken.source = std::make_shared<ArraySource>(field.view(), 700);
  Line ring;
  ring.role = LineRole::kOuter;
  ring.polygon = 0;
  ring.points = {{10, 10, NAN}, {200, 10, NAN}, {100, 800, NAN}, {10, 10, NAN}};
  const auto before = broken.source;
  EXPECT_EQ(flatten_lakes(broken, {&ring, 1}, {}).error().message, "row 700 is broken");
  EXPECT_EQ(broken.source, before);
  EXPECT_EQ(find_flats(broken, {}).error().message, "row 700 is broken");
}

}  // namespace water_laws
}  // namespace
}  // namespace scarp
