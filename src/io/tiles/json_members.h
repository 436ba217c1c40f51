// Optional members of JSON objects.
#pragma once

#include <cstdint>
#include <optional>
#include <string>

#include "io/mesh/glb_json.h"

namespace scarp::io {

/// Null if the member is missing or `object` is no object.
inline const Json* find_member(const Json* object, const char* key) {
  if (object == nullptr || !object->is_object()) return nullptr;
  const auto found = object->find(key);
  return found == object->end() ? nullptr : &*found;
}

inline std::optional<double> find_number(const Json* object, const char* key) {
  const Json* const found = find_member(object, key);
  return found != nullptr && found->is_number() ? std::optional(found->get<double>()) : std::nullopt;
}

/// A non-negative integer.
inline std::optional<std::uint64_t> find_count(const Json* object, const char* key) {
  const Json* const found = find_member(object, key);
  return found != nullptr && found->is_number_unsigned() ? std::optional(found->get<std::uint64_t>()) : std::nullopt;
}

/// Empty if absent.
inline std::string find_text(const Json* object, const char* key) {
  const Json* const found = find_member(object, key);
  return found != nullptr && found->is_string() ? found->get<std::string>() : std::string();
}

}  // namespace scarp::io
