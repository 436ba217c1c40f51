#include "session/reports/strategy_report.h"

#include <fmt/format.h>

#include "session/options/strategy_options.h"
#include "session/options/strategy_words.h"
#include "session/options/values.h"
#include "session/text/json_text.h"

namespace scarp::cli {
namespace {

constexpr Choice<WhyFast> kWhyFast[] = {{"order", WhyFast::kOrder},
                                        {"strategy", WhyFast::kStrategy},
                                        {"memory", WhyFast::kMemory},
                                        {"budget", WhyFast::kBudget}};

}  // namespace

Json describe_strategy(const SimplifyOptions& options, const Strategy& strategy, const Simplified& simplified) {
  Json json;
  json["importance"] = importance_name(strategy.importance);
  json["one_pass"] = strategy.importance.one_pass;
  json["effort"] = effort_name(simplified.effort);
  json["why_fast"] =
      simplified.why_fast == WhyFast::kNone ? Json(nullptr) : Json(name_of(simplified.why_fast, kWhyFast));
  json["vertices"] = name_of(simplified.vertices, kVertexWords);
  json["min_shape"] = options.quality.min_shape.value_or(
      simplified.vertices == Vertices::kFree && simplified.effort > Effort::kNormal ? 0.1 : 0);
  json["cut_short"] = simplified.is_cut_short;
  json["objective"] = name_of(options.goals.objective, kObjectives);
  json["order"] = order_name(simplified.order);
  json["algorithm"] =
      simplified.order == Order::kGreedy ? Json(name_of(strategy.algorithm, kAlgorithms)) : Json(nullptr);
  switch (strategy.batch.rule) {
    case Batch::Rule::kSequential:
      json["batch"] = nullptr;
      break;
    case Batch::Rule::kConstant:
      json["batch"] = "const";
      break;
    case Batch::Rule::kFraction:
      json["batch"] = fmt::format("frac:{}", strategy.batch.fraction);
      break;
    case Batch::Rule::kIndependent:
      json["batch"] = "independent";
      break;
  }
  const EdgeRule& edges = strategy.edges;
  json["edges"] = name_of(edges.data_dependent, kEdgeWords);
  if (!edges.data_dependent) return json;
  json["edge_score"] = name_of(edges.score, kScores);
  const double by_default = edges.score == EdgeScore::kTight ? 0.1 : 0.5;
  json["shape_threshold"] = edges.shape_threshold < 0 ? by_default : edges.shape_threshold;
  json["supersample"] = edges.supersample;
  return json;
}

}  // namespace scarp::cli
