// Section 4, parallel insertion: several insertions a pass.
#include <fmt/format.h>

#include "paper/study.h"

namespace scarp::paper {
namespace {

struct Rule {
  const char* name;
  Batch batch;
  const BatchFigures* figures;  ///< null: the paper's program has no such rule
};

constexpr std::array<Rule, 7> kRules{{{"sequential", {Batch::Rule::kSequential, 1}, &kSequential},
                                      {"fraction 0.95", {Batch::Rule::kFraction, 0.95}, &kFraction95},
                                      {"fraction 0.9", {Batch::Rule::kFraction, 0.9}, &kFraction90},
                                      {"fraction 0.7", {Batch::Rule::kFraction, 0.7}, &kFraction70},
                                      {"fraction 0.5", {Batch::Rule::kFraction, 0.5}, &kFraction50},
                                      {"constant = bound", {Batch::Rule::kConstant, 1}, &kConstantBound},
                                      {"independent", {Batch::Rule::kIndependent, 1}, nullptr}}};

constexpr std::size_t kIndependentRule = kRules.size() - 1;

}  // namespace

Result<void> add_batches(Study& study) {
  const std::vector<const Field*> fields = study.choose(kThreeFields);
  if (fields.empty()) return {};
  std::vector<double> bounds;
  std::vector<std::string> header{"rule"};
  for (const Field* field : fields) {
    if (const auto bound = figure_of(study, kThreeFields, kBatchBounds, *field)) {
      bounds.push_back(*bound);
    } else {
      SCARP_TRY(const Trial& trial, study.delaunay(*field, field->share(1)));
      bounds.push_back(trial.max_error);
    }
    header.insert(header.end(),
                  {fmt::format("{}, max error {}", field->key, number(bounds.back())), "against sequential", "passes"});
  }
  std::vector<std::vector<std::string>> cells;
  std::array<std::vector<Trial>, kRules.size()> trials;
  Differences vertices, passes;
  for (std::size_t r = 0; r < kRules.size(); ++r) {
    const Rule& rule = kRules[r];
    study.note(fmt::format("batches: {}", rule.name));
    std::vector<std::string> line{rule.name};
    for (std::size_t f = 0; f < fields.size(); ++f) {
      PaperOptions options;
      options.goals.max_error = bounds[f];
      options.strategy.batch = rule.batch;
      SCARP_TRY(const Trial& trial, study.reach(*fields[f], options));
      trials[r].push_back(trial);
      std::optional<double> scape_vertices, scape_passes;
      if (rule.figures != nullptr) {
        scape_vertices = figure_of(study, kThreeFields, rule.figures->vertices, *fields[f]);
        scape_passes = figure_of(study, kThreeFields, rule.figures->passes, *fields[f]);
      }
      const std::string what = fmt::format("{} on {}", rule.name, fields[f]->key);
      vertices.add(what, static_cast<double>(trial.vertices), scape_vertices);
      passes.add(what, static_cast<double>(trial.work.passes), scape_passes);
      line.push_back(beside_count(trial.vertices, scape_vertices));
      line.push_back(
          percent_of_change(static_cast<double>(trial.vertices), static_cast<double>(trials[0][f].vertices)));
      line.push_back(beside_count(trial.work.passes, scape_passes));
    }
    cells.push_back(std::move(line));
  }
  study.page.heading(2, "Insertion in batches (section 4, parallel insertion)");
  study.page.paragraph(
      "Vertices and passes until the max error is below the bound. Fraction α: a pass inserts all candidates of at "
      "least α times the largest error; constant: all that break the bound; independent (Scarp's own): all whose "
      "triangle the pass has not changed yet, worst first.");
  study.page.table(header, cells);
  bool sequential_best = true, independent_better = true;
  for (std::size_t f = 0; f < fields.size(); ++f) {
    for (std::size_t r = 1; r < kIndependentRule; ++r) {
      sequential_best = sequential_best && trials[r][f].vertices >= trials[0][f].vertices;
      independent_better = independent_better && trials[kIndependentRule][f].vertices < trials[r][f].vertices;
    }
  }
  std::vector<std::string> remarks{
      sequential_best ? "Of the paper's rules, one at a time makes the smallest meshes on every field: a batch inserts "
                        "samples that its earlier insertions have already mended."
                      : "One at a time is not the smallest of the paper's rules on every field here."};
  if (independent_better) {
    remarks.push_back(
        "Independent candidates need fewer vertices than any threshold on every field: none is stale when it is "
        "inserted.");
  }
  if (!vertices.empty()) {
    remarks.push_back(vertices.sentence("counts of vertices"));
    remarks.push_back(passes.sentence("counts of passes") +
                      (passes.largest() > 5
                           ? " With a few dozen passes a single candidate on the limit, or one tie decided otherwise, "
                             "moves all that follow."
                           : ""));
  }
  study.page.list(remarks);
  return {};
}

}  // namespace scarp::paper
