// Lines along walls, and meshes with them.
#include <gtest/gtest.h>
#include <rapidcheck/gtest.h>

#include <cmath>
#include <limits>
#include <random>

#include "features/crack_chains.h"
#include "features/wall_lines.h"
#include "laws/array_source.h"
#include "laws/fields.h"
#include "scarp/features.h"
#include "scarp/simplify.h"

namespace scarp::cliffs_laws_test {
namespace {

using testing::Field;

/// A slope with rotated blocks, each 10 above its ground, and some roughness.
Field city(std::uint32_t seed, std::int32_t side, int blocks, double roughness) {
  std::mt19937 random(seed);
  const auto between = [&](double low, double high) {
    return low + (high - low) * (static_cast<double>(random()) / 4294967296.0);
  };
  Field field{side, side, {}};
  for (std::int32_t y = 0; y < side; ++y) {
    for (std::int32_t x = 0; x < side; ++x)
      field.samples.push_back(static_cast<float>(0.02 * x + 0.05 * y + between(-roughness, roughness)));
  }
  for (int block = 0; block < blocks; ++block) {
    const double turn = between(0, 3.2), col = between(0, side), row = between(0, side);
    const double half = between(1, 0.4 * side), depth = between(1, 0.3 * side);
    for (std::int32_t y = 0; y < side; ++y) {
      for (std::int32_t x = 0; x < side; ++x) {
        const double u = std::cos(turn) * (x - col) + std::sin(turn) * (y - row),
                     v = std::cos(turn) * (y - row) - std::sin(turn) * (x - col);
        if (std::abs(u) <= half && std::abs(v) <= depth)
          field.samples[static_cast<std::size_t>(y) * static_cast<std::size_t>(side) + static_cast<std::size_t>(x)] +=
              10;
      }
    }
  }
  return field;
}

Field random_city(std::uint32_t seed) {
  Field field = city(seed, 8 + static_cast<std::int32_t>(seed % 24), 1 + static_cast<int>(seed % 5), 0.3);
  if (seed % 3 == 0) {
    const Field holes = testing::random_field(seed, field.cols, field.rows, testing::Relief::kFlat, 0.1);
    for (std::size_t i = 0; i < field.samples.size(); ++i) {
      if (std::isnan(holes.samples[i])) field.samples[i] = holes.samples[i];
    }
  }
  return field;
}

struct Piece {
  Point a, b;
};

/// True if the closed segments have a point in common.
bool meet(const Piece& p, const Piece& q) {
  const auto sign = [](std::int64_t v) { return (v > 0) - (v < 0); };
  const auto within = [](const Piece& s, Point at) {
    return std::min(s.a.x, s.b.x) <= at.x && at.x <= std::max(s.a.x, s.b.x) && std::min(s.a.y, s.b.y) <= at.y &&
           at.y <= std::max(s.a.y, s.b.y);
  };
  const int a = sign(orient(p.a, p.b, q.a)), b = sign(orient(p.a, p.b, q.b)), c = sign(orient(q.a, q.b, p.a)),
            d = sign(orient(q.a, q.b, p.b));
  if (a * b < 0 && c * d < 0) return true;
  return (a == 0 && within(p, q.a)) || (b == 0 && within(p, q.b)) || (c == 0 && within(q, p.a)) ||
         (d == 0 && within(q, p.b));
}

std::vector<Piece> pieces_of(const std::vector<features::WallVertex>& line) {
  std::vector<Piece> pieces;
  for (std::size_t k = 0; k + 1 < line.size(); ++k) pieces.push_back({line[k].at, line[k + 1].at});
  return pieces;
}

Point lattice_place(Point sample) { return {sample.x * grid::kLatticeSteps, sample.y * grid::kLatticeSteps}; }

/// Checks that every step between neighbours across the line is a crack, with the high sample on the line's left.
void check_sides(const grid::Raster& raster, double height, const std::vector<Piece>& line) {
  for (std::int32_t y = 0; y < raster.rows; ++y) {
    for (std::int32_t x = 0; x < raster.cols; ++x) {
      for (const Point to : {Point{x + 1, y}, Point{x, y + 1}}) {
        if (to.x == raster.cols || to.y == raster.rows) continue;
        for (const Piece& piece : line) {
          if (!meet(piece, {lattice_place({x, y}), lattice_place(to)})) continue;
          const double step = double{raster.at({x, y})} - double{raster.at(to)};
          RC_ASSERT(std::abs(step) > height);
          const Point high = step > 0 ? Point{x, y} : to, low = step > 0 ? to : Point{x, y};
          RC_ASSERT(orient(piece.a, piece.b, lattice_place(high)) < 0);
          RC_ASSERT(orient(piece.a, piece.b, lattice_place(low)) > 0);
        }
      }
    }
  }
}

std::vector<features::CrackChain> chains_of(const grid::Raster& raster, double height) {
  features::CrackChains cracks(raster.cols, raster.rows, height, [](Point) { return false; });
  for (std::int32_t row = 0; row < raster.rows; ++row)
    cracks.add_row(row, row > 0 ? raster.row(row - 1) : nullptr, raster.row(row),
                   row + 1 < raster.rows ? raster.row(row + 1) : nullptr);
  cracks.link();
  std::vector<features::CrackChain> chains;
  cracks.visit([&](const features::CrackChain& chain) { chains.push_back(chain); });
  return chains;
}

RC_GTEST_PROP(CliffLaws, LinesRunBetweenHighAndLowSamplesAndDoNotMeet, ()) {
  const auto seed = *rc::gen::arbitrary<std::uint32_t>();
  const Field field =
      seed % 4 == 1 ? testing::random_field(seed, 12, 9, testing::kReliefs[seed / 4 % 5], 0.05) : random_city(seed);
  const grid::Raster raster = field.raster();
  const double height = seed % 4 == 1 ? 1.5 : 4;
  std::vector<Piece> others;
  for (const features::CrackChain& chain : chains_of(raster, height)) {
    for (const features::Wall& wall : features::find_walls(chain, 1)) {
      RC_ASSERT(wall.top.size() == wall.foot.size());
      RC_ASSERT(wall.top.size() >= 2u);
      std::vector<Piece> top = pieces_of(wall.top), foot = pieces_of(wall.foot);
      check_sides(raster, height, top);
      check_sides(raster, height, foot);
      for (const Piece& a : top) {
        for (const Piece& b : foot) RC_ASSERT(!meet(a, b));
      }
      for (auto* line : {&top, &foot}) {
        for (std::size_t i = 0; i < line->size(); ++i) {
          for (const Piece& other : others) RC_ASSERT(!meet((*line)[i], other));
          for (std::size_t k = i + 2; k < line->size(); ++k) {
            const bool is_closing = i == 0 && k + 1 == line->size() && (*line)[k].b == (*line)[0].a;
            RC_ASSERT(is_closing || !meet((*line)[i], (*line)[k]));
          }
        }
      }
      others.insert(others.end(), top.begin(), top.end());
      others.insert(others.end(), foot.begin(), foot.end());
    }
  }
}

RC_GTEST_PROP(CliffLaws, ChainsHoldEachCrackOnce, ()) {
  const auto seed = *rc::gen::arbitrary<std::uint32_t>();
  const Field field = random_city(seed);
  const grid::Raster raster = field.raster();
  std::size_t steps = 0, cracks = 0;
  for (std::int32_t y = 0; y < raster.rows; ++y) {
    for (std::int32_t x = 0; x < raster.cols; ++x) {
      for (const Point to : {Point{x + 1, y}, Point{x, y + 1}}) {
        if (to.x < raster.cols && to.y < raster.rows)
          steps += std::abs(double{raster.at({x, y})} - double{raster.at(to)}) > 4;
      }
    }
  }
  for (const features::CrackChain& chain : chains_of(raster, 4)) {
    cracks += chain.cracks.size();
    for (const features::Crack& crack : chain.cracks)
      RC_ASSERT(double{raster.at(crack.high)} - double{raster.at(crack.low)} > 4);
  }
  RC_ASSERT(cracks == steps);
}

RC_GTEST_PROP(CliffLaws, OfASourceAreThoseOfTheSameSamplesInMemory, ()) {
  const auto seed = *rc::gen::arbitrary<std::uint32_t>();
  // More rows than one read.
  Field field = random_city(seed);
  while (field.rows < 150) {
    const Field more = random_city(seed + static_cast<std::uint32_t>(field.rows));
    for (std::int32_t y = 0; y < more.rows; ++y) {
      for (std::int32_t x = 0; x < field.cols; ++x) field.samples.push_back(more.raster().at({x % more.cols, y}));
    }
    field.rows += more.rows;
  }
  Line line;
  line.points = {{-2, 1.0 * (seed % 150), NAN}, {1.0 * field.cols, 40, NAN}, {3, 160, NAN}};
  CliffOptions options{4, 0.25 * (seed % 5)};
  if (seed % 2 == 0) options.avoid = {&line, 1};
  const testing::ArraySource source(field.view());
  const auto held = detect_cliffs(field.view(), options),
             streamed = detect_cliffs(testing::with_source(field.view(), source), options);
  RC_ASSERT(held.has_value());
  RC_ASSERT(streamed.has_value());
  RC_ASSERT(streamed->wall_count == held->wall_count);
  RC_ASSERT(streamed->vertices == held->vertices);
  RC_ASSERT(streamed->lines.size() == held->lines.size());
  for (std::size_t k = 0; k < held->lines.size(); ++k) {
    RC_ASSERT(streamed->lines[k].points == held->lines[k].points);
    RC_ASSERT(streamed->lines[k].name == held->lines[k].name);
  }
}

TEST(Cliffs, TellWhatTheSourceSaysAndWhatMemoryTheyNeed) {
  const Field field = city(3, 200, 9, 0);
  const testing::ArraySource broken(field.view(), 130), source(field.view());
  EXPECT_EQ(detect_cliffs(testing::with_source(field.view(), broken), {4, 1}).error().message, "row 130 is broken");
  CliffOptions options{4, 1};
  options.run.memory.limit = 1'000'000;
  options.run.memory.taken = 950'000;
  const auto refused = detect_cliffs(testing::with_source(field.view(), source), options);
  ASSERT_FALSE(refused);
  EXPECT_EQ(refused.error().kind, ErrorKind::kMemory);
  EXPECT_NE(refused.error().message.find("the memory limit is too little: walls take 1M"), std::string::npos);
  options.run.memory.taken = 0;
  EXPECT_TRUE(detect_cliffs(testing::with_source(field.view(), source), options));
}

Result<Simplified> with_cliffs(const Field& field, double height, SimplifyOptions options) {
  const auto cliffs = detect_cliffs(field.view(), {height, *options.goals.max_error});
  if (!cliffs) return tl::unexpected(cliffs.error());
  options.features.breaklines.lines = cliffs->lines;
  return simplify(field.view(), options);
}

RC_GTEST_PROP(CliffLaws, MeshesWithWallsKeepTheBoundAndAreSound, ()) {
  const auto seed = *rc::gen::arbitrary<std::uint32_t>();
  const Field field = random_city(seed);
  constexpr Effort kEfforts[] = {Effort::kFast, Effort::kNormal, Effort::kHigh};
  SimplifyOptions options;
  options.goals.max_error = 0.5 + 0.25 * (seed % 4);
  options.quality.effort = kEfforts[seed / 7 % 3];
  if (options.quality.effort == Effort::kHigh && seed % 2 == 0) options.quality.vertices = Vertices::kSamples;
  options.run.threads = 1;
  const auto one = with_cliffs(field, 4, options);
  if (!one && one.error().kind == ErrorKind::kInput) RC_DISCARD("no cell is valid");
  RC_ASSERT(one.has_value());
  RC_ASSERT(one->measurement.max_error <= *options.goals.max_error);
  RC_ASSERT(one->measurement.uncovered == 0u);
  RC_ASSERT(one->edits.empty());
  const auto judged = measure(field.view(), one->mesh);
  RC_ASSERT(judged.has_value());
  RC_ASSERT(judged->max_error <= *options.goals.max_error);
  RC_ASSERT(judged->is_sound());
  options.run.threads = 3;
  const auto three = with_cliffs(field, 4, options);
  RC_ASSERT(three.has_value());
  RC_ASSERT(three->mesh.triangles == one->mesh.triangles);
  RC_ASSERT(three->mesh.positions == one->mesh.positions);
}

TEST(Cliffs, AHouseAskewTakesTensOfTriangles) {
  Field field{100, 100, {}};
  for (std::int32_t y = 0; y < 100; ++y) {
    for (std::int32_t x = 0; x < 100; ++x) {
      const double u = 0.932 * (x - 50) + 0.362 * (y - 48), v = 0.932 * (y - 48) - 0.362 * (x - 50);
      field.samples.push_back(static_cast<float>(0.1 * x + (std::abs(u) < 30 && std::abs(v) < 18 ? 10 : 0)));
    }
  }
  const auto cliffs = detect_cliffs(field.view(), {3, 0.5});
  ASSERT_TRUE(cliffs);
  EXPECT_EQ(cliffs->wall_count, 1u);
  EXPECT_LE(cliffs->vertices, 16u);
  for (const Effort effort : {Effort::kFast, Effort::kNormal, Effort::kHigh}) {
    SimplifyOptions options;
    options.goals.max_error = 0.5;
    options.quality.effort = effort;
    const auto with = with_cliffs(field, 3, options), without = simplify(field.view(), options);
    ASSERT_TRUE(with && without);
    EXPECT_LE(with->mesh.triangle_count(), 40u);
    EXPECT_GE(without->mesh.triangle_count(), (effort == Effort::kFast ? 8 : 2) * with->mesh.triangle_count());
  }
}

TEST(Cliffs, NodataAndSmallStepsAreNone) {
  Field field = city(5, 30, 2, 0);
  for (std::size_t i = 0; i < field.samples.size(); i += 3) field.samples[i] = std::numeric_limits<float>::quiet_NaN();
  const auto beside_nodata = detect_cliffs(field.view(), {4, 1}),
             too_high = detect_cliffs(city(5, 30, 2, 0).view(), {50, 1});
  ASSERT_TRUE(beside_nodata && too_high);
  EXPECT_EQ(beside_nodata->lines.size(), 0u);
  EXPECT_EQ(too_high->lines.size(), 0u);
}

TEST(Cliffs, StayAwayFromOtherLines) {
  const Field field = city(11, 60, 3, 0);
  Line line;
  line.points = {{0, 20.3, NAN}, {59, 41.7, NAN}};
  const auto all = detect_cliffs(field.view(), {4, 1}),
             some = detect_cliffs(field.view(), {4, 1, {0, 1, 0, 0, 0, 1}, {&line, 1}});
  ASSERT_TRUE(all && some);
  EXPECT_LT(0u, some->lines.size());
  const auto in_lattice = [](const std::array<double, 3>& p) {
    return Point{static_cast<std::int32_t>(std::lround(256 * p[0])),
                 static_cast<std::int32_t>(std::lround(256 * p[1]))};
  };
  const auto crossings = [&](const Cliffs& cliffs) {
    int count = 0;
    for (const Line& wall : cliffs.lines) {
      for (std::size_t k = 0; k + 1 < wall.points.size(); ++k)
        count += meet({in_lattice(wall.points[k]), in_lattice(wall.points[k + 1])},
                      {in_lattice(line.points[0]), in_lattice(line.points[1])});
    }
    return count;
  };
  EXPECT_GT(crossings(*all), 0);
  EXPECT_EQ(crossings(*some), 0);
}

TEST(Cliffs, RefuseHeightsThatAreNone) {
  const Field field = city(3, 20, 1, 0);
  for (const double height : {0.0, -1.0, std::numeric_limits<double>::infinity(), std::nan("")})
    EXPECT_EQ(detect_cliffs(field.view(), {height, 1}).error().kind, ErrorKind::kUsage);
  EXPECT_EQ(detect_cliffs(field.view(), {1, -1}).error().kind, ErrorKind::kUsage);
}

}  // namespace
}  // namespace scarp::cliffs_laws_test
