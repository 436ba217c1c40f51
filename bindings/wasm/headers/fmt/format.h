// The part of {fmt} that the core uses. The tables and float printing of {fmt} would be a quarter of a small module.
// Here, JavaScript prints numbers. An unknown format is a compile-time error.
#pragma once

#include <cstddef>
#include <cstdint>
#include <string>
#include <string_view>
#include <type_traits>

namespace fmt {

/// `precision` -1: the fewest digits that round-trip.
struct Spec {
  char style = 'g';  ///< e, f, g
  bool has_sign = false;
  int precision = -1;
};

struct Argument {
  enum class Kind : std::uint8_t { kSigned, kUnsigned, kDouble, kFloat, kText } kind;
  union {
    std::int64_t integer;
    std::uint64_t natural;
    double number;
    struct {
      const char* text;
      std::size_t length;
    };
  };
};

namespace detail {

/// Parses the text after `{`, at `at`: [INDEX] [:[+].PRECISION(e|f|g)] and `}`. False for other text.
constexpr bool read_field(std::string_view text, std::size_t& at, std::size_t& index, Spec& spec) {
  const auto is_digit = [&] { return at < text.size() && text[at] >= '0' && text[at] <= '9'; };
  const auto take = [&](char what) { return at < text.size() && text[at] == what && ++at; };
  const auto number = [&] {
    std::size_t value = 0;
    for (; is_digit(); ++at) value = 10 * value + static_cast<std::size_t>(text[at] - '0');
    return value;
  };
  if (is_digit()) index = number();
  if (take(':')) {
    spec.has_sign = take('+');
    if (!take('.') || !is_digit()) return false;
    spec.precision = static_cast<int>(number());
    if (at == text.size() || text[at] < 'e' || text[at] > 'g') return false;
    spec.style = text[at++];
  }
  return take('}');
}

template <std::size_t Count>
struct Format {
  template <class Text>
  consteval Format(const Text& given) : text(given) {
    std::size_t next = 0;
    for (std::size_t at = 0; at < text.size();) {
      const char letter = text[at++];
      if (letter != '{' && letter != '}') continue;
      if (at < text.size() && text[at] == letter) {
        ++at;
        continue;
      }
      std::size_t index = next++;
      Spec spec;
      if (letter == '}' || !read_field(text, at, index, spec) || index >= Count)
        throw "a format that is not known here";
    }
  }
  std::string_view text;
};

template <class T>
Argument argument(const T& value) {
  Argument made;
  if constexpr (std::is_same_v<T, float> || std::is_same_v<T, double>) {
    made.kind = std::is_same_v<T, float> ? Argument::Kind::kFloat : Argument::Kind::kDouble;
    made.number = value;
  } else if constexpr (std::is_integral_v<T>) {
    static_assert(!std::is_same_v<T, bool> && !std::is_same_v<T, char>);
    made.kind = std::is_signed_v<T> ? Argument::Kind::kSigned : Argument::Kind::kUnsigned;
    if constexpr (std::is_signed_v<T>)
      made.integer = value;
    else
      made.natural = value;
  } else {
    const std::string_view text(value);
    made.kind = Argument::Kind::kText;
    made.text = text.data();
    made.length = text.size();
  }
  return made;
}

std::string print(std::string_view format, const Argument* arguments);

}  // namespace detail

template <class... T>
std::string format(detail::Format<sizeof...(T)> format, const T&... values) {
  const Argument arguments[] = {detail::argument(values)..., Argument{}};
  return detail::print(format.text, arguments);
}
template <class Out, class... T>
Out format_to(Out out, detail::Format<sizeof...(T)> format, const T&... values) {
  const Argument arguments[] = {detail::argument(values)..., Argument{}};
  for (const char letter : detail::print(format.text, arguments)) *out++ = static_cast<std::uint8_t>(letter);
  return out;
}

}  // namespace fmt
