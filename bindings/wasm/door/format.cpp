#include <fmt/format.h>

#include <iterator>

extern "C" {
/// Prints a number in ASCII and returns its length, at most 400. Style: e, f, g; precision -1: the fewest digits.
__attribute__((import_module("scarp"), import_name("number"))) std::int32_t scarp_number(
    double value, std::int32_t is_float, std::int32_t style, std::int32_t precision, char* out);
}

namespace fmt::detail {
namespace {

void add_natural(std::string& text, std::uint64_t value) {
  char digits[20];
  char* first = std::end(digits);
  do *--first = static_cast<char>('0' + value % 10);
  while (value /= 10);
  text.append(first, std::end(digits));
}

void add(std::string& text, const Argument& argument, const Spec& spec) {
  using enum Argument::Kind;
  switch (argument.kind) {
    case kText:
      text.append(argument.text, argument.length);
      return;
    case kUnsigned:
      add_natural(text, argument.natural);
      return;
    case kSigned: {
      const bool is_negative = argument.integer < 0;
      if (is_negative) text += '-';
      add_natural(text, is_negative ? 0 - argument.natural : argument.natural);
      return;
    }
    default: {
      char digits[400];
      const std::int32_t count =
          scarp_number(argument.number, argument.kind == kFloat ? 1 : 0, spec.style, spec.precision, digits);
      if (spec.has_sign && digits[0] != '-') text += '+';
      text.append(digits, static_cast<std::size_t>(count));
    }
  }
}

}  // namespace

std::string print(std::string_view format, const Argument* arguments) {
  std::string text;
  std::size_t next = 0;
  for (std::size_t at = 0; at < format.size();) {
    const char letter = format[at++];
    const bool is_brace = letter == '{' || letter == '}';
    if (!is_brace || format[at] == letter) {
      text += letter;
      at += is_brace ? 1 : 0;
      continue;
    }
    std::size_t index = next++;
    Spec spec;
    read_field(format, at, index, spec);
    add(text, arguments[index], spec);
  }
  return text;
}

}  // namespace fmt::detail
