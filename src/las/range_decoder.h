// The entropy decoder of LAZ files: the arithmetic coder of "Introduction to Arithmetic Coding Theory and Practice" (HP
// Labs report HPL-2004-76), with 32-bit intervals and adaptive models, used as in M. Isenburg's "LASzip: lossless
// compression of LiDAR data" (PE&RS 79(2), 2013) and the LASzip specification (R13).
//
// Bytes beyond the end are read as zeros and counted. Callers check is_exhausted() once per point.
#pragma once

#include <algorithm>
#include <array>
#include <cstddef>
#include <cstdint>
#include <span>

namespace scarp::las {

/// Adaptive probabilities of up to kMost symbols. Empty until begin() is called.
template <unsigned kMost>
class SymbolModel {
 public:
  bool is_begun() const { return symbols_ != 0; }
  void forget() { symbols_ = 0; }

  /// Gives all symbols equal probabilities.
  void begin(unsigned symbols) {
    symbols_ = symbols;
    table_bits_ = 0;
    if (symbols > 16) {
      table_bits_ = 3;
      while (symbols > 1U << (table_bits_ + 2)) ++table_bits_;
    }
    std::fill_n(counts_.begin(), symbols, std::uint16_t{1});
    total_ = 0;
    cycle_ = symbols;
    update();
    cycle_ = until_update_ = (symbols + 6) / 2;
  }

 private:
  friend class RangeDecoder;
  static constexpr unsigned kShift = 15;

  void count(unsigned symbol) {
    ++counts_[symbol];
    if (--until_update_ == 0) update();
  }

  /// Recomputes the cumulative distribution from the counts, and the table that narrows the search in it.
  [[gnu::noinline]] void update() {
    total_ += cycle_;
    if (total_ > 1U << kShift) {
      total_ = 0;
      for (unsigned k = 0; k < symbols_; ++k) total_ += counts_[k] = static_cast<std::uint16_t>((counts_[k] + 1) / 2);
    }
    const std::uint32_t scale = 0x80000000U / total_;
    std::uint32_t sum = 0;
    for (unsigned k = 0; k < symbols_; ++k) {
      below_[k] = static_cast<std::uint16_t>((scale * sum) >> (31 - kShift));
      sum += counts_[k];
    }
    if (table_bits_ > 0) fill_table();
    cycle_ = std::min(5 * cycle_ / 4, 8 * (symbols_ + 6));
    until_update_ = cycle_;
  }

  void fill_table() {
    unsigned filled = 0;
    table_[0] = 0;
    for (unsigned k = 1; k < symbols_; ++k) {
      for (const unsigned place = below_[k] >> (kShift - table_bits_); filled < place;)
        table_[++filled] = static_cast<std::uint16_t>(k - 1);
    }
    while (filled <= 1U << table_bits_) table_[++filled] = static_cast<std::uint16_t>(symbols_ - 1);
  }

  static constexpr unsigned kTable = kMost > 512 ? 258 : kMost > 256 ? 130 : kMost > 128 ? 66 : kMost > 64 ? 34 : 18;
  unsigned symbols_ = 0, table_bits_ = 0;
  std::uint32_t total_ = 0, cycle_ = 0, until_update_ = 0;
  std::array<std::uint16_t, kMost> below_;   ///< cumulative probabilities, in 2^-15
  std::array<std::uint16_t, kMost> counts_;  ///< how often each was decoded
  std::array<std::uint16_t, kTable> table_;
};

/// The adaptive probability of one bit.
class BitModel {
 private:
  friend class RangeDecoder;
  static constexpr unsigned kShift = 13;

  void count(bool bit) {
    zeros_ += bit ? 0 : 1;
    if (--until_update_ == 0) update();
  }
  void update() {
    total_ += cycle_;
    if (total_ > 1U << kShift) {
      total_ = (total_ + 1) / 2;
      zeros_ = (zeros_ + 1) / 2;
      if (zeros_ == total_) ++total_;
    }
    zero_ = (zeros_ * (0x80000000U / total_)) >> (31 - kShift);
    cycle_ = std::min(5 * cycle_ / 4, 64U);
    until_update_ = cycle_;
  }

  std::uint32_t zeros_ = 1, total_ = 2, zero_ = 1U << (kShift - 1), cycle_ = 4, until_update_ = 4;
};

class RangeDecoder {
 public:
  RangeDecoder() = default;
  explicit RangeDecoder(std::span<const std::uint8_t> bytes) : at_(bytes.data()), end_(bytes.data() + bytes.size()) {
    for (int k = 0; k < 4; ++k) value_ = value_ << 8 | next_byte();
    value_ = std::min(value_, length_ - 1);  // no encoder writes more
  }

  /// True once more has been decoded than the bytes hold. Encoders may omit the last few bytes if they are zeros.
  bool is_exhausted() const { return missing_ > 4; }

  template <unsigned kMost>
  unsigned decode(SymbolModel<kMost>& model) {
    const std::uint32_t unit = length_ >> SymbolModel<kMost>::kShift;
    const std::uint16_t* const below = model.below_.data();
    unsigned symbol = 0, end = model.symbols_;
    if (model.table_bits_ > 0) {
      const std::uint32_t wanted = value_ / unit;
      const std::uint32_t place = wanted >> (SymbolModel<kMost>::kShift - model.table_bits_);
      symbol = model.table_[place];
      end = model.table_[place + 1] + 1U;
      while (end > symbol + 1) {
        const unsigned middle = (symbol + end) / 2;
        (below[middle] > wanted ? end : symbol) = middle;
      }
    } else {
      while (end > symbol + 1) {
        const unsigned middle = (symbol + end) / 2;
        (below[middle] * unit > value_ ? end : symbol) = middle;
      }
    }
    const std::uint32_t low = below[symbol] * unit;
    const std::uint32_t high = symbol + 1 < model.symbols_ ? below[symbol + 1] * unit : length_;
    narrow(low, high);
    model.count(symbol);
    return symbol;
  }

  bool decode(BitModel& model) {
    const std::uint32_t middle = model.zero_ * (length_ >> BitModel::kShift);
    const bool bit = value_ >= middle;
    narrow(bit ? middle : 0, bit ? length_ : middle);
    model.count(bit);
    return bit;
  }

  /// Decodes bits of equal probability. REQUIRES: 1 <= count <= 32.
  std::uint32_t decode_bits(unsigned count) {
    if (count <= 19) return decode_few_bits(count);
    const std::uint32_t low = decode_few_bits(16) & 0xFFFF;
    return low | decode_few_bits(count - 16) << 16;
  }

 private:
  std::uint32_t decode_few_bits(unsigned count) {
    length_ >>= count;
    const std::uint32_t bits = value_ / length_;
    value_ -= length_ * bits;
    renormalize();
    return bits;
  }
  void narrow(std::uint32_t low, std::uint32_t high) {
    value_ -= low;
    length_ = high - low;
    renormalize();
  }
  void renormalize() {
    while (length_ < 1U << 24) {
      value_ = value_ << 8 | next_byte();
      length_ <<= 8;
    }
  }
  std::uint32_t next_byte() {
    if (at_ != end_) [[likely]]
      return *at_++;
    ++missing_;
    return 0;
  }

  const std::uint8_t *at_ = nullptr, *end_ = nullptr;
  std::uint32_t value_ = 0, length_ = 0xFFFFFFFFU, missing_ = 0;
};

}  // namespace scarp::las
