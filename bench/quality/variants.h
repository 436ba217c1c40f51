// The variants in the effort tables: greedy insertion, and improvements on it by simplify().
#pragma once

#include <cstdint>
#include <limits>
#include <string_view>

#include "scarp/simplify.h"

namespace bench {

struct Variant {
  std::string_view name;  ///< unique name of the row
  scarp::Order order;
  scarp::Effort effort;
  std::string_view vertices;  ///< places of vertices: "samples", or "free" for anywhere
  double most_greedy_triangles = std::numeric_limits<double>::infinity();  ///< not run if greedy needs more
};

/// Other variants are compared with the first.
inline constexpr Variant kVariants[] = {
    {"greedy", scarp::Order::kGreedy, scarp::Effort::kFast, "samples"},
    {"fast", scarp::Order::kAuto, scarp::Effort::kFast, "samples"},
    {"normal", scarp::Order::kAuto, scarp::Effort::kNormal, "samples"},
    {"normal free", scarp::Order::kAuto, scarp::Effort::kNormal, "free"},
    {"high on samples", scarp::Order::kAuto, scarp::Effort::kHigh, "samples"},
    {"high", scarp::Order::kAuto, scarp::Effort::kHigh, "free"},
    {"max", scarp::Order::kAuto, scarp::Effort::kMax, "free", 100'000},
};

/// A variant for budgets.
struct BudgetVariant {
  std::string_view name;  ///< unique name of the row
  scarp::Effort effort;
  scarp::Objective objective;
  double most_budget = std::numeric_limits<double>::infinity();  ///< not run for larger budgets
};

inline constexpr BudgetVariant kBudgetVariants[] = {
    {"normal", scarp::Effort::kNormal, scarp::Objective::kMax},
    {"normal rms", scarp::Effort::kNormal, scarp::Objective::kRms},
    {"high", scarp::Effort::kHigh, scarp::Objective::kMax},
    {"high rms", scarp::Effort::kHigh, scarp::Objective::kRms},
    {"max rms", scarp::Effort::kMax, scarp::Objective::kRms, 30'000},
};

/// The variant of that name, or null.
inline const Variant* find_variant(std::string_view name) {
  for (const Variant& variant : kVariants) {
    if (variant.name == name) return &variant;
  }
  return nullptr;
}

/// Uses one thread, so that CPU times are comparable.
inline scarp::SimplifyOptions options_of(const Variant& variant, double max_error) {
  scarp::SimplifyOptions options;
  options.goals.max_error = max_error;
  options.quality.order = variant.order;
  options.quality.effort = variant.effort;
  options.quality.vertices = variant.vertices == "free" ? scarp::Vertices::kFree : scarp::Vertices::kSamples;
  options.run.threads = 1;
  return options;
}

/// The variant of that name, or null.
inline const BudgetVariant* find_budget_variant(std::string_view name) {
  for (const BudgetVariant& variant : kBudgetVariants) {
    if (variant.name == name) return &variant;
  }
  return nullptr;
}

inline scarp::SimplifyOptions options_of(const BudgetVariant& variant, std::uint64_t max_triangles) {
  scarp::SimplifyOptions options;
  options.goals.max_triangles = max_triangles;
  options.goals.objective = variant.objective;
  options.quality.effort = variant.effort;
  options.run.threads = 1;
  return options;
}

}  // namespace bench
