// JSON in GLB files: the type, and the way from metadata to JSON and back.
#pragma once

#include <map>
#include <nlohmann/json.hpp>
#include <optional>
#include <string>
#include <string_view>

namespace scarp {

/// Keeps the order of keys, so that a stored report reads as it was written.
using Json = nlohmann::ordered_json;

/// Parses text that may be hostile: nothing if it is no JSON, is nested deeper than 100, or has an object with more
/// than 10,000 members (whose cost would be quadratic). Such JSON can be printed again without deep recursion.
std::optional<Json> parse_json(std::string_view text);

/// Metadata as an object. A value that is itself a JSON object, array or number in compact form is embedded as such;
/// all others are strings. extras_to_metadata() gives the same strings back.
Json metadata_to_extras(const std::map<std::string, std::string>& metadata);
std::map<std::string, std::string> extras_to_metadata(const Json& extras);

/// Compact text; bytes that are not UTF-8 become U+FFFD.
std::string print_json(const Json& json);

}  // namespace scarp
