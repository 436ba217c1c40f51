#include "io/mesh/glb_json.h"

#include <array>

namespace scarp::io {
namespace {

constexpr std::size_t kMostDepth = 100, kMostMembers = 10000;

/// Scans the text once before parsing. Counts brackets and, for each open bracket, commas. Correct for all valid JSON;
/// for other text any result is fine, since the parser rejects it.
bool has_modest_shape(std::string_view text) {
  std::array<std::size_t, kMostDepth + 1> commas{};
  std::array<bool, kMostDepth + 1> is_object{};
  std::size_t depth = 0;
  bool in_string = false;
  for (std::size_t i = 0; i < text.size(); ++i) {
    const char c = text[i];
    if (in_string) {
      if (c == '\\') ++i;
      if (c == '"') in_string = false;
    } else if (c == '"') {
      in_string = true;
    } else if (c == '{' || c == '[') {
      if (++depth > kMostDepth) return false;
      commas[depth] = 0;
      is_object[depth] = c == '{';
    } else if (c == '}' || c == ']') {
      if (depth > 0) --depth;
    } else if (c == ',' && is_object[depth]) {
      if (++commas[depth] >= kMostMembers) return false;
    }
  }
  return true;
}

}  // namespace

std::optional<Json> parse_json(std::string_view text) {
  if (!has_modest_shape(text)) return {};
  Json json = Json::parse(text.begin(), text.end(), nullptr, false);
  if (json.is_discarded()) return {};
  return json;
}

std::string print_json(const Json& json) { return json.dump(-1, ' ', false, Json::error_handler_t::replace); }

Json metadata_to_extras(const std::map<std::string, std::string>& metadata) {
  Json extras = Json::object();
  for (const auto& [key, value] : metadata) {
    const char first = value.empty() ? ' ' : value[0];
    const bool maybe = first == '{' || first == '[' || first == '-' || (first >= '0' && first <= '9');
    auto json = maybe ? parse_json(value) : std::nullopt;
    if (json && print_json(*json) == value) {
      extras[key] = std::move(*json);
    } else {
      extras[key] = value;
    }
  }
  return extras;
}

std::map<std::string, std::string> extras_to_metadata(const Json& extras) {
  std::map<std::string, std::string> metadata;
  if (!extras.is_object()) return metadata;
  for (const auto& [key, value] : extras.items()) {
    metadata[key] = value.is_string() ? value.get<std::string>() : print_json(value);
  }
  return metadata;
}

}  // namespace scarp::io
