// The judge against an oracle that tests every sample against every triangle in long double.
#include "scarp/measure.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cstring>
#include <optional>

#include "laws/sanitized.h"
#include "measure/facet_error.h"
#include "unit/measure_meshes.h"

namespace scarp::testing {
namespace {

constexpr double kTolerance = 1.0 / 256;

struct Judged {
  std::vector<double> errors;  // NaN: nodata, stray or uncovered
  std::uint64_t uncovered = 0, stray = 0, nodata_cells = 0;
  bool is_clear_cut = true;  // no sample or cell is so close to a limit that rounding decides
};

using Long = long double;

struct OracleTriangle {
  std::array<Long, 3> x, y, z;
};

OracleTriangle oracle_triangle(const Terrain& terrain, const Mesh& mesh, std::size_t t) {
  OracleTriangle out{};
  const auto& a = terrain.frame.affine;
  const Long det = Long{a[1]} * a[5] - Long{a[2]} * a[4];
  for (std::size_t k = 0; k < 3; ++k) {
    const std::size_t v = mesh.triangles[3 * t + k];
    const Long dx = Long{mesh.origin[0]} + mesh.positions[3 * v] - a[0],
               dy = Long{mesh.origin[1]} + mesh.positions[3 * v + 1] - a[3];
    const auto clean = [](Long value) {
      return std::abs(value - std::round(value)) < 1e-7L ? std::round(value) : value;
    };
    out.x[k] = clean((a[5] * dx - a[2] * dy) / det);
    out.y[k] = clean((a[1] * dy - a[4] * dx) / det);
    out.z[k] = Long{mesh.origin[2]} + mesh.positions[3 * v + 2];
  }
  return out;
}

Long cross(Long ax, Long ay, Long bx, Long by) { return ax * by - ay * bx; }

/// Weights of the corners at p, positive inside for both orientations; none for a triangle without area.
std::optional<std::array<Long, 3>> weights(const OracleTriangle& t, Long px, Long py) {
  const Long area = cross(t.x[1] - t.x[0], t.y[1] - t.y[0], t.x[2] - t.x[0], t.y[2] - t.y[0]);
  if (area == 0) return std::nullopt;
  std::array<Long, 3> w{};
  for (std::size_t k = 0; k < 3; ++k) {
    const std::size_t a = (k + 1) % 3, b = (k + 2) % 3;
    w[k] = cross(t.x[b] - t.x[a], t.y[b] - t.y[a], px - t.x[a], py - t.y[a]) / area;
  }
  return w;
}

Long distance_outside(const OracleTriangle& t, Long px, Long py) {
  Long least = HUGE_VALL;
  for (std::size_t a = 0; a < 3; ++a) {
    const std::size_t b = (a + 1) % 3;
    const Long ux = t.x[b] - t.x[a], uy = t.y[b] - t.y[a];
    const Long s = std::clamp((ux * (px - t.x[a]) + uy * (py - t.y[a])) / (ux * ux + uy * uy), 0.0L, 1.0L);
    least = std::min(least, std::hypot(px - t.x[a] - s * ux, py - t.y[a] - s * uy));
  }
  return least;
}

/// True if thinner than the tolerance: next to such a triangle, the judge uses the nearest point, and the oracle is
/// undecided.
bool is_sliver(const OracleTriangle& t) {
  const Long area = std::abs(cross(t.x[1] - t.x[0], t.y[1] - t.y[0], t.x[2] - t.x[0], t.y[2] - t.y[0]));
  Long longest = 0;
  for (std::size_t a = 0; a < 3; ++a)
    longest = std::max(longest, std::hypot(t.x[(a + 1) % 3] - t.x[a], t.y[(a + 1) % 3] - t.y[a]));
  return area <= kTolerance * longest * 1.001L;
}

Judged ask_oracle(const Terrain& terrain, const Mesh& mesh) {
  Judged out;
  const auto valid = [&](int c, int r) {
    return c >= 0 && r >= 0 && c < terrain.cols && r < terrain.rows &&
           std::isfinite(terrain.samples[static_cast<std::size_t>(r * terrain.cols + c)]);
  };
  const auto corners = [&](int c, int r) {
    if (c < 0 || r < 0 || c + 1 >= terrain.cols || r + 1 >= terrain.rows) return 0;
    return valid(c, r) + valid(c + 1, r) + valid(c, r + 1) + valid(c + 1, r + 1);
  };
  std::vector<OracleTriangle> triangles;
  for (std::size_t t = 0; t < mesh.triangle_count(); ++t) triangles.push_back(oracle_triangle(terrain, mesh, t));
  const double nan = std::numeric_limits<double>::quiet_NaN();
  for (int r = 0; r < terrain.rows; ++r) {
    for (int c = 0; c < terrain.cols; ++c) {
      out.errors.push_back(nan);
      if (!valid(c, r)) continue;
      if (std::max({corners(c - 1, r - 1), corners(c, r - 1), corners(c - 1, r), corners(c, r)}) < 3) {
        ++out.stray;
        continue;
      }
      const Long sample = terrain.samples[static_cast<std::size_t>(r * terrain.cols + c)];
      Long best = 0, near = HUGE_VALL, beside = 0;
      bool is_covered = false;
      for (const OracleTriangle& t : triangles) {
        const auto w = weights(t, c, r);
        if (!w) continue;
        const Long error = (*w)[0] * t.z[0] + (*w)[1] * t.z[1] + (*w)[2] * t.z[2] - sample;
        const Long least = std::min({(*w)[0], (*w)[1], (*w)[2]});
        if (least != 0 && std::abs(least) < 1e-9L) out.is_clear_cut = false;
        if (least >= 0) {
          if (!is_covered || std::abs(error) > std::abs(best) || (std::abs(error) == std::abs(best) && error > best))
            best = error;
          is_covered = true;
        } else {
          const Long away = distance_outside(t, c, r);
          if (std::abs(away - kTolerance) < 1e-9L) out.is_clear_cut = false;
          if (away < kTolerance && is_sliver(t)) out.is_clear_cut = false;
          if (away < near) {
            near = away;
            beside = error;
          }
        }
      }
      if (is_covered) {
        out.errors.back() = static_cast<double>(best);
      } else if (near <= kTolerance) {
        out.errors.back() = static_cast<double>(beside);
      } else {
        ++out.uncovered;
      }
    }
  }
  for (int r = 0; r + 1 < terrain.rows; ++r) {
    for (int c = 0; c + 1 < terrain.cols; ++c) {
      if (corners(c, r) == 4) continue;
      Long px = c + 0.5L, py = r + 0.5L;
      if (corners(c, r) == 3) {
        const int missing = !valid(c, r) ? 0 : !valid(c + 1, r) ? 1 : !valid(c, r + 1) ? 2 : 3;
        px = c + ((missing & 1) ? 2.0L : 1.0L) / 3;
        py = r + ((missing & 2) ? 2.0L : 1.0L) / 3;
      }
      bool is_covered = false;
      for (const OracleTriangle& t : triangles) {
        const auto w = weights(t, px, py);
        if (!w || std::min({(*w)[0], (*w)[1], (*w)[2]}) <= 0) continue;
        const Long depth = distance_outside(t, px, py);
        if (std::abs(depth - kTolerance) < 1e-9L) out.is_clear_cut = false;
        is_covered = is_covered || depth > kTolerance;
      }
      out.nodata_cells += is_covered;
    }
  }
  return out;
}

struct Verdict {
  Measurement numbers;
  std::vector<float> errors;
};

Verdict judge_by_rows(const HeightField& field, const Mesh& mesh, MeasureOptions options = {}) {
  Verdict out;
  int next_row = 0;
  options.on_row = [&](int row, std::span<const float> errors) {
    EXPECT_EQ(row, next_row++);
    out.errors.insert(out.errors.end(), errors.begin(), errors.end());
  };
  const auto result = measure(field, mesh, options);
  EXPECT_TRUE(result.has_value());
  if (result) out.numbers = *result;
  EXPECT_EQ(next_row, field.rows);
  return out;
}

void expect_agreement(const Judged& oracle, const Verdict& verdict, int cols) {
  ASSERT_EQ(oracle.errors.size(), verdict.errors.size());
  std::uint64_t samples = 0;
  long double sum = 0, square = 0, magnitude = 0;
  double largest = 0;
  std::array<int, 2> largest_at{-1, -1};
  std::vector<double> sorted;
  for (std::size_t i = 0; i < oracle.errors.size(); ++i) {
    const double error = oracle.errors[i];
    ASSERT_EQ(std::isnan(error), std::isnan(verdict.errors[i])) << "sample " << i % cols << ", " << i / cols;
    if (std::isnan(error)) continue;
    EXPECT_NEAR(error, verdict.errors[i], 1e-6 * (1 + std::abs(error))) << "sample " << i % cols << ", " << i / cols;
    ++samples;
    sum += error;
    square += error * error;
    magnitude += std::abs(error);
    sorted.push_back(std::abs(error));
    if (std::abs(error) > largest * (1 + 1e-9)) {
      largest = std::abs(error);
      largest_at = {static_cast<int>(i) % cols, static_cast<int>(i) / cols};
    }
  }
  const Measurement& m = verdict.numbers;
  EXPECT_EQ(m.samples, samples);
  EXPECT_EQ(m.uncovered, oracle.uncovered);
  EXPECT_EQ(m.stray, oracle.stray);
  EXPECT_EQ(m.nodata_cells_covered, oracle.nodata_cells);
  if (samples == 0) return;
  const auto n = static_cast<double>(samples);
  EXPECT_NEAR(m.max_error, largest, 1e-9 * largest);
  EXPECT_EQ(m.max_error_at, largest_at);
  EXPECT_NEAR(m.rmse, std::sqrt(static_cast<double>(square) / n), 1e-9 * (1 + largest));
  EXPECT_NEAR(m.mean_error, static_cast<double>(sum) / n, 1e-9 * (1 + largest));
  EXPECT_NEAR(m.mean_abs_error, static_cast<double>(magnitude) / n, 1e-9 * (1 + largest));
  std::sort(sorted.begin(), sorted.end());
  const auto expect_percentile = [&](unsigned permille, double value) {
    const double exact = sorted[(samples * permille + 999) / 1000 - 1];
    EXPECT_GE(value, exact * (1 - 1e-7) - 1e-7);
    EXPECT_LE(value, exact * 1.0005 + 1e-7);
  };
  expect_percentile(500, m.p50);
  expect_percentile(950, m.p95);
  expect_percentile(990, m.p99);
  expect_percentile(999, m.p999);
  EXPECT_LE(m.p999, m.max_error);
}

Frame rotated_frame() {
  Frame frame;
  frame.kind = Frame::Kind::kSource;
  frame.affine = {440720.25, 25.98, 14.96, 4100210.5, 14.96, -25.98};
  return frame;
}
Frame south_up_frame() {
  Frame frame;
  frame.affine = {-117.5, 0.00027777777777777778, 0, 34.1, 0, 0.00027777777777777778};
  return frame;
}

/// Arbitrary triangles: overlapping, thin, flipped, partly outside; corners on and off samples.
Mesh random_soup(const Terrain& terrain, int triangles, bool on_lattice, std::mt19937& random) {
  Mesh mesh;
  const auto [x, y] = terrain.frame.apply_affine(terrain.cols / 2, terrain.rows / 2);
  mesh.origin = {std::floor(x), std::floor(y), 0};
  std::uniform_real_distribution<double> unit(0, 1);
  for (int t = 0; t < triangles; ++t) {
    const double c0 = unit(random) * terrain.cols, r0 = unit(random) * terrain.rows;
    for (int k = 0; k < 3; ++k) {
      double col = t % 3 == 0 ? unit(random) * (terrain.cols + 2) - 1 : c0 + unit(random) * (t % 3 == 1 ? 6 : 0.3);
      double row = t % 3 == 0 ? unit(random) * (terrain.rows + 2) - 1 : r0 + unit(random) * 6;
      if (on_lattice) {
        col = std::round(col);
        row = std::round(row);
      }
      add_vertex(mesh, terrain.frame, col, row, unit(random) * 100);
      mesh.triangles.push_back(static_cast<std::uint32_t>(3 * t + k));
    }
  }
  return mesh;
}

TEST(Measure, AgreesWithTheOracleOnTriangleSoup) {
  std::mt19937 random(7);
  int judged = 0;
  for (int round = 0; round < testing::fewer(240); ++round) {
    const int cols = 2 + static_cast<int>(random() % 40), rows = 2 + static_cast<int>(random() % 80);
    Terrain terrain = random_terrain(cols, rows, round % 4 == 0 ? 0 : 0.25, random);
    if (round % 3 == 1) terrain.frame = rotated_frame();
    if (round % 3 == 2) terrain.frame = south_up_frame();
    const Mesh mesh = random_soup(terrain, 1 + static_cast<int>(random() % 30), round % 2 == 0, random);
    const Judged oracle = ask_oracle(terrain, mesh);
    if (!oracle.is_clear_cut) continue;
    ++judged;
    SCOPED_TRACE(round);
    MeasureOptions options;
    options.run.threads = 1 + round % 3;
    expect_agreement(oracle, judge_by_rows(terrain.view(), mesh, options), cols);
    terrain.frame = dress_up(terrain.frame);
    // Noise may put a sample on a common side into only one of two triangles; heights of a soup then differ.
    if (round % 2 == 1) expect_agreement(oracle, judge_by_rows(terrain.view(), mesh, options), cols);
    if (HasFatalFailure()) return;
  }
  EXPECT_GT(judged, testing::fewer(150));
}

TEST(Measure, GivesTheSameAnswersInADressedUpFrame) {
  for (const Frame& frame : {grid_frame(61), rotated_frame(), south_up_frame()}) {
    Terrain terrain = wavy_terrain(49, 61);
    terrain.frame = frame;
    const Mesh mesh = grid_mesh(terrain, 4);
    for (int hole = 0; hole < 40; ++hole) terrain.at(hole * 7 % 49, hole * 13 % 61) = NAN;
    const Verdict grid = judge_by_rows(terrain.view(), mesh);
    terrain.frame = dress_up(frame);
    const Verdict dressed = judge_by_rows(terrain.view(), mesh);
    EXPECT_EQ(grid.numbers.samples, dressed.numbers.samples);
    EXPECT_EQ(grid.numbers.uncovered, 0u);
    EXPECT_EQ(dressed.numbers.uncovered, 0u);
    EXPECT_EQ(grid.numbers.stray, dressed.numbers.stray);
    EXPECT_GT(grid.numbers.nodata_cells_covered, 0u);
    EXPECT_EQ(grid.numbers.nodata_cells_covered, dressed.numbers.nodata_cells_covered);
    EXPECT_NEAR(grid.numbers.max_error, dressed.numbers.max_error, 1e-6);
    EXPECT_NEAR(grid.numbers.rmse, dressed.numbers.rmse, 1e-6);
    ASSERT_EQ(grid.errors.size(), dressed.errors.size());
    for (std::size_t i = 0; i < grid.errors.size(); ++i) {
      ASSERT_EQ(std::isnan(grid.errors[i]), std::isnan(dressed.errors[i]));
      if (std::isnan(grid.errors[i])) continue;
      ASSERT_NEAR(grid.errors[i], dressed.errors[i], 1e-5);
    }
  }
}

TEST(Measure, FindsThatAFullMeshReproducesEverySample) {
  for (const Frame& frame : {grid_frame(40), rotated_frame(), south_up_frame()}) {
    Terrain terrain = wavy_terrain(33, 40);
    terrain.frame = frame;
    const auto result = measure(terrain.view(), grid_mesh(terrain, 1));
    ASSERT_TRUE(result);
    EXPECT_EQ(result->samples, 33u * 40);
    EXPECT_EQ(result->uncovered, 0u);
    EXPECT_EQ(result->max_error, 0);
    EXPECT_EQ(result->p999, 0);
    EXPECT_TRUE(result->is_sound());
  }
}

// A tilted plane has no error, although no weight times height is a round number.
TEST(Measure, RoundsErrorsCorrectly) {
  Terrain terrain = wavy_terrain(31, 31);
  for (int r = 0; r < 31; ++r) {
    for (int c = 0; c < 31; ++c)
      terrain.at(c, r) = 1000.25f + static_cast<float>(c) * 0.375f - static_cast<float>(r) * 7.125f;
  }
  const Mesh mesh = grid_mesh(terrain, 30);
  EXPECT_EQ(measure(terrain.view(), mesh)->max_error, 0);
  terrain.at(11, 17) += 0.5f;
  const auto result = measure(terrain.view(), mesh);
  EXPECT_EQ(result->max_error, 0.5);
  EXPECT_EQ(result->max_error_at, (std::array<std::int32_t, 2>{11, 17}));
  EXPECT_EQ(result->p95, 0);
}

TEST(Measure, SettlesQuotientsToTheLastBit) {
  // (1·0.1 + 2·0.2) / 3 − 0.3 with float32 heights, by hand in 128-bit integers.
  const float a = 0.1f, b = 0.2f, s = 0.3f;
  const auto bits = [](float value) { return static_cast<__int128>(std::ldexp(static_cast<double>(value), 40)); };
  const __int128 numerator = bits(a) + 2 * bits(b) - 3 * bits(s);
  const double expected = std::ldexp(static_cast<double>(static_cast<long double>(numerator) / 3), -40);
  EXPECT_EQ(judge::settle_error({1, 2, 0}, {a, b, 77}, s), expected);
  EXPECT_EQ(judge::settle_error({3, 0, 0}, {a, b, 77}, a), 0);
  EXPECT_EQ(judge::settle_error({1e9, 2e9, 3e9}, {1e-3, 1e-3, 1e-3}, 1e-3), 0);
}

TEST(Measure, KeepsItsPrecisionFarFromTheOrigin) {
  Terrain terrain = wavy_terrain(65, 65);
  terrain.frame.affine = {500000.5, 1, 0, 4649776.5, 0, -1};
  Mesh mesh = grid_mesh(terrain, 8);
  const auto absolute = measure(terrain.view(), mesh);
  terrain.frame = grid_frame(65);
  const auto local = measure(terrain.view(), grid_mesh(terrain, 8));
  EXPECT_EQ(absolute->max_error, local->max_error);
  EXPECT_EQ(absolute->rmse, local->rmse);
  EXPECT_EQ(absolute->uncovered, 0u);
}

TEST(Measure, IsBitEqualWithAnyNumberOfThreads) {
  std::mt19937 random(3);
  const Terrain terrain = random_terrain(300, 700, 0.02, random);
  const Mesh mesh = random_soup(terrain, 400, true, random);
  MeasureOptions options;
  options.collect_above = 60;
  const Verdict one = judge_by_rows(terrain.view(), mesh, options);
  EXPECT_FALSE(one.numbers.offenders.empty());
  for (const int threads : {2, 5}) {
    options.run.threads = threads;
    const Verdict many = judge_by_rows(terrain.view(), mesh, options);
    const Measurement &a = one.numbers, &b = many.numbers;
    EXPECT_EQ(0, std::memcmp(one.errors.data(), many.errors.data(), one.errors.size() * sizeof(float)));
    EXPECT_EQ(a.max_error, b.max_error);
    EXPECT_EQ(a.max_error_at, b.max_error_at);
    EXPECT_EQ(a.rmse, b.rmse);
    EXPECT_EQ(a.mean_error, b.mean_error);
    EXPECT_EQ(a.mean_abs_error, b.mean_abs_error);
    EXPECT_EQ(a.p50, b.p50);
    EXPECT_EQ(a.p999, b.p999);
    EXPECT_EQ(a.uncovered, b.uncovered);
    EXPECT_EQ(a.nodata_cells_covered, b.nodata_cells_covered);
    EXPECT_EQ(a.overlaps, b.overlaps);
    ASSERT_EQ(a.offenders.size(), b.offenders.size());
    for (std::size_t i = 0; i < a.offenders.size(); ++i) {
      EXPECT_EQ(a.offenders[i].col, b.offenders[i].col);
      EXPECT_EQ(a.offenders[i].row, b.offenders[i].row);
      EXPECT_EQ(a.offenders[i].error, b.offenders[i].error);
    }
  }
}

TEST(Measure, TakesInfinitiesAsNodata) {
  Terrain terrain = wavy_terrain(9, 9);
  const Mesh mesh = grid_mesh(terrain, 8);
  terrain.at(3, 3) = HUGE_VALF;
  terrain.at(5, 5) = -9999;
  HeightField field = terrain.view();
  field.nodata = -9999.0f;
  const auto result = measure(field, mesh);
  EXPECT_EQ(result->samples, 79u);
  EXPECT_LT(result->max_error, 50);
  EXPECT_EQ(result->nodata_cells_covered, 8u);
}

TEST(Measure, NamesTheWorstSampleOfEachTriangle) {
  Terrain terrain = wavy_terrain(9, 9);
  std::fill(terrain.samples.begin(), terrain.samples.end(), 0.0f);
  const Mesh mesh = grid_mesh(terrain, 8);  // a: upper left, b: lower right
  terrain.at(1, 1) = 3;
  terrain.at(2, 1) = 4;
  terrain.at(7, 7) = -2;
  MeasureOptions options;
  options.collect_above = 2;
  auto result = measure(terrain.view(), mesh, options);
  ASSERT_EQ(result->offenders.size(), 1u);
  EXPECT_EQ(result->offenders[0].col, 2);
  EXPECT_EQ(result->offenders[0].row, 1);
  EXPECT_EQ(result->offenders[0].error, -4);
  options.collect_above = 1.5;
  EXPECT_EQ(measure(terrain.view(), mesh, options)->offenders.size(), 2u);

  Mesh half = mesh;
  half.triangles.resize(3);
  options.collect_above = 10;
  result = measure(terrain.view(), half, options);
  EXPECT_EQ(result->uncovered, 36u);
  ASSERT_EQ(result->offenders.size(), 36u);
  EXPECT_EQ(result->offenders[0].error, HUGE_VAL);
}

TEST(Measure, FailsCleanly) {
  const Terrain terrain = wavy_terrain(5, 5);
  const Mesh good = grid_mesh(terrain, 4);
  const auto kind = [&](const HeightField& field, const Mesh& mesh) {
    const auto result = measure(field, mesh);
    EXPECT_FALSE(result);
    return result ? ErrorKind::kInternal : result.error().kind;
  };
  Mesh mesh = good;
  mesh.triangles[1] = 4;
  EXPECT_EQ(kind(terrain.view(), mesh), ErrorKind::kInput);
  mesh = good;
  mesh.positions[4] = NAN;
  EXPECT_EQ(kind(terrain.view(), mesh), ErrorKind::kInput);
  for (const double huge : {1e101, -1e160, 1e300}) {
    mesh = good;
    mesh.positions[3] = huge;
    EXPECT_EQ(kind(terrain.view(), mesh), ErrorKind::kInput);
    mesh = good;
    mesh.origin[1] = huge;
    EXPECT_EQ(kind(terrain.view(), mesh), ErrorKind::kInput);
  }
  HeightField tiny = terrain.view();
  tiny.frame.affine = {0, 1e-150, 0, 0, 0, -1e-150};
  const auto far = measure(tiny, good);
  ASSERT_FALSE(far);
  EXPECT_NE(far.error().message.find("vertex 0 of the mesh lies more than 1e100 cells"), std::string::npos);
  mesh = good;
  mesh.triangles.clear();
  EXPECT_EQ(kind(terrain.view(), mesh), ErrorKind::kInput);
  HeightField narrow = terrain.view();
  narrow.cols = 1;
  EXPECT_EQ(kind(narrow, good), ErrorKind::kInput);
  HeightField flat = terrain.view();
  flat.frame.affine = {0, 1, 1, 0, 1, 1};
  EXPECT_EQ(kind(flat, good), ErrorKind::kInput);
}

TEST(Measure, TakesCoordinatesUpToItsLimit) {
  const Terrain terrain = wavy_terrain(5, 5);
  for (const bool dressed : {false, true}) {
    HeightField field = terrain.view();
    if (dressed) field.frame = dress_up(field.frame);
    for (const double huge : {1e16, 1e60, 1e100}) {
      Mesh mesh = grid_mesh(terrain, 4);
      for (int k = 0; k < 3; ++k) mesh.positions[3 + k] = huge;
      const auto result = measure(field, mesh);
      ASSERT_TRUE(result);
      EXPECT_EQ(result->samples + result->uncovered, 25u);
    }
  }
}

TEST(Measure, SeesAShiftFarBelowACell) {
  // A slope of 1000 per cell turns a shift of 1.9e-6 cells into an error of 0.0019.
  Terrain terrain{{}, 1500, 500, grid_frame(500)};
  for (int i = 0; i < 1500 * 500; ++i) terrain.samples.push_back(static_cast<float>(i % 1500) * 1000);
  for (const double cell : {1.0, 30.0}) {
    terrain.frame.affine = {5e5, cell, 0, 4e6, 0, -cell};
    Mesh mesh;
    mesh.origin = {5e5, 4e6, 0};
    for (int k = 0; k < 4; ++k) add_vertex(mesh, terrain.frame, (k % 2) * 1499, (k / 2) * 499, (k % 2) * 1499e3);
    mesh.triangles = {0, 2, 1, 1, 2, 3};
    EXPECT_EQ(measure(terrain.view(), mesh)->max_error, 0);
    for (std::size_t v = 0; v < 4; ++v) mesh.positions[3 * v] -= 1.9e-6 * cell;
    MeasureOptions heights_only;
    heights_only.topology = false;
    const auto shifted = measure(terrain.view(), mesh, heights_only);
    EXPECT_NEAR(shifted->max_error, 0.0019, 1e-5);
  }
}

// If buckets also spread over the far vertex, all triangles would share one, and this would need minutes.
TEST(Measure, IsNotSlowedDownByAVertexFarAway) {
  const Terrain terrain = wavy_terrain(129, 129);
  HeightField field = terrain.view();
  Mesh mesh = grid_mesh(terrain, 1);
  field.frame = dress_up(field.frame);
  const auto near = measure(field, mesh);
  mesh.positions.insert(mesh.positions.end(), {1e7, 1e7, 0});
  const auto far = measure(field, mesh);
  EXPECT_EQ(far->max_error, near->max_error);
  EXPECT_EQ(far->uncovered, 0u);
  EXPECT_TRUE(far->is_sound());
}

TEST(Measure, CanBeCancelled) {
  const Terrain terrain = wavy_terrain(5, 5);
  for (const std::string_view stop : {"measure", "topology"}) {
    MeasureOptions options;
    options.run.progress = [&](const Progress& progress) { return progress.pass != stop; };
    const auto result = measure(terrain.view(), grid_mesh(terrain, 4), options);
    ASSERT_FALSE(result);
    EXPECT_EQ(result.error().kind, ErrorKind::kCancelled);
  }
}

}  // namespace
}  // namespace scarp::testing
