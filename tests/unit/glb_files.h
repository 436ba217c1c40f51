// Splits and joins GLB files.
#pragma once

#include <cstdint>
#include <cstring>
#include <nlohmann/json.hpp>
#include <vector>

namespace scarp::test {

inline std::uint32_t load_u32(const std::vector<std::uint8_t>& bytes, std::size_t at) {
  return bytes[at] | bytes[at + 1] << 8 | bytes[at + 2] << 16 | static_cast<std::uint32_t>(bytes[at + 3]) << 24;
}

inline nlohmann::json glb_json(const std::vector<std::uint8_t>& bytes) {
  return nlohmann::json::parse(bytes.begin() + 20, bytes.begin() + 20 + load_u32(bytes, 12));
}

/// The same file with another JSON chunk.
inline std::vector<std::uint8_t> with_json(const std::vector<std::uint8_t>& bytes, const nlohmann::json& changed) {
  std::string text = changed.dump();
  text.resize((text.size() + 3) / 4 * 4, ' ');
  const std::size_t old_end = 20 + load_u32(bytes, 12);
  std::vector<std::uint8_t> result(20 + text.size() + bytes.size() - old_end);
  std::memcpy(result.data(), bytes.data(), 20);
  std::memcpy(result.data() + 20, text.data(), text.size());
  std::memcpy(result.data() + 20 + text.size(), bytes.data() + old_end, bytes.size() - old_end);
  const auto size = static_cast<std::uint32_t>(text.size()), total = static_cast<std::uint32_t>(result.size());
  std::memcpy(&result[12], &size, 4);
  std::memcpy(&result[8], &total, 4);
  return result;
}

}  // namespace scarp::test
