// Decodes integers of LAZ files, written by the integer compressor of the LASzip specification. It stores the number k
// of bits of the difference from a prediction, then these bits.
#pragma once

#include <algorithm>
#include <array>
#include <cstdint>

#include "las/range_decoder.h"

namespace scarp::las {

/// Decodes predicted integers of kBits bits. Each of kContexts contexts has its own statistics.
template <unsigned kBits, unsigned kContexts>
class IntegerDecoder {
 public:
  void forget() {
    for (auto& model : sizes_) model.forget();
    for (auto& model : high_bits_) model.forget();
    bit_ = {};
  }

  /// Sums wrap around.
  std::int32_t decode(RangeDecoder& decoder, std::int32_t predicted, unsigned context) {
    std::uint32_t value = static_cast<std::uint32_t>(predicted) + decode_difference(decoder, context);
    if constexpr (kBits < 32) value &= (1U << kBits) - 1;
    return static_cast<std::int32_t>(value);
  }

  /// The number of bits of the last difference, a context for other fields.
  unsigned k() const { return k_; }

 private:
  static constexpr unsigned kBitsAtOnce = 8;

  std::uint32_t decode_difference(RangeDecoder& decoder, unsigned context) {
    auto& size = sizes_[context];
    if (!size.is_begun()) size.begin(kBits + 1);
    k_ = decoder.decode(size);
    if (k_ == 0) return decoder.decode(bit_) ? 1 : 0;
    if (k_ >= 32) return 0x80000000U;
    auto& model = high_bits_[k_ - 1];
    if (!model.is_begun()) model.begin(1U << std::min(k_, kBitsAtOnce));
    std::uint32_t bits = decoder.decode(model);
    if (k_ > kBitsAtOnce) bits = bits << (k_ - kBitsAtOnce) | decoder.decode_bits(k_ - kBitsAtOnce);
    // The upper half of the bits stands for 2^(k-1) + 1 to 2^k, the lower half for 1 - 2^k to -2^(k-1).
    return bits >= 1U << (k_ - 1) ? bits + 1 : bits - ((1U << k_) - 1);
  }

  unsigned k_ = 0;
  std::array<SymbolModel<kBits + 1>, kContexts> sizes_;
  std::array<SymbolModel<256>, (kBits < 32 ? kBits : 31)> high_bits_;
  BitModel bit_;
};

}  // namespace scarp::las
