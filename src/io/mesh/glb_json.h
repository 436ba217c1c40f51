// JSON in GLB files: the type, and conversion from metadata and back.
#pragma once

#include <map>
#include <nlohmann/json.hpp>
#include <optional>
#include <string>
#include <string_view>

namespace scarp::io {

/// Preserves the order of keys, so that stored reports do not change.
using Json = nlohmann::ordered_json;

/// Parses possibly hostile text. Nothing if it is not JSON, is nested deeper than 100 levels, or has an object of more
/// than 10,000 members (the cost would be quadratic). Printing the result needs no deep recursion.
std::optional<Json> parse_json(std::string_view text);

/// Metadata as an object. A value that is a JSON object, array or number in compact form is embedded as such; all
/// others become strings. extras_to_metadata() restores the same strings.
Json metadata_to_extras(const std::map<std::string, std::string>& metadata);
std::map<std::string, std::string> extras_to_metadata(const Json& extras);

/// Compact text; bytes that are not UTF-8 become U+FFFD.
std::string print_json(const Json& json);

}  // namespace scarp::io
