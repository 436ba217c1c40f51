// Section 3: what is worth inserting. One mesh maker, different choices of samples, 1 % of them.
#include <fmt/format.h>

#include <algorithm>
#include <set>
#include <utility>

#include "paper/study.h"

namespace scarp::paper {
namespace {

using Feature = Importance::Feature;
using Damping = Importance::Damping;

constexpr std::uint64_t kSeed = 1995, kOtherDraws = 5;

struct Selector {
  const char* name;
  const SelectorFigures* figures;  ///< null: Scape was not measured
  Importance importance = {};
  enum class Choice { kImportance, kUniform, kRandom } choice = Choice::kImportance;
};

Importance one_pass(Feature feature) { return {false, feature, Damping::kUndamped, true}; }
Importance product(Feature feature, Damping damping) { return {true, feature, damping, false}; }

std::vector<Selector> list_selectors() {
  return {{"global error", &kGlobal},
          {"uniform sub-grid", &kUniform, {}, Selector::Choice::kUniform},
          {"random points", &kRandom, {}, Selector::Choice::kRandom},
          {"one pass, local error, 4 neighbours", &kOnePassLocal4, one_pass(Feature::kLocal4)},
          {"one pass, local error, 8 neighbours", &kOnePassLocal8, one_pass(Feature::kLocal8)},
          {"one pass, curvature", &kOnePassCurvature, one_pass(Feature::kCurvature)},
          {"global × local error", &kTimesLocal, product(Feature::kLocal4, Damping::kUndamped)},
          {"global × (local error + 1)", &kTimesLocalPlusOne, product(Feature::kLocal4, Damping::kPlusOne)},
          {"global × curvature", &kTimesCurvature, product(Feature::kCurvature, Damping::kUndamped)},
          {"global × (curvature + 1)", &kTimesCurvaturePlusOne, product(Feature::kCurvature, Damping::kPlusOne)},
          {"global × √(curvature + 1)", &kTimesRootCurvature, product(Feature::kCurvature, Damping::kSqrtPlusOne)},
          {"attenuated: global × distance", nullptr, product(Feature::kDistance, Damping::kUndamped)},
          {"attenuated: global × √(distance + 1)", nullptr, product(Feature::kDistance, Damping::kSqrtPlusOne)}};
}

/// The corners, and other samples drawn at random without repetition (splitmix64: the same on every machine).
std::vector<SampleAt> random_points(const OwnedHeightField& field, std::uint64_t vertices, std::uint64_t seed) {
  std::vector<SampleAt> steps;
  std::set<std::uint64_t> drawn;
  const auto add = [&](std::uint64_t sample) {
    const auto cols = static_cast<std::uint64_t>(field.cols);
    if (drawn.insert(sample).second) {
      steps.push_back({static_cast<std::int32_t>(sample % cols), static_cast<std::int32_t>(sample / cols)});
    }
  };
  const std::uint64_t count = field.samples.size(), cols = static_cast<std::uint64_t>(field.cols);
  for (const std::uint64_t corner : {std::uint64_t{0}, cols - 1, count - cols, count - 1}) add(corner);
  for (std::uint64_t state = seed; steps.size() < std::min(vertices, count);) {
    state += 0x9e3779b97f4a7c15u;
    std::uint64_t h = state;
    h = (h ^ (h >> 30)) * 0xbf58476d1ce4e5b9u;
    h = (h ^ (h >> 27)) * 0x94d049bb133111ebu;
    add((h ^ (h >> 31)) % count);
  }
  return steps;
}

Result<Trial> run(Study& study, const Field& field, const Selector& selector) {
  const std::uint64_t vertices = std::max<std::uint64_t>(field.share(1), 4);
  PaperOptions options;
  if (selector.choice == Selector::Choice::kRandom) {
    options.points = random_points(field.heights, vertices, kSeed);
    return study.refine(field, options.points.size(), options);
  }
  if (selector.choice == Selector::Choice::kUniform) {
    options.points = uniform_grid(field.heights.cols, field.heights.rows, vertices).steps;
    return study.refine(field, options.points.size(), options);
  }
  if (selector.importance == Importance{}) return study.delaunay(field, vertices);
  options.strategy.importance = selector.importance;
  return study.refine(field, vertices, options);
}

struct Row {
  const Selector* selector;
  std::vector<Trial> trials;  ///< one a field
};

/// How much chance there is in random points: errors of further draws.
Result<std::string> try_other_draws(const Study& study, const Field& field) {
  double least = 0, most = 0, least_max = 0, most_max = 0;
  for (std::uint64_t draw = 1; draw <= kOtherDraws; ++draw) {
    PaperOptions options;
    options.points = random_points(field.heights, std::max<std::uint64_t>(field.share(1), 4), kSeed + draw);
    SCARP_TRY(const Trial& trial, study.refine(field, options.points.size(), options));
    least = draw == 1 ? trial.rmse : std::min(least, trial.rmse);
    most = std::max(most, trial.rmse);
    least_max = draw == 1 ? trial.max_error : std::min(least_max, trial.max_error);
    most_max = std::max(most_max, trial.max_error);
  }
  return fmt::format("{} {} to {} (max {} to {})", field.key, number(least), number(most), number(least_max),
                     number(most_max));
}

bool is_attenuated(const Selector& selector) { return selector.importance.feature == Feature::kDistance; }

/// RMS and max error of the attenuated rows against those of plain global error.
std::string describe_attenuated(const std::vector<Row>& rows) {
  std::array<double, 2> least{1e300, 1e300}, most{-1e300, -1e300};
  for (const Row& row : rows) {
    if (!is_attenuated(*row.selector)) continue;
    for (std::size_t f = 0; f < row.trials.size(); ++f) {
      const Trial &plain = rows[0].trials[f], &trial = row.trials[f];
      const std::array<double, 2> changes{100 * (trial.rmse / plain.rmse - 1),
                                          100 * (trial.max_error / plain.max_error - 1)};
      for (std::size_t k = 0; k < 2; ++k) {
        least[k] = std::min(least[k], changes[k]);
        most[k] = std::max(most[k], changes[k]);
      }
    }
  }
  return fmt::format("Attenuated against plain global error: RMS {} to {} %, max error {} to {} %.",
                     with_sign(least[0], 1), with_sign(most[0], 1), with_sign(least[1], 0), with_sign(most[1], 0));
}

/// The content of the table, put into words.
std::vector<std::string> find_remarks(const std::vector<Row>& rows, const std::vector<const Field*>& fields) {
  std::size_t beaten = 0, one_pass_worse = 0, one_pass_trials = 0;
  for (const Row& row : rows) {
    for (std::size_t f = 0; f < fields.size(); ++f) {
      if (!is_attenuated(*row.selector) && row.trials[f].rmse < rows[0].trials[f].rmse) ++beaten;
      if (!row.selector->importance.one_pass) continue;
      ++one_pass_trials;
      if (row.trials[f].rmse > rows[2].trials[f].rmse) ++one_pass_worse;
    }
  }
  std::vector<std::string> remarks;
  remarks.push_back(beaten == 0 ? "Plain global error has a smaller RMS than every choice but the attenuated ones, on "
                                  "every field: no product with local error or curvature is worth its cost."
                                : fmt::format("Plain global error is beaten in {} of the runs.", beaten));
  remarks.push_back(describe_attenuated(rows));
  remarks.push_back(one_pass_worse == one_pass_trials
                        ? "Every one-pass selector is worse than random points: it spends its vertices on noise and "
                          "rough places, and few on large smooth shapes."
                        : fmt::format("One-pass selectors are worse than random points in {} of {} runs.",
                                      one_pass_worse, one_pass_trials));
  return remarks;
}

}  // namespace

Result<void> add_selectors(Study& study) {
  const std::vector<const Field*> fields = study.choose(kThreeFields);
  const std::vector<Selector> selectors = list_selectors();
  std::vector<Row> rows;
  std::vector<std::vector<std::string>> cells;
  Differences greedy, drawn, ranked, drawn_max, ranked_max;
  for (const Selector& selector : selectors) {
    study.note(fmt::format("selectors: {}", selector.name));
    Row row{&selector, {}};
    std::vector<std::string> line{selector.name};
    for (const Field* field : fields) {
      SCARP_TRY(const Trial& trial, run(study, *field, selector));
      std::optional<double> rmse, max_error;
      if (selector.figures != nullptr) {
        rmse = figure_of(study, kThreeFields, selector.figures->rmse, *field);
        max_error = figure_of(study, kThreeFields, selector.figures->max_error, *field);
      }
      line.push_back(beside(trial.rmse, rmse));
      line.push_back(beside(trial.max_error, max_error));
      const std::string what = fmt::format("{} on {}", selector.name, field->key);
      const bool is_draw = selector.choice != Selector::Choice::kImportance;
      (is_draw ? drawn : selector.importance == Importance{} ? greedy : ranked).add(what, trial.rmse, rmse);
      (is_draw ? drawn_max : ranked_max).add(what, trial.max_error, max_error);
      row.trials.push_back(trial);
    }
    rows.push_back(std::move(row));
    cells.push_back(std::move(line));
  }
  std::vector<std::string> header{"selector"};
  for (const Field* field : fields) {
    header.push_back(field->key + " RMS");
    header.push_back("max");
  }
  study.page.heading(2, "What is worth inserting (section 3: importance measures)");
  study.page.paragraph(
      "The same Delaunay triangulation of 1 % of the samples; only their choice differs. Uniform: a sub-grid of about "
      "as many vertices, borders included. Attenuated: the error counts for less near chosen vertices, here by the "
      "distance from the nearest corner of the sample's triangle, in samples; the paper's formula is not known.");
  study.page.table(header, cells);
  std::vector<std::string> remarks = find_remarks(rows, fields);
  study.note("selectors: other random points");
  std::string draws;
  for (const Field* field : fields) {
    SCARP_TRY(const std::string& range, try_other_draws(study, *field));
    draws += (draws.empty() ? "" : ", ") + range;
  }
  remarks.push_back(fmt::format("Random points in {} other draws, RMS: {}.", kOtherDraws, draws));
  if (!greedy.empty()) {
    remarks.push_back(greedy.sentence("RMS errors of plain global error"));
    remarks.push_back(drawn.sentence("RMS errors of uniform and random points") +
                      " The points differ: other random numbers, another rounding of the sub-grid's rows and columns.");
    remarks.push_back(
        ranked.sentence("RMS errors of one pass and of products") +
        (ranked.largest() > 5
             ? " The border differs: here a pair of opposite neighbours of which one is missing is omitted, so that a "
               "plane has no local error there either. On crater and ashby Scape's figures for one pass result within "
               "about 1 % where such a pair counts as 0 (4 neighbours), and where the mean is that of the existing "
               "neighbours (8 neighbours)."
             : ""));
  }
  if (const std::string far = drawn_max.list_far(kFarPercent); !far.empty()) {
    remarks.push_back(
        fmt::format("**Max error of {}:** no failure. One peak or gorge, which the points hit or miss, decides it, as "
                    "in the other draws.",
                    far));
  }
  if (const std::string far = ranked_max.list_far(kFarPercent); !far.empty()) {
    remarks.push_back(
        fmt::format("**Max error of {}:** no failure. Where whole regions get no vertex, one sample more or less at "
                    "the border decides the worst of them.",
                    far));
  }
  study.page.list(remarks);
  return {};
}

}  // namespace scarp::paper
