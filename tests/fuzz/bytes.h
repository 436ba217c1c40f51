// The input of a fuzzer as a sequence of choices.
#pragma once

#include <cstddef>
#include <cstdint>

/// Reads bytes in order; returns zeros after the end.
class Bytes {
 public:
  Bytes(const std::uint8_t* data, std::size_t size) : data_(data), left_(size) {}
  std::uint8_t next() {
    if (left_ == 0) return 0;
    --left_;
    return *data_++;
  }
  /// A choice of 0 … n - 1 from two bytes.
  std::int32_t below(std::int32_t n) {
    const std::int32_t high = next();
    return (high << 8 | next()) % n;
  }
  std::size_t left() const { return left_; }

 private:
  const std::uint8_t* data_;
  std::size_t left_;
};
