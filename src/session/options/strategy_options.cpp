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

constexpr Choice<Importance::Feature> kFeatures[] = {{"local", Importance::Feature::kLocal4},
                                                     {"local8", Importance::Feature::kLocal8},
                                                     {"curvature", Importance::Feature::kCurvature},
                                                     {"distance", Importance::Feature::kDistance}};
constexpr Choice<Effort> kEfforts[] = {
    {"fast", Effort::kFast}, {"normal", Effort::kNormal}, {"high", Effort::kHigh}, {"max", Effort::kMax}};
constexpr Choice<Order> kOrders[] = {{"dominant", Order::kDominant}, {"greedy", Order::kGreedy}};

/// Cuts `prefix` and `suffix` off the text; false, without change, if it does not have both.
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
    return fail(
        ErrorKind::kUsage,
        fmt::format("--batch {} is unknown: choose const, frac:A such as frac:0.9, or independent", shell_word(text)));
  }
  SCARP_TRY(const double fraction, parse_number("--batch frac:", text.substr(5)));
  if (fraction <= 0 || fraction > 1) {
    return fail(ErrorKind::kUsage,
                fmt::format("--batch {}: the fraction must be above 0 and at most 1", shell_word(text)));
  }
  batch.rule = Batch::Rule::kFraction;
  batch.fraction = fraction;
  return batch;
}

Result<EdgeRule> parse_edges(const StrategyArguments& given) {
  EdgeRule rule;
  if (given.edges) {
    SCARP_TRY(rule.data_dependent, choose("--edges", *given.edges, kEdgeWords));
  }
  const std::pair<const char*, const Given*> needing[] = {{"--edge-score", &given.edge_score},
                                                          {"--shape-threshold", &given.shape_threshold},
                                                          {"--supersample", &given.supersample}};
  for (const auto& [name, text] : needing) {
    if (*text && !rule.data_dependent) {
      return fail(ErrorKind::kUsage, fmt::format("{} needs --edges data: Delaunay edges ignore the heights", name));
    }
  }
  if (given.edge_score) {
    SCARP_TRY(rule.score, choose("--edge-score", *given.edge_score, kScores));
  }
  if (given.shape_threshold) {
    SCARP_TRY(const double threshold, parse_non_negative("--shape-threshold", *given.shape_threshold));
    if (threshold > 1) {
      return fail(ErrorKind::kUsage, fmt::format("--shape-threshold {} is above 1: it lies between 0, by the data "
                                                 "alone, and 1, by the shape alone",
                                                 shell_word(*given.shape_threshold)));
    }
    rule.shape_threshold = threshold;
  }
  if (given.supersample) {
    SCARP_TRY(rule.supersample, parse_non_negative("--supersample", *given.supersample));
  }
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
  return fail(
      ErrorKind::kUsage,
      fmt::format("--importance {} is unknown: choose global, or local, local8, curvature or distance, alone or as in "
                  "global*local, global*(local+1), global*sqrt(curvature+1)",
                  shell_word(text)));
}

std::string importance_name(const Importance& importance) {
  if (importance.feature == Importance::Feature::kNoFeature) return "global";
  std::string name = name_of(importance.feature, kFeatures);
  if (importance.damping == Importance::Damping::kPlusOne) name = "(" + name + "+1)";
  if (importance.damping == Importance::Damping::kSqrtPlusOne) name = "sqrt(" + name + "+1)";
  return importance.global ? "global*" + name : name;
}

void StrategyArguments::add_to(CLI::App& command) {
  add_option(command, OptionId::kEffort, effort);
  add_option(command, OptionId::kVertices, vertices);
  add_option(command, OptionId::kMinShape, min_shape);
  add_option(command, OptionId::kTimeLimit, time_limit);
  add_option(command, OptionId::kObjective, objective);
  add_option(command, OptionId::kImportance, importance);
  add_flag(command, OptionId::kOnePass, one_pass);
  add_option(command, OptionId::kOrder, order);
  add_option(command, OptionId::kAlgorithm, algorithm);
  add_option(command, OptionId::kBatch, batch);
  add_option(command, OptionId::kEdges, edges);
  add_option(command, OptionId::kEdgeScore, edge_score);
  add_option(command, OptionId::kShapeThreshold, shape_threshold);
  add_option(command, OptionId::kSupersample, supersample);
}

const char* StrategyArguments::find_strategy() const {
  if (importance && importance != "global") return "--importance";
  if (one_pass) return "--one-pass";
  if (algorithm) return "--algorithm";
  if (batch) return "--batch";
  return edges && edges != "delaunay" ? "--edges data" : nullptr;
}

Result<void> StrategyArguments::parse_into(SimplifyOptions& options, Strategy& strategy) const {
  if (effort) {
    SCARP_TRY(options.quality.effort, choose("--effort", *effort, kEfforts));
  }
  if (vertices) {
    SCARP_TRY(const Vertices parsed, choose("--vertices", *vertices, kVertexWords));
    if (parsed == Vertices::kFree && options.quality.effort < Effort::kHigh)
      return fail(ErrorKind::kUsage,
                  "--vertices free needs --effort high or max: below that no vertex is moved, and all are samples");
    options.quality.vertices = parsed;
  }
  if (min_shape) {
    SCARP_TRY(const double parsed, parse_non_negative("--min-shape", *min_shape));
    if (parsed > 0.5)
      return fail(ErrorKind::kUsage,
                  fmt::format("--min-shape {} is above 0.5, the shape of half a sample's square: choose "
                              "one from 0 to 0.5",
                              shell_word(*min_shape)));
    options.quality.min_shape = parsed;
  }
  if (time_limit) {
    SCARP_TRY(const double parsed, parse_non_negative("--time-limit", *time_limit));
    const auto seconds = std::chrono::duration<double>(std::min(parsed, 1e9));
    const auto end = std::chrono::steady_clock::now() + std::chrono::duration_cast<std::chrono::nanoseconds>(seconds);
    options.run.is_time_up = [end] { return std::chrono::steady_clock::now() >= end; };
  }
  if (objective) {
    SCARP_TRY(options.goals.objective, choose("--objective", *objective, kObjectives));
  }
  if (importance) {
    SCARP_TRY(strategy.importance, parse_importance(*importance));
  }
  const Importance::Feature feature = strategy.importance.feature;
  const bool by_raster = feature != Importance::Feature::kNoFeature && feature != Importance::Feature::kDistance;
  if (one_pass && (!by_raster || strategy.importance.global)) {
    return fail(ErrorKind::kUsage,
                "--one-pass ranks by a feature of the raster, without the mesh: give it "
                "--importance local, local8 or curvature");
  }
  strategy.importance.one_pass = one_pass;
  if (order) {
    SCARP_TRY(options.quality.order, choose("--order", *order, kOrders));
  }
  if (algorithm) {
    SCARP_TRY(strategy.algorithm, choose("--algorithm", *algorithm, kAlgorithms));
  }
  if (batch) {
    SCARP_TRY(strategy.batch, parse_batch(*batch));
    if (one_pass)
      return fail(ErrorKind::kUsage,
                  "--one-pass cannot be combined with --batch: one pass ranks all samples once and never looks at the "
                  "mesh");
  }
  SCARP_TRY(strategy.edges, parse_edges(*this));
  return {};
}

std::string StrategyArguments::canonical() const {
  return canonical_option("--effort", effort) + canonical_option("--vertices", vertices) +
         canonical_option("--min-shape", min_shape) + canonical_option("--time-limit", time_limit) +
         (objective && *objective != "max" ? canonical_option("--objective", objective) : "") + canonical_refinement();
}

std::string StrategyArguments::canonical_refinement() const {
  return canonical_option("--importance", importance) + (one_pass ? " --one-pass" : "") +
         canonical_option("--batch", batch) + canonical_option("--edges", edges) +
         canonical_option("--edge-score", edge_score) + canonical_option("--shape-threshold", shape_threshold) +
         canonical_option("--supersample", supersample);
}

const char* effort_name(Effort effort) { return name_of(effort, kEfforts); }
const char* order_name(Order order) { return name_of(order, kOrders); }

}  // namespace scarp::cli
