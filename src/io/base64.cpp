#include "io/base64.h"

#include <cstddef>

namespace scarp::io {
namespace {

int base64_value(std::uint8_t c) {
  if (c >= 'A' && c <= 'Z') return c - 'A';
  if (c >= 'a' && c <= 'z') return c - 'a' + 26;
  if (c >= '0' && c <= '9') return c - '0' + 52;
  if (c == '+') return 62;
  return c == '/' ? 63 : -1;
}

}  // namespace

std::string write_base64(std::span<const std::uint8_t> bytes) {
  constexpr char kLetters[] = "ABCDEFGHIJKLMNOPQRSTUVWXYZabcdefghijklmnopqrstuvwxyz0123456789+/";
  std::string letters;
  letters.reserve((bytes.size() + 2) / 3 * 4);
  for (std::size_t begin = 0; begin < bytes.size(); begin += 3) {
    const std::size_t count = bytes.size() - begin < 3 ? bytes.size() - begin : 3;
    std::uint32_t group = 0;
    for (std::size_t k = 0; k < 3; ++k) group = group << 8 | (k < count ? bytes[begin + k] : 0u);
    for (std::size_t k = 0; k < 4; ++k) letters += k <= count ? kLetters[group >> (18 - 6 * k) & 63] : '=';
  }
  return letters;
}

bool read_base64(std::span<const std::uint8_t>& letters, std::size_t count, std::vector<std::uint8_t>& bytes) {
  while (bytes.size() < count) {
    if (letters.size() < 4) return false;
    std::uint32_t group = 0;
    std::size_t padding = 0;
    for (std::size_t k = 0; k < 4; ++k) {
      const int value = base64_value(letters[k]);
      const bool pads = letters[k] == '=' && k >= 2;
      if (value < 0 && !pads) return false;
      if (value >= 0 && padding > 0) return false;
      padding += pads ? 1 : 0;
      group = group << 6 | static_cast<std::uint32_t>(pads ? 0 : value);
    }
    for (std::size_t k = 0; k < 3 - padding; ++k) bytes.push_back(static_cast<std::uint8_t>(group >> (16 - 8 * k)));
    letters = letters.subspan(4);
  }
  return true;
}

}  // namespace scarp::io
