// The values of options: numbers, counts, and words to choose from.
#pragma once

#include <fmt/format.h>

#include <cstddef>
#include <cstdint>
#include <optional>
#include <string>
#include <string_view>

#include "scarp/result.h"
#include "session/text/text.h"

namespace scarp::cli {

/// The text of an option as the user gave it; nothing if not given. The functions below parse all values, so every
/// error names its option and value.
using Given = std::optional<std::string>;

/// The whole text as a number, including "inf" and "nan"; nothing for other text.
std::optional<double> find_number(std::string_view text);
/// Fails for a number out of range, such as 1e999.
Result<void> check_size(std::string_view option, const std::string& text, const std::optional<double>& value);
/// A finite number.
Result<double> parse_number(std::string_view option, const std::string& text);
/// A finite number that is at least 0.
Result<double> parse_non_negative(std::string_view option, const std::string& text);

/// A whole number that is at least `least`.
Result<std::uint64_t> parse_count(std::string_view option, const std::string& text, std::uint64_t least);
/// A word that an option accepts, and its value.
template <class T>
struct Choice {
  const char* name;
  T value;
};

/// The value of the word; otherwise fails with a list of all words.
template <class T, std::size_t N>
Result<T> choose(std::string_view option, const std::string& word, const Choice<T> (&choices)[N]) {
  std::string names;
  for (std::size_t k = 0; k < N; ++k) {
    if (word == choices[k].name) return choices[k].value;
    names += (k == 0 ? "" : k + 1 == N ? " or " : ", ") + std::string(choices[k].name);
  }
  return fail(ErrorKind::kUsage, fmt::format("{} {} is unknown: choose {}", option, shell_word(word), names));
}

/// The word for the value.
template <class T, std::size_t N>
const char* name_of(T value, const Choice<T> (&choices)[N]) {
  for (const Choice<T>& choice : choices) {
    if (choice.value == value) return choice.name;
  }
  return "";
}

}  // namespace scarp::cli
