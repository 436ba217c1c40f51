#include "las/decimal_axis.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <optional>
#include <string>

namespace scarp::las {
namespace {

constexpr int kMostDigits = 22;  // powers of ten up to here are doubles

/// digits · 10^exponent
struct Decimal {
  std::int64_t digits = 0;
  int exponent = 0;
};

/// The shortest decimal that rounds to the double.
Decimal shortest_decimal(double value) {
  const std::string text = fmt::format("{}", value);
  Decimal decimal;
  const std::size_t end = std::min(text.find('e'), text.size());
  bool is_fraction = false;
  for (std::size_t k = 0; k < end; ++k) {
    if (text[k] == '.') is_fraction = true;
    if (text[k] < '0' || text[k] > '9') continue;
    if (decimal.digits >= std::int64_t{100'000'000'000'000'000}) {  // trailing zeros of a large number
      decimal.exponent += is_fraction ? 0 : 1;
      continue;
    }
    decimal.digits = 10 * decimal.digits + (text[k] - '0');
    if (is_fraction) --decimal.exponent;
  }
  if (end < text.size()) decimal.exponent += std::stoi(text.substr(end + 1));
  if (text.starts_with('-')) decimal.digits = -decimal.digits;
  while (decimal.digits != 0 && decimal.digits % 10 == 0) {
    decimal.digits /= 10;
    ++decimal.exponent;
  }
  if (decimal.digits == 0) decimal.exponent = 0;
  return decimal;
}

/// decimal · 10^digits; nothing if it is beyond 10^35.
std::optional<Int128> scaled(const Decimal& decimal, int digits) {
  Int128 value = decimal.digits;
  constexpr Int128 kMost = Int128{100'000'000'000'000'000} * 100'000'000'000'000'000;
  for (int k = decimal.exponent + digits; k > 0; --k) {
    if (value > kMost || value < -kMost) return std::nullopt;
    value *= 10;
  }
  return value;
}

}  // namespace

DecimalAxis::DecimalAxis(double scale, double offset) : scale_(scale), offset_(offset) {
  const Decimal step = shortest_decimal(scale), start = shortest_decimal(offset);
  const int digits = std::max({0, -step.exponent, -start.exponent});
  if (digits > kMostDigits) return;
  const auto large_scale = scaled(step, digits), large_offset = scaled(start, digits);
  constexpr Int128 kMost = Int128{1} << 90;
  const auto size = [](Int128 value) { return value < 0 ? -value : value; };
  if (!large_scale || !large_offset || size(*large_scale) > kMost || size(*large_offset) > kMost) return;
  for (int k = 0; k < digits; ++k) power_ *= 10;
  large_scale_ = *large_scale;
  large_offset_ = *large_offset;
  way_ = Way::kLarge;
  constexpr Int128 kExact = Int128{1} << 53;
  if (size(large_scale_) >= kExact || size(large_scale_) * (Int128{1} << 31) + size(large_offset_) > kExact) return;
  small_scale_ = static_cast<double>(large_scale_);
  small_offset_ = static_cast<double>(large_offset_);
  way_ = Way::kSmall;
}

/// The quotient for a numerator of more than 53 bits: the quotient of its leading bits, corrected by the remainder.
double DecimalAxis::by_large(std::int32_t i) const {
  if (way_ == Way::kDoubles) return std::fma(static_cast<double>(i), scale_, offset_);
  const Int128 numerator = large_scale_ * i + large_offset_;
  const auto lead = static_cast<double>(numerator);
  const auto rest = static_cast<double>(numerator - static_cast<Int128>(lead));
  const double quotient = lead / power_;
  return quotient + (std::fma(-quotient, power_, lead) + rest) / power_;
}

}  // namespace scarp::las
