// Ridges and valleys in rasters, and meshes that prefer or preserve them.
#include <gtest/gtest.h>
#include <rapidcheck/gtest.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <set>

#include "laws/array_source.h"
#include "laws/fields.h"
#include "scarp/features.h"
#include "scarp/simplify.h"

namespace scarp::ridges_laws_test {
namespace {

using testing::Field;

template <class Height>
Field field_of(std::int32_t cols, std::int32_t rows, const Height& height) {
  Field field{cols, rows, {}};
  for (std::int32_t y = 0; y < rows; ++y) {
    for (std::int32_t x = 0; x < cols; ++x) field.samples.push_back(static_cast<float>(height(x, y)));
  }
  return field;
}

Field negated(Field field) {
  for (float& height : field.samples) height = -height;
  return field;
}

/// Hills with crests and beds, some with nodata.
Field hills(std::uint32_t seed) {
  const auto side = static_cast<std::int32_t>(30 + seed % 20);
  return testing::random_field(seed, side, side + 3, testing::Relief::kRidges, seed % 3 == 0 ? 0.02 : 0);
}

std::vector<std::vector<std::array<double, 2>>> places_of(const std::vector<Line>& lines) {
  std::vector<std::vector<std::array<double, 2>>> places;
  for (const Line& line : lines) {
    places.emplace_back();
    for (const auto& point : line.points) places.back().push_back({point[0], point[1]});
  }
  return places;
}

/// A roof rotated by `turn` is one ridge with two vertices, and no valley.
void expect_one_ridge(double turn, double fall) {
  const double right = std::cos(turn), down = std::sin(turn);
  const auto beside = [&](double x, double y) { return right * (x - 20.3) + down * (y - 30.1); };
  const Field field =
      field_of(41, 61, [&](double x, double y) { return -2 * std::abs(beside(x, y)) + fall * (down * x - right * y); });
  const auto found = detect_ridges(field.view(), {10, 2});
  ASSERT_TRUE(found);
  EXPECT_TRUE(found->valleys.empty());
  ASSERT_EQ(found->ridges.size(), 1u);
  const Line& ridge = found->ridges[0];
  EXPECT_TRUE(is_ridge_line(ridge));
  ASSERT_EQ(ridge.points.size(), 2u);
  double length = 0;
  for (const auto& point : ridge.points) {
    EXPECT_LE(std::abs(beside(point[0], point[1])), 0.5);
    EXPECT_TRUE(std::isnan(point[2]));
    length = std::hypot(point[0] - ridge.points[0][0], point[1] - ridge.points[0][1]);
  }
  EXPECT_GE(length, 57);
}

TEST(Ridges, ARoofHasOneOfTwoVertices) {
  expect_one_ridge(0, 0);
  expect_one_ridge(0, 0.7);
  expect_one_ridge(0.3, 0);
  expect_one_ridge(-0.45, 0.2);
}

TEST(Ridges, ACrestBetweenTwoColumnsHasOneToo) {
  const Field field = field_of(40, 50, [](double x, double) { return -std::abs(x - 19.5); });
  const auto found = detect_ridges(field.view(), {5, 1});
  ASSERT_TRUE(found);
  ASSERT_EQ(found->ridges.size(), 1u);
  for (const auto& point : found->ridges[0].points) EXPECT_EQ(std::abs(point[0] - 19.5), 0.5);
  EXPECT_EQ(found->ridges[0].points.size(), 2u);
}

TEST(Ridges, ARoofLowerThanAskedHasNone) {
  const Field field = field_of(40, 50, [](double x, double) { return -std::min(std::abs(x - 20), 4.0); });
  EXPECT_EQ(detect_ridges(field.view(), {4, 1})->ridges.size(), 1u);
  EXPECT_EQ(detect_ridges(field.view(), {4.5, 1})->ridges.size(), 0u);
}

TEST(Ridges, TheFlankOfAConeHasNone) {
  const Field field = field_of(201, 201, [](double x, double y) { return -std::hypot(x - 100, y - 100); });
  const auto found = detect_ridges(field.view(), {2, 1});
  ASSERT_TRUE(found);
  EXPECT_TRUE(found->valleys.empty());
  for (const Line& line : found->ridges) {
    for (const auto& point : line.points) EXPECT_LT(std::hypot(point[0] - 100, point[1] - 100), 20);
  }
}

TEST(Ridges, WhereTwoMeetBothHaveAVertex) {
  // A forked valley: three beds that meet.
  const Field field = field_of(81, 81, [](double x, double y) {
    const double fork = std::max(y - 40, 0.0), bed = std::min(std::abs(x - 40 - fork), std::abs(x - 40 + fork));
    return 3 * bed - 0.2 * y;
  });
  const auto found = detect_ridges(field.view(), {10, 1});
  ASSERT_TRUE(found);
  ASSERT_EQ(found->valleys.size(), 2u);
  std::set<std::array<double, 3>> first;
  for (auto point : found->valleys[0].points) first.insert({point[0], point[1], 0});
  const auto &begin = found->valleys[1].points.front(), &end = found->valleys[1].points.back();
  EXPECT_EQ(first.count({begin[0], begin[1], 0}) + first.count({end[0], end[1], 0}), 1u);
}

RC_GTEST_PROP(RidgeLaws, NegationExchangesRidgesAndValleys, ()) {
  const auto seed = *rc::gen::arbitrary<std::uint32_t>();
  const Field field =
      seed % 2 == 0 ? hills(seed) : testing::random_field(seed, 33, 27, testing::kReliefs[seed / 2 % 5], 0.05);
  const double height = seed % 2 == 0 ? 10 : 1;
  const auto as_is = detect_ridges(field.view(), {height, 2}),
             turned = detect_ridges(negated(field).view(), {height, 2});
  RC_ASSERT(as_is.has_value() && turned.has_value());
  RC_ASSERT(places_of(as_is->ridges) == places_of(turned->valleys));
  RC_ASSERT(places_of(as_is->valleys) == places_of(turned->ridges));
}

RC_GTEST_PROP(RidgeLaws, NoiseOnAPlaneThatIsLowerHasNone, ()) {
  const auto seed = *rc::gen::arbitrary<std::uint32_t>();
  const Field noise = testing::random_field(seed, 50, 40, testing::Relief::kReal);  // -50 … 50
  const double east = seed % 7 * 0.4 - 1.2, south = seed % 5 * 0.5 - 1;
  Field field = noise;
  for (std::size_t i = 0; i < field.samples.size(); ++i)
    field.samples[i] = static_cast<float>(0.1 * field.samples[i] + east * static_cast<double>(i % 50) +
                                          south * static_cast<double>(i / 50));
  const auto found = detect_ridges(field.view(), {10.1, 1});
  RC_ASSERT(found.has_value());
  RC_ASSERT(found->ridges.empty());
  RC_ASSERT(found->valleys.empty());
}

RC_GTEST_PROP(RidgeLaws, LinesRunOverValidSamplesAndSetNoHeights, ()) {
  const auto seed = *rc::gen::arbitrary<std::uint32_t>();
  const Field field = hills(seed);
  Line road;
  road.points = {{0, 10.3, NAN}, {29, 21.7, NAN}};
  RidgeOptions options{10, 2};
  options.avoid = {&road, 1};
  const auto found = detect_ridges(field.view(), options);
  RC_ASSERT(found.has_value());
  for (const auto* lines : {&found->ridges, &found->valleys}) {
    for (const Line& line : *lines) {
      RC_ASSERT(line.points.size() >= 2u);
      for (const auto& [x, y, z] : line.points) {
        const Point p{static_cast<std::int32_t>(x), static_cast<std::int32_t>(y)};
        RC_ASSERT(p.x == x && p.y == y && std::isnan(z));
        RC_ASSERT(field.raster().is_valid(p));
        if (x <= 29) RC_ASSERT(std::abs(y - (10.3 + 11.4 / 29 * x)) > 0.4);
      }
    }
  }
}

RC_GTEST_PROP(RidgeLaws, OfASourceAreThoseOfTheSameSamplesInMemory, ()) {
  const auto seed = *rc::gen::arbitrary<std::uint32_t>();
  // More rows than one read.
  const Field field = testing::random_field(seed, 20 + static_cast<std::int32_t>(seed % 30), 150,
                                            testing::kReliefs[seed % 5], seed % 2 == 0 ? 0.02 : 0);
  Line line;
  line.points = {{-2, 1.0 * (seed % 150), NAN}, {1.0 * field.cols, 40, NAN}, {3, 160, NAN}};
  RidgeOptions options;
  options.height = *rc::gen::element(0.5, 2.0, 8.0);
  options.max_error = *rc::gen::element(0.0, 1.0, 5.0);
  options.run.threads = *rc::gen::element(1, 2);
  if (seed % 3 == 0) options.avoid = {&line, 1};
  const testing::ArraySource source(field.view());
  const auto held = detect_ridges(field.view(), options),
             streamed = detect_ridges(testing::with_source(field.view(), source), options);
  RC_ASSERT(held.has_value());
  RC_ASSERT(streamed.has_value());
  RC_ASSERT(streamed->vertices == held->vertices);
  RC_ASSERT(places_of(streamed->ridges) == places_of(held->ridges));
  RC_ASSERT(places_of(streamed->valleys) == places_of(held->valleys));
}

TEST(Ridges, TellWhatTheSourceSaysAndWhatMemoryTheyNeed) {
  const Field field = testing::random_field(3, 100, 200, testing::Relief::kRidges);
  const testing::ArraySource broken(field.view(), 130), source(field.view());
  EXPECT_EQ(detect_ridges(testing::with_source(field.view(), broken), {1, 1}).error().message, "row 130 is broken");
  RidgeOptions options{1, 1};
  options.run.memory.limit = 1'000'000;
  options.run.memory.taken = 900'000;
  const auto refused = detect_ridges(testing::with_source(field.view(), source), options);
  ASSERT_FALSE(refused);
  EXPECT_EQ(refused.error().kind, ErrorKind::kMemory);
  EXPECT_NE(refused.error().message.find("the memory limit is too little: ridges and valleys take"), std::string::npos);
  options.run.memory.taken = 0;
  options.run.memory.limit = 4'000'000;
  EXPECT_TRUE(detect_ridges(testing::with_source(field.view(), source), options));
}

Result<Simplified> with_ridges(const Field& field, bool are_kept, SimplifyOptions options) {
  RidgeOptions asked{10, *options.goals.max_error};
  asked.are_kept = are_kept;
  asked.run.threads = options.run.threads;
  const auto ridges = detect_ridges(field.view(), asked);
  if (!ridges) return tl::unexpected(ridges.error());
  options.features.breaklines.lines = ridges->ridges;
  options.features.breaklines.lines.insert(options.features.breaklines.lines.end(), ridges->valleys.begin(),
                                           ridges->valleys.end());
  return simplify(field.view(), options);
}

RC_GTEST_PROP(RidgeLaws, MeshesWithRidgesKeepTheBoundAndAreSound, ()) {
  const auto seed = *rc::gen::arbitrary<std::uint32_t>();
  const Field field = hills(seed);
  constexpr Effort kEfforts[] = {Effort::kFast, Effort::kNormal, Effort::kHigh};
  SimplifyOptions options;
  options.goals.max_error = 1.5 + 0.5 * (seed % 4);
  options.quality.effort = kEfforts[seed / 7 % 3];
  if (options.quality.effort == Effort::kHigh && seed % 2 == 0) options.quality.vertices = Vertices::kSamples;
  options.run.threads = 1;
  const bool are_kept = seed / 21 % 2 == 0;
  const auto one = with_ridges(field, are_kept, options);
  RC_ASSERT(one.has_value());
  RC_ASSERT(one->measurement.max_error <= *options.goals.max_error);
  RC_ASSERT(one->measurement.uncovered == 0u);
  RC_ASSERT(one->edits.empty());
  RC_ASSERT(one->lines_inserted == 0u);
  const auto judged = measure(field.view(), one->mesh);
  RC_ASSERT(judged.has_value());
  RC_ASSERT(judged->max_error <= *options.goals.max_error);
  RC_ASSERT(judged->is_sound());
  options.run.threads = 3;
  const auto three = with_ridges(field, are_kept, options);
  RC_ASSERT(three.has_value());
  RC_ASSERT(three->mesh.triangles == one->mesh.triangles);
  RC_ASSERT(three->mesh.positions == one->mesh.positions);
}

/// True if edges of the mesh lead from a to b, all on the segment.
bool is_chain(const std::vector<std::array<double, 4>>& edges, std::array<double, 2> a, std::array<double, 2> b) {
  const double dx = b[0] - a[0], dy = b[1] - a[1], length = std::hypot(dx, dy);
  double covered = 0;
  for (const auto& [x0, y0, x1, y1] : edges) {
    const auto beside = [&](double x, double y) { return std::abs((x - a[0]) * dy - (y - a[1]) * dx) / length; };
    const auto along = [&](double x, double y) { return ((x - a[0]) * dx + (y - a[1]) * dy) / length; };
    // The lattice moves lines that cross others by 3/512.
    if (beside(x0, y0) > 0.01 || beside(x1, y1) > 0.01) continue;
    const double from = along(x0, y0), to = along(x1, y1);
    if (from < to && from > -0.01 && to < length + 0.01) covered += to - from;
  }
  return std::abs(covered - length) < 0.02;
}

TEST(Ridges, StayEdgesWhereTheyAreKept) {
  const Field field = hills(4);
  RidgeOptions asked{10, 4};
  asked.are_kept = true;
  const auto ridges = detect_ridges(field.view(), asked);
  ASSERT_TRUE(ridges);
  ASSERT_FALSE(ridges->ridges.empty());
  ASSERT_FALSE(ridges->valleys.empty());
  for (const Effort effort : {Effort::kFast, Effort::kNormal, Effort::kHigh}) {
    SimplifyOptions options;
    options.goals.max_error = 4;
    options.quality.effort = effort;
    const auto result = with_ridges(field, true, options);
    ASSERT_TRUE(result);
    const Mesh& mesh = result->mesh;
    const auto place = [&](std::uint32_t v) {
      const auto& frame = field.view().frame.affine;
      const double x = mesh.origin[0] + double{mesh.positions[3 * v]},
                   y = mesh.origin[1] + double{mesh.positions[3 * v + 1]};
      return std::array<double, 2>{(x - frame[0]) / frame[1], (y - frame[3]) / frame[5]};
    };
    std::set<std::array<double, 4>> edges;
    for (std::size_t i = 0; i < mesh.triangles.size(); ++i) {
      const std::size_t next = i % 3 == 2 ? i - 2 : i + 1;
      const auto a = place(mesh.triangles[i]), b = place(mesh.triangles[next]);
      edges.insert({a[0], a[1], b[0], b[1]});
      edges.insert({b[0], b[1], a[0], a[1]});
    }
    const std::vector<std::array<double, 4>> list(edges.begin(), edges.end());
    for (const auto* lines : {&ridges->ridges, &ridges->valleys}) {
      for (const Line& line : *lines) {
        for (std::size_t k = 0; k + 1 < line.points.size(); ++k)
          EXPECT_TRUE(
              is_chain(list, {line.points[k][0], line.points[k][1]}, {line.points[k + 1][0], line.points[k + 1][1]}))
              << line.name;
      }
    }
  }
}

TEST(Ridges, EndWhereTheyAreToldTo) {
  const Field field = hills(4);
  RidgeOptions options{10, 2};
  options.run.progress = [](const Progress& progress) {
    EXPECT_EQ(progress.pass, "ridges");
    return false;
  };
  EXPECT_EQ(detect_ridges(field.view(), options).error().kind, ErrorKind::kCancelled);
}

TEST(Ridges, RefuseHeightsThatAreNone) {
  const Field field = hills(4);
  for (const double height : {0.0, -1.0, std::numeric_limits<double>::infinity(), std::nan("")})
    EXPECT_EQ(detect_ridges(field.view(), {height, 1}).error().kind, ErrorKind::kUsage);
  EXPECT_EQ(detect_ridges(field.view(), {1, -1}).error().kind, ErrorKind::kUsage);
}

}  // namespace
}  // namespace scarp::ridges_laws_test
