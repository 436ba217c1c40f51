// JSON of values that may be missing, and JSON as text.
#pragma once

#include <nlohmann/json.hpp>
#include <optional>
#include <string>

#include "session/text/json.h"

namespace scarp::cli {

/// The value, or JSON's null.
template <class T>
Json or_null(const std::optional<T>& value) {
  return value ? Json(*value) : Json(nullptr);
}
/// A finite number, or its word: "inf".
Json finite_or_word(double value);
/// The report as text, two spaces a level, with a newline at the end. Bytes that are not UTF-8 become U+FFFD.
std::string to_text(const Json& report);

}  // namespace scarp::cli
