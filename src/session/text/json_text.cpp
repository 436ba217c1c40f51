#include "session/text/json_text.h"

#include <cmath>

namespace scarp::cli {

Json finite_or_word(double value) { return std::isfinite(value) ? Json(value) : Json("inf"); }

std::string to_text(const Json& report) { return report.dump(2, ' ', false, Json::error_handler_t::replace) + "\n"; }

}  // namespace scarp::cli
