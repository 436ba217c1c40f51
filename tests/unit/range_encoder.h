// The encoder for range_decoder.h and integer_decoder.h, written plainly, without code shared with them.
#pragma once

#include <algorithm>
#include <bit>
#include <cstddef>
#include <cstdint>
#include <map>
#include <vector>

namespace scarp::testing {

class RangeEncoder {
 public:
  /// Symbols counted so far, for adaptive probabilities.
  struct Model {
    std::vector<std::uint32_t> counts, below;
    std::uint32_t total = 0, cycle = 0, left = 0;

    explicit Model(std::uint32_t symbols) : counts(symbols, 1), below(symbols), cycle(symbols) {
      update();
      cycle = left = (symbols + 6) / 2;
    }
    void update() {
      const auto symbols = static_cast<std::uint32_t>(counts.size());
      total += cycle;
      if (total > 32768) {
        total = 0;
        for (std::uint32_t& count : counts) total += count = (count + 1) / 2;
      }
      std::uint32_t sum = 0;
      for (std::size_t k = 0; k < counts.size(); ++k) {
        below[k] = (0x80000000U / total * sum) >> 16;
        sum += counts[k];
      }
      cycle = std::min(5 * cycle / 4, 8 * (symbols + 6));
      left = cycle;
    }
  };
  struct Bit {
    std::uint32_t zeros = 1, total = 2, zero = 4096, cycle = 4, left = 4;
  };

  void encode(Model& model, std::uint32_t symbol) {
    const std::uint32_t unit = length_ >> 15, low = model.below[symbol] * unit;
    add(low, symbol + 1 < model.counts.size() ? model.below[symbol + 1] * unit - low : length_ - low);
    ++model.counts[symbol];
    if (--model.left == 0) model.update();
  }
  void encode(Bit& model, bool bit) {
    const std::uint32_t middle = model.zero * (length_ >> 13);
    add(bit ? middle : 0, bit ? length_ - middle : middle);
    model.zeros += bit ? 0 : 1;
    if (--model.left > 0) return;
    model.total += model.cycle;
    if (model.total > 8192) {
      model.total = (model.total + 1) / 2;
      model.zeros = (model.zeros + 1) / 2;
      if (model.zeros == model.total) ++model.total;
    }
    model.zero = model.zeros * (0x80000000U / model.total) >> 18;
    model.left = model.cycle = std::min(5 * model.cycle / 4, 64U);
  }
  void encode_bits(std::uint32_t bits, std::uint32_t count) {
    if (count > 19) {
      encode_bits(bits & 0xFFFF, 16);
      return encode_bits(bits >> 16, count - 16);
    }
    const std::uint32_t unit = length_ >> count;
    add(bits * unit, unit);
  }
  std::vector<std::uint8_t> finish() {
    const bool is_long = length_ > 0x02000000;
    add(is_long ? 0x01000000 : 0x00800000, is_long ? 0x00800000 : 0x00008000);
    bytes_.resize(bytes_.size() + (is_long ? 3 : 2));
    return bytes_;
  }

 private:
  void add(std::uint32_t low, std::uint32_t length) {
    const std::uint32_t before = base_;
    base_ += low;
    length_ = length;
    if (base_ < before) {
      std::size_t k = bytes_.size();
      while (++bytes_[--k] == 0) {
      }
    }
    for (; length_ < 0x01000000; length_ <<= 8, base_ <<= 8) bytes_.push_back(static_cast<std::uint8_t>(base_ >> 24));
  }

  std::vector<std::uint8_t> bytes_;
  std::uint32_t base_ = 0, length_ = 0xFFFFFFFFU;
};

/// Encodes differences to predictions.
class IntegerEncoder {
 public:
  explicit IntegerEncoder(std::uint32_t bits) : bits_(bits) {}

  void encode(RangeEncoder& encoder, std::int32_t predicted, std::int32_t real, std::uint32_t context) {
    auto difference = static_cast<std::int64_t>(
        static_cast<std::int32_t>(static_cast<std::uint32_t>(real) - static_cast<std::uint32_t>(predicted)));
    const std::int64_t range = bits_ < 32 ? std::int64_t{1} << bits_ : 0;
    if (range > 0 && difference < -range / 2) difference += range;
    if (range > 0 && difference > range / 2 - 1) difference -= range;
    k = static_cast<std::uint32_t>(
        std::bit_width(static_cast<std::uint64_t>(difference <= 0 ? -difference : difference - 1)));
    encoder.encode(sizes_.try_emplace(context, bits_ + 1).first->second, k);
    if (k == 0) return encoder.encode(bit_, difference == 1);
    if (k == 32) return;
    const auto folded =
        static_cast<std::uint32_t>(difference < 0 ? difference + (std::int64_t{1} << k) - 1 : difference - 1);
    auto& model = high_.try_emplace(k, 1U << std::min(k, 8U)).first->second;
    encoder.encode(model, k <= 8 ? folded : folded >> (k - 8));
    if (k > 8) encoder.encode_bits(folded & ((1U << (k - 8)) - 1), k - 8);
  }

  std::uint32_t k = 0;

 private:
  std::uint32_t bits_;
  std::map<std::uint32_t, RangeEncoder::Model> sizes_, high_;
  RangeEncoder::Bit bit_;
};

}  // namespace scarp::testing
