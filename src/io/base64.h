// Base64.
#pragma once

#include <cstdint>
#include <span>
#include <string>
#include <vector>

namespace scarp::io {

std::string write_base64(std::span<const std::uint8_t> bytes);

/// Reads groups of four letters until `count` bytes are decoded; a padded group ends a part, and decoding continues
/// with the next part. Returns false if letters are missing or invalid.
bool read_base64(std::span<const std::uint8_t>& letters, std::size_t count, std::vector<std::uint8_t>& bytes);

}  // namespace scarp::io
