#include "session/options/strategy_options.h"

#include <fmt/format.h>

#include <algorithm>
#include <cctype>
#include <chrono>
#include <string_view>

#include "session/options/strategy_words.h"
#include "session/table/option_table.h"
#include "session/text/text.h"

namespace scarp::cli {
namespace {

using enum OptionId;

constexpr Choice<Importance::Feature> kFeatures[] = {{"local", Importance::Feature::kLocal4},
                                                     {"local8", Importance::Feature::kLocal8},
                                                     {"curvature", Importance::Feature::kCurvature},
                                                     {"distance", Importance::Feature::kDistance}};
constexpr Choice<Effort> kEfforts[] = {
    {"fast", Effort::kFast}, {"normal", Effort::kNormal}, {"high", Effort::kHigh}, {"max", Effort::kMax}};
constexpr Choice<Order> kOrders[] = {{"dominant", Order::kDominant}, {"greedy", Order::kGreedy}};

/// Removes `prefix` and `suffix` from the text. False, without change, unless the text has both.
bool strip(std::string_view& text, std::string_view prefix, std::string_view suffix) {
  if (text.size() < prefix.size() + suffix.size()) return false;
  if (text.substr(0, prefix.size()) != prefix || text.substr(text.size() - suffix.size()) != suffix) return false;
  text.remove_prefix(prefix.size());
  text.remove_suffix(suffix.size());
  return true;
}

Result<Batch> parse_batch(const std::string& text) {
  Batch batch;
  if (text == "const") {
    batch.rule = Batch::Rule::kConstant;
    return batch;
  }
  if (text == "independent") {
    batch.rule = Batch::Rule::kIndependent;
    return batch;
  }
  if (text.rfind("frac:", 0) != 0) {
    return fail(ErrorKind::kUsage,
                fmt::format("{} {} is unknown: choose const, frac:A such as frac:0.9, or independent", kBatch,
                            shell_word(text)));
  }
  SCARP_TRY(const double fraction, parse_number(fmt::format("{} frac:", kBatch), text.substr(5)));
  if (fraction <= 0 || fraction > 1) {
    return fail(ErrorKind::kUsage,
                fmt::format("{} {}: the fraction must be above 0 and at most 1", kBatch, shell_word(text)));
  }
  batch.rule = Batch::Rule::kFraction;
  batch.fraction = fraction;
  return batch;
}

Result<EdgeRule> parse_edges(const GivenOptions& given) {
  EdgeRule rule;
  SCARP_TRY(const auto is_of_data, given.choice(kEdges, kEdgeWords));
  rule.data_dependent = is_of_data.value_or(rule.data_dependent);
  SCARP_TRY(const auto score, given.choice(kEdgeScore, kScores));
  rule.score = score.value_or(rule.score);
  SCARP_TRY(const auto threshold, given.number(kShapeThreshold));
  if (threshold) rule.shape_threshold = *threshold;
  SCARP_TRY(const auto supersample, given.number(kSupersample));
  rule.supersample = supersample.value_or(rule.supersample);
  return rule;
}

}  // namespace

Result<Importance> parse_importance(const std::string& text) {
  std::string word = text;
  word.erase(std::remove_if(word.begin(), word.end(), [](unsigned char c) { return std::isspace(c) != 0; }),
             word.end());
  Importance importance;
  if (word == "global") return importance;
  std::string_view feature = word;
  importance.global = strip(feature, "global*", "");
  if (strip(feature, "sqrt(", "+1)")) {
    importance.damping = Importance::Damping::kSqrtPlusOne;
  } else if (strip(feature, "(", "+1)")) {
    importance.damping = Importance::Damping::kPlusOne;
  }
  for (const Choice<Importance::Feature>& choice : kFeatures) {
    if (feature != choice.name) continue;
    importance.feature = choice.value;
    return importance;
  }
  return fail(ErrorKind::kUsage,
              fmt::format("{} {} is unknown: choose global, or local, local8, curvature or distance, alone or as in "
                          "global*local, global*(local+1), global*sqrt(curvature+1)",
                          kImportance, shell_word(text)));
}

std::string importance_name(const Importance& importance) {
  if (importance.feature == Importance::Feature::kNoFeature) return "global";
  std::string name = name_of(importance.feature, kFeatures);
  if (importance.damping == Importance::Damping::kPlusOne) name = "(" + name + "+1)";
  if (importance.damping == Importance::Damping::kSqrtPlusOne) name = "sqrt(" + name + "+1)";
  return importance.global ? "global*" + name : name;
}

std::string find_strategy(const GivenOptions& given) {
  if (given[kImportance] && given[kImportance] != "global") return name_of(kImportance);
  if (const auto option = given.first_of({kOnePass, kAlgorithm, kBatch})) return name_of(*option);
  return given[kEdges] && given[kEdges] != "delaunay" ? fmt::format("{} data", kEdges) : "";
}

bool asks_for_greedy(const GivenOptions& given) { return given.has(kAlgorithm) || given[kOrder] == "greedy"; }

Result<void> parse_strategy(const GivenOptions& given, SimplifyOptions& options, Strategy& strategy) {
  Quality& quality = options.quality;
  SCARP_TRY(const auto effort, given.choice(kEffort, kEfforts));
  quality.effort = effort.value_or(quality.effort);
  SCARP_TRY(const auto vertices, given.choice(kVertices, kVertexWords));
  quality.vertices = vertices.value_or(quality.vertices);
  SCARP_TRY(quality.min_shape, given.number(kMinShape));
  SCARP_TRY(const auto limit, given.number(kTimeLimit));
  if (limit) {
    const auto seconds = std::chrono::duration<double>(std::min(*limit, 1e9));
    const auto end = std::chrono::steady_clock::now() + std::chrono::duration_cast<std::chrono::nanoseconds>(seconds);
    options.run.is_time_up = [end] { return std::chrono::steady_clock::now() >= end; };
  }
  SCARP_TRY(const auto objective, given.choice(kObjective, kObjectives));
  options.goals.objective = objective.value_or(options.goals.objective);
  if (given[kImportance]) {
    SCARP_TRY(strategy.importance, parse_importance(*given[kImportance]));
  }
  const Importance::Feature feature = strategy.importance.feature;
  const bool by_raster = feature != Importance::Feature::kNoFeature && feature != Importance::Feature::kDistance;
  strategy.importance.one_pass = given.has(kOnePass);
  if (strategy.importance.one_pass && (!by_raster || strategy.importance.global))
    return fail(ErrorKind::kUsage, fmt::format("{} ranks by a feature of the raster, without the mesh: give it {} "
                                               "local, local8 or curvature",
                                               kOnePass, kImportance));
  SCARP_TRY(const auto order, given.choice(kOrder, kOrders));
  if (order) quality.order = *order;
  SCARP_TRY(const auto algorithm, given.choice(kAlgorithm, kAlgorithms));
  strategy.algorithm = algorithm.value_or(strategy.algorithm);
  if (given[kBatch]) {
    SCARP_TRY(strategy.batch, parse_batch(*given[kBatch]));
  }
  SCARP_TRY(strategy.edges, parse_edges(given));
  return {};
}

const char* effort_name(Effort effort) { return name_of(effort, kEfforts); }
const char* order_name(Order order) { return name_of(order, kOrders); }

}  // namespace scarp::cli
