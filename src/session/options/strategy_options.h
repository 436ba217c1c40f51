// Options for the strategy of insertion.
#pragma once

#include <string>

#include "scarp/paper.h"
#include "session/options/given_options.h"

namespace scarp::cli {

/// Sets effort, objective and order in `options`, and all of `strategy`.
Result<void> parse_strategy(const GivenOptions& given, SimplifyOptions& options, Strategy& strategy);
/// The first option given that selects a strategy of the 1995 paper; empty if none.
std::string find_strategy(const GivenOptions& given);
/// True if the greedy order was requested, by name or by one of its algorithms.
bool asks_for_greedy(const GivenOptions& given);

/// Parses "global" or [global*]F, where F is local, local8, curvature, (f+1) or sqrt(f+1). Ignores blanks.
Result<Importance> parse_importance(const std::string& text);
/// The text that parse_importance() reads as the same importance.
std::string importance_name(const Importance& importance);

/// The effort's name in the options.
const char* effort_name(Effort effort);
const char* order_name(Order order);

}  // namespace scarp::cli
