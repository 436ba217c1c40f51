// All pairs of settings, in memory and streamed: each runs and is proven, or the table of conflicts refuses it.
#include <gtest/gtest.h>

#include <cmath>
#include <functional>
#include <iostream>
#include <memory>
#include <string>
#include <vector>

#include "laws/array_bounds.h"
#include "laws/array_source.h"
#include "laws/ball.h"
#include "laws/fields.h"
#include "laws/sanitized.h"
#include "pieces/conflicts.h"
#include "scarp/features.h"
#include "scarp/paper.h"
#include "scarp/simplify.h"

namespace scarp::conflicts_laws_test {
namespace {

constexpr double kError = 4;
constexpr std::uint64_t kTriangles = 1500, kFewTriangles = 900;
constexpr float kTolerance = 6, kTightTolerance = 0.02f;

/// Bends straight lines.
class Bend : public PointTransform {
 public:
  bool apply(std::span<double> x, std::span<double> y) const override {
    for (std::size_t k = 0; k < x.size(); ++k) {
      const double u = x[k], v = y[k];
      x[k] = 10 * u + 1e-3 * v * v;
      y[k] = 10 * v - 2e-3 * u * u;
    }
    return true;
  }
};

/// Land with a wall, and with nodata.
testing::Field make_land() {
  testing::Field land = testing::random_field(17, 40, 30, testing::Relief::kRidges, 0.01);
  for (std::int32_t y = 0; y < land.rows; ++y) {
    for (std::int32_t x = 0; x < land.cols; ++x) {
      if (3 * x + y > 90) land.samples[static_cast<std::size_t>(y * land.cols + x)] += 120;
    }
  }
  for (const std::size_t k : {12 * 40 + 11, 14 * 40 + 13}) land.samples[k] = 20;
  return land;
}

/// The common parts of all runs, with the field and options of one.
struct Scene {
  testing::Field land = make_land();
  std::vector<float> mask = std::vector<float>(land.samples.size(), 0.5f);
  std::vector<float> tolerance = std::vector<float>(land.samples.size(), kTolerance);
  std::vector<float> colours = land.samples;
  testing::ArraySource source{land.view()};
  testing::ArrayBounds bounds{tolerance, 40}, weights{mask, 40};
  std::vector<SampleAt> ignored{{11, 12}};
  HeightField field = land.view();
  SimplifyOptions options;
  Strategy strategy;
  Levels levels;

  pieces::Fields fields() const {
    pieces::Fields fields = pieces::fields_of(field, options);
    if (!(strategy == Strategy{})) fields.add(pieces::Field::kStrategy);
    if (levels.count > 1) fields.add(pieces::Field::kLevels);
    return fields;
  }
  /// REQUIRES: no conflict if there is a strategy, since its options cannot express one.
  Result<Simplified> run() const {
    if (levels.count > 1) {
      auto made = simplify_levels(field, options, levels);
      return made ? Result<Simplified>(std::move(made->front())) : tl::unexpected(made.error());
    }
    if (strategy == Strategy{}) return simplify(field, options);
    return simplify_by_paper(field, {options.goals, options.tolerances, options.features.points, options.domain,
                                     options.output, strategy, options.run});
  }
};

/// Each kind of strategy.
std::vector<Strategy> all_strategies() {
  return {{.importance = {.feature = Importance::Feature::kCurvature}},
          {.importance = {false, Importance::Feature::kLocal4, Importance::Damping::kUndamped, true}},
          {.algorithm = Algorithm::kLocal},
          {.batch = {.rule = Batch::Rule::kIndependent}},
          {.edges = {.data_dependent = true}},
          {.best_of_budget = false}};
}

Line line_through(std::vector<std::array<double, 3>> points, LineKind kind = LineKind::kBreakline) {
  Line line;
  line.points = std::move(points);
  line.kind = kind;
  return line;
}

void add_lines(Scene& scene, std::vector<Line> lines) {
  auto& all = scene.options.features.breaklines.lines;
  all.insert(all.end(), lines.begin(), lines.end());
}

Line some_line() { return line_through({{2.5, 3.25, NAN}, {20.5, 11.75, NAN}}); }

struct Setting {
  pieces::Field field;
  std::function<void(Scene&)> set;
};

std::vector<Setting> all_settings() {
  constexpr auto kWithout = [](Scene&) {};
  return {
      {pieces::Field::kMaxError, [](Scene& s) { s.options.goals.max_error = kError; }},
      {pieces::Field::kMaxTriangles, [](Scene& s) { s.options.goals.max_triangles = kTriangles; }},
      {pieces::Field::kMaxVertices, [](Scene& s) { s.options.goals.max_vertices = kTriangles / 2; }},
      {pieces::Field::kOutlineTolerance, [](Scene& s) { s.options.domain.outline_tolerance = 1; }},
      {pieces::Field::kBorder, [](Scene& s) { s.options.domain.border.is_locked = true; }},
      {pieces::Field::kDoublePositions, [](Scene& s) { s.options.output.float32_positions = false; }},
      {pieces::Field::kMask, [](Scene& s) { s.options.tolerances.weights = s.mask; }},
      {pieces::Field::kMaskSource, [](Scene& s) { s.options.tolerances.weights_source = &s.weights; }},
      {pieces::Field::kTolerance, [](Scene& s) { s.options.tolerances.values = s.tolerance; }},
      {pieces::Field::kToleranceSource, [](Scene& s) { s.options.tolerances.source = &s.bounds; }},
      {pieces::Field::kBreaklines, [](Scene& s) { add_lines(s, {some_line()}); }},
      {pieces::Field::kWalls,
       [](Scene& s) {
         add_lines(s, detect_cliffs(s.land.view(), {60, kError})->lines);
       }},
      {pieces::Field::kRidges,
       [](Scene& s) {
         add_lines(s, {line_through({{4, 20, NAN}, {9, 25, NAN}}, LineKind::kRidge)});
       }},
      {pieces::Field::kCutline,
       [](Scene& s) {
         Line ring =
             line_through({{1.5, 1.5, NAN}, {37.5, 2.5, NAN}, {36.5, 27.5, NAN}, {2.5, 26.5, NAN}, {1.5, 1.5, NAN}});
         ring.polygon = 0;
         ring.role = LineRole::kOuter;
         s.options.features.cutline.rings = {ring};
       }},
      {pieces::Field::kIgnored, [](Scene& s) { s.options.tolerances.ignored = s.ignored; }},
      {pieces::Field::kPoints,
       [](Scene& s) {
         s.options.features.points.push_back({13, 14});
       }},
      {pieces::Field::kOrderGreedy, [](Scene& s) { s.options.quality.order = Order::kGreedy; }},
      {pieces::Field::kOrderDominant, [](Scene& s) { s.options.quality.order = Order::kDominant; }},
      {pieces::Field::kEffortFast, [](Scene& s) { s.options.quality.effort = Effort::kFast; }},
      {pieces::Field::kEffortNormal, [](Scene& s) { s.options.quality.effort = Effort::kNormal; }},
      {pieces::Field::kEffortHigh, [](Scene& s) { s.options.quality.effort = Effort::kHigh; }},
      {pieces::Field::kEffortMax, [](Scene& s) { s.options.quality.effort = Effort::kMax; }},
      {pieces::Field::kVerticesSamples, [](Scene& s) { s.options.quality.vertices = Vertices::kSamples; }},
      {pieces::Field::kVerticesFree,
       [](Scene& s) {
         s.options.quality.vertices = Vertices::kFree;
         if (s.options.quality.effort == Effort::kAuto) s.options.quality.effort = Effort::kHigh;
       }},
      {pieces::Field::kMinShape, [](Scene& s) { s.options.quality.min_shape = 0.1; }},
      {pieces::Field::kShape, [](Scene& s) { s.options.quality.shape.min_angle = 15; }},
      {pieces::Field::kTimeLimit, [](Scene& s) { s.options.run.is_time_up = [] { return false; }; }},
      {pieces::Field::kEnough, [](Scene& s) { s.options.run.is_enough = [] { return false; }; }},
      {pieces::Field::kObjectiveRms, [](Scene& s) { s.options.goals.objective = Objective::kRms; }},
      {pieces::Field::kStrategy, [](Scene& s) { s.strategy.edges.data_dependent = true; }},
      {pieces::Field::kLevels,
       [](Scene& s) {
         s.levels.count = 2;
         s.options.domain.border.is_locked = true;
       }},
      {pieces::Field::kNorm, [](Scene& s) { s.options.goals.norm = Norm::kMax; }},
      {pieces::Field::kLattice, [](Scene& s) { s.options.output.lattice = true; }},
      {pieces::Field::kUvs, [](Scene& s) { s.options.output.uvs = true; }},
      {pieces::Field::kNormals, [](Scene& s) { s.options.output.normals = true; }},
      {pieces::Field::kThreads, [](Scene& s) { s.options.run.threads = 2; }},
      {pieces::Field::kMemoryLimit, [](Scene& s) { s.options.run.memory.limit = 1'000'000'000; }},
      {pieces::Field::kChannels,
       [](Scene& s) {
         s.field.channels = {{s.colours.data(), 0.25}};
       }},
      {pieces::Field::kCurvedFrame,
       [](Scene& s) {
         s.field.frame = grid_frame(30);
         s.field.frame.kind = Frame::Kind::kProjected;
         s.field.frame.transform = std::make_shared<Bend>();
       }},
      {pieces::Field::kSpaceFrame, [](Scene& s) { s.field.frame = testing::ball_frame(10, 50, 0.01, 40, 30); }},
      {pieces::Field::kSource, kWithout},
  };
}

/// The allowed error of each sample; +infinity: no bound. With a budget, tolerances have a factor.
std::vector<float> bounds_of(const Scene& scene, bool keeps_error, double factor, double tolerance) {
  const SimplifyOptions& options = scene.options;
  const bool has_tolerance = !options.tolerances.values.empty() || options.tolerances.source != nullptr;
  double bound =
      (keeps_error || has_tolerance) && options.goals.max_error ? factor * *options.goals.max_error : HUGE_VAL;
  if (has_tolerance) bound = std::min(bound, tolerance * factor);
  if (!options.tolerances.weights.empty() || options.tolerances.weights_source != nullptr) bound /= 0.5;
  std::vector<float> bounds(scene.land.samples.size(), static_cast<float>(bound * 1.000001 + 1e-5));
  for (const auto& [col, row] : options.tolerances.ignored)
    bounds[static_cast<std::size_t>(row * 40 + col)] = testing::kNoBound;
  return bounds;
}

/// Checks with the judge and the requested bound.
void expect_kept(const Scene& scene, const Simplified& made, double tolerance = kTolerance) {
  testing::Field land = scene.land;
  for (const SampleEdit& edit : made.edits)
    land.samples[static_cast<std::size_t>(edit.row * 40 + edit.col)] = edit.after;
  HeightField field = scene.field;
  field.samples = land.samples.data();
  field.source = nullptr;
  const SimplifyOptions& options = scene.options;
  const bool keeps_error = made.stop == StopReason::kMaxError;
  EXPECT_GE(made.tolerance_factor, 1);
  EXPECT_EQ(keeps_error && made.tolerance_factor > 1, false);
  const std::vector<float> bounds = bounds_of(scene, keeps_error, made.tolerance_factor, tolerance);
  MeasureOptions judge;
  judge.tolerance = bounds;
  judge.cutline = options.features.cutline.rings.empty() ? nullptr : &options.features.cutline;
  const auto m = measure(field, made.mesh, judge);
  ASSERT_TRUE(m) << m.error().message;
  EXPECT_EQ(m->over_tolerance, 0u);
  EXPECT_EQ(m->uncovered, 0u);
  EXPECT_TRUE(m->is_sound());
  EXPECT_LE(made.mesh.triangle_count(), options.goals.max_triangles.value_or(1u << 30));
  EXPECT_LE(made.mesh.vertex_count(), options.goals.max_vertices.value_or(1u << 30));
  const bool is_norm = !field.channels.empty() && options.tolerances.weights.empty() &&
                       options.tolerances.ignored.empty() && keeps_error;
  EXPECT_LE(made.combined_max_error, is_norm ? options.goals.max_error.value_or(HUGE_VAL) * 1.000001 : HUGE_VAL);
  for (const auto& [col, row] : options.features.points) {
    if (!field.frame.is_affine()) continue;
    bool is_vertex = false;
    for (std::size_t v = 0; v < made.mesh.vertex_count(); ++v) {
      const auto at = made.mesh.vertex(v);
      is_vertex = is_vertex || (at[0] == col && at[1] == 29 - row);
    }
    EXPECT_TRUE(is_vertex);
  }
  EXPECT_EQ(made.mesh.normals.size(), options.output.normals ? made.mesh.positions.size() : 0u);
}

/// True if one setting implies the other.
bool brings(pieces::Field one, pieces::Field other) {
  return ((one == pieces::Field::kWalls || one == pieces::Field::kRidges) && other == pieces::Field::kBreaklines) ||
         (one == pieces::Field::kLevels && other == pieces::Field::kBorder) ||
         (one == pieces::Field::kSpaceFrame && other == pieces::Field::kCurvedFrame);
}

bool names(const pieces::Conflict& conflict, pieces::Field one, pieces::Field other) {
  const auto is = [](pieces::Field named, pieces::Field setting) { return named == setting || brings(setting, named); };
  return (is(conflict.one, one) && is(conflict.other, other)) || (is(conflict.one, other) && is(conflict.other, one));
}

/// Goals with which two settings may be combined.
const pieces::Field kGoals[] = {pieces::Field::kMaxError, pieces::Field::kMaxTriangles};

/// Runs a pair with the first goal that allows it. True if all goals refuse it.
bool is_refused(const Setting& one, const Setting& other, bool is_streamed) {
  bool is_named = false;
  for (const pieces::Field goal : kGoals) {
    Scene scene;
    scene.options.run.threads = 1;
    all_settings()[static_cast<std::size_t>(goal)].set(scene);
    one.set(scene);
    other.set(scene);
    if (scene.options.goals.objective == Objective::kRms && goal == pieces::Field::kMaxError)
      scene.options.goals.max_triangles = kTriangles;
    if (is_streamed) scene.field = testing::with_source(scene.field, scene.source);
    const auto conflicts = pieces::find_conflicts(scene.fields());
    if (conflicts.empty()) {
      const auto strategies = scene.strategy == Strategy{} ? std::vector<Strategy>(1) : all_strategies();
      for (const Strategy& strategy : strategies) {
        scene.strategy = strategy;
        const auto made = scene.run();
        EXPECT_TRUE(made) << made.error().message;
        if (made) expect_kept(scene, *made);
      }
      return false;
    }
    for (const pieces::Conflict& conflict : conflicts) is_named = is_named || names(conflict, one.field, other.field);
    if (!(scene.strategy == Strategy{})) continue;
    const auto made = scene.run();
    EXPECT_FALSE(made);
    if (made) return false;
    EXPECT_EQ(made.error().kind, ErrorKind::kUsage);
    EXPECT_EQ(made.error().message, pieces::describe(conflicts.front()));
  }
  EXPECT_TRUE(is_named);
  return true;
}

bool is_alone_refused(const Setting& setting) {
  Scene scene;
  setting.set(scene);
  for (const pieces::Conflict& conflict :
       pieces::find_conflicts(scene.fields() | pieces::Fields(pieces::Field::kSource))) {
    if (conflict.one == pieces::Field::kSource || conflict.other == pieces::Field::kSource) return true;
  }
  return false;
}

/// The run searches for a factor of all tolerances, or the table explains the refusal.
void expect_within_a_tight_budget(const Setting& setting, bool is_streamed) {
  SCOPED_TRACE(std::string(pieces::name_of(setting.field)) + (is_streamed ? ", streamed" : ", in memory"));
  Scene scene;
  scene.options.run.threads = 1;
  setting.set(scene);
  scene.options.goals.max_triangles = kFewTriangles;
  scene.tolerance.assign(scene.tolerance.size(), kTightTolerance);
  if (is_streamed) scene.field = testing::with_source(scene.field, scene.source);
  if (is_streamed) scene.options.tolerances.source = &scene.bounds;
  if (!is_streamed) scene.options.tolerances.values = scene.tolerance;
  const auto conflicts = pieces::find_conflicts(scene.fields());
  if (!(scene.strategy == Strategy{}) && !conflicts.empty()) return;
  const auto made = scene.run();
  EXPECT_EQ(made.has_value(), conflicts.empty()) << (made ? "" : made.error().message);
  if (!made) return;
  EXPECT_EQ(made->stop, StopReason::kMaxTriangles);
  EXPECT_GT(made->tolerance_factor, 1);
  expect_kept(scene, *made, kTightTolerance);
}

/// Sanitized builds run a twentieth of the pairs, and a fifth of the settings with two others.
constexpr std::size_t kPairStep = testing::kIsSanitized ? 20 : 1, kSettingStep = testing::kIsSanitized ? 5 : 1;

TEST(conflicts, settings_beside_tolerances_and_a_budget_run_or_are_refused_by_the_table) {
  const auto settings = all_settings();
  for (std::size_t k = 0; k < settings.size(); k += kSettingStep) {
    const Setting& setting = settings[k];
    if (setting.field == pieces::Field::kMask || setting.field == pieces::Field::kTolerance ||
        setting.field == pieces::Field::kSource || setting.field == pieces::Field::kToleranceSource)
      continue;
    expect_within_a_tight_budget(setting, false);
    if (!is_alone_refused(setting)) expect_within_a_tight_budget(setting, true);
  }
}

TEST(conflicts, every_pair_in_memory_runs_or_is_refused_by_the_table) {
  const auto settings = all_settings();
  int pairs = 0, refused = 0, of_strategies = 0;
  for (std::size_t k = 0; k < settings.size(); ++k) {
    ASSERT_EQ(static_cast<std::size_t>(settings[k].field), k);
    for (std::size_t n = k + 1 + k % kPairStep; n < settings.size(); n += kPairStep) {
      const pieces::Field one = settings[k].field, other = settings[n].field;
      const pieces::Fields streamed(pieces::Field::kMaskSource, pieces::Field::kToleranceSource,
                                    pieces::Field::kSource);
      if (streamed.has(one) || streamed.has(other)) continue;
      SCOPED_TRACE(std::string(pieces::name_of(one)) + " and " + std::string(pieces::name_of(other)));
      // Two values of one field.
      Scene a, b, both;
      settings[k].set(a), settings[n].set(b), settings[k].set(both), settings[n].set(both);
      if (!both.fields().has(one)) continue;
      ++pairs;
      if (!is_refused(settings[k], settings[n], false)) continue;
      ++refused;
      of_strategies += one == pieces::Field::kStrategy || other == pieces::Field::kStrategy;
    }
  }
  RecordProperty("pairs", pairs);
  RecordProperty("refused", refused);
  RecordProperty("refused_of_strategies", of_strategies);
  std::cout << refused << " of " << pairs << " pairs are refused in memory, " << of_strategies
            << " of them beside a strategy of the 1995 paper\n";
}

TEST(conflicts, every_pair_of_streamed_samples_runs_or_is_refused_by_the_table) {
  const auto settings = all_settings();
  int pairs = 0, refused = 0, alone = 0, more = 0;
  for (std::size_t k = 0; k < settings.size(); ++k) {
    const pieces::Field one = settings[k].field;
    if (one == pieces::Field::kSource) continue;
    if (is_alone_refused(settings[k])) {
      ++alone;
      SCOPED_TRACE(std::string(pieces::name_of(one)));
      EXPECT_TRUE(is_refused(settings[k], settings[static_cast<std::size_t>(pieces::Field::kSource)], true));
      continue;
    }
    for (std::size_t n = k + 1 + k % kPairStep; n < settings.size(); n += kPairStep) {
      const pieces::Field other = settings[n].field;
      if (other == pieces::Field::kSource || is_alone_refused(settings[n])) continue;
      SCOPED_TRACE(std::string(pieces::name_of(one)) + " and " + std::string(pieces::name_of(other)));
      Scene both;
      settings[k].set(both), settings[n].set(both);
      if (!both.fields().has(one)) continue;
      ++pairs;
      if (!is_refused(settings[k], settings[n], true)) continue;
      ++refused;
      const pieces::Fields sources(pieces::Field::kMaskSource, pieces::Field::kToleranceSource);
      more += pieces::find_conflicts(pieces::Fields(one, other)).empty() || sources.has(one) || sources.has(other);
    }
  }
  RecordProperty("pairs", pairs);
  RecordProperty("refused", refused);
  RecordProperty("refused_streamed_only", more);
  RecordProperty("settings_refused_alone", alone);
  std::cout << refused << " of " << pairs << " pairs are refused where samples are streamed, " << more
            << " of them there only; " << alone << " settings are refused alone\n";
}

}  // namespace
}  // namespace scarp::conflicts_laws_test
