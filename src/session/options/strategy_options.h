// Options for the strategy of insertion.
#pragma once

#include <string>

#include "scarp/paper.h"
#include "session/options/values.h"

namespace CLI {
class App;
}

namespace scarp::cli {

struct StrategyArguments {
  Given effort, vertices, min_shape, time_limit, objective, importance, order, algorithm, batch, edges, edge_score,
      shape_threshold, supersample;
  bool one_pass = false;

  void add_to(CLI::App& command);
  /// Sets effort, objective and order of the options, and all of the strategy.
  Result<void> parse_into(SimplifyOptions& options, Strategy& strategy) const;
  /// The first option that asks for a strategy of the 1995 paper; null if there is none.
  const char* find_strategy() const;
  /// True if the greedy order was asked for, by name or by naming one of its algorithms.
  bool asks_for_greedy() const { return algorithm || order == "greedy"; }
  /// The options that can change the mesh, for the canonical command, but for the order.
  std::string canonical() const;
  /// The same, without effort.
  std::string canonical_refinement() const;
};

/// [global*]F with F one of local, local8, curvature, (f+1), sqrt(f+1); or global alone. Blanks do not count.
Result<Importance> parse_importance(const std::string& text);
/// The text that parse_importance() reads as the same importance.
std::string importance_name(const Importance& importance);

/// The effort's name in the options.
const char* effort_name(Effort effort);
const char* order_name(Order order);

}  // namespace scarp::cli
