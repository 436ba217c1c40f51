// Scripts: one step a line.
#include "io/script.h"

#include <fmt/format.h>

#include <algorithm>

#include "base/caught.h"
#include "io/mesh_file_text.h"

namespace scarp {
namespace {

/// A word from a file that may be anything, fit for a sentence.
std::string quoted(std::string_view word) {
  constexpr std::size_t kMost = 30;
  const bool plain = std::all_of(word.begin(), word.end(), [](char c) { return c > ' ' && c < 127; });
  return plain && word.size() <= kMost ? fmt::format("'{}'", word) : "something that is no word";
}

/// The complaint about the line at which the cursor stands; empty if there is none. Leaves the cursor within the line.
std::string read_line(TextCursor& cursor, int cols, int rows, std::vector<ScriptStep>& steps) {
  const auto next = [&] {
    const std::string_view word = cursor.word();
    return word.starts_with('#') ? std::string_view() : word;
  };
  const std::string_view action = next();
  if (action.empty()) return {};
  if (action != "s" && action != "i" && action != "u") {
    return fmt::format("{} is none of s (insert), i (ignore) and u (unknown)", quoted(action));
  }
  std::int64_t place[2] = {};
  for (std::int64_t& number : place) {
    const std::string_view word = next();
    if (word.empty()) return fmt::format("'{}' needs a column and a row", action);
    if (!parse_integer(word, number)) return fmt::format("{} is no whole number", quoted(word));
  }
  if (const std::string_view more = next(); !more.empty()) {
    return fmt::format("{} stands behind the column and the row", quoted(more));
  }
  if (place[0] < 0 || place[0] >= cols || place[1] < 0 || place[1] >= rows) {
    return fmt::format("({}, {}) lies outside of the raster, whose columns are 0 to {} and rows 0 to {}", place[0],
                       place[1], cols - 1, rows - 1);
  }
  steps.push_back({action == "s" ? ScriptStep::Action::kInsert : ScriptStep::Action::kIgnore,
                   static_cast<std::int32_t>(place[0]), static_cast<std::int32_t>(place[1])});
  return {};
}

}  // namespace

Result<std::vector<ScriptStep>> decode_script(std::span<const std::uint8_t> bytes, const std::string& name, int cols,
                                              int rows) {
  TextCursor cursor(bytes);
  std::vector<ScriptStep> steps;
  while (!cursor.at_end()) {
    const std::size_t line = cursor.line();
    if (const std::string why = read_line(cursor, cols, rows, steps); !why.empty()) {
      return fail(ErrorKind::kInput, fmt::format("{}: line {}: {}", name, line, why));
    }
    cursor.rest_of_line();
  }
  return steps;
}

Result<std::vector<ScriptStep>> read_script(const std::string& path, int cols, int rows) try {
  auto bytes = read_file(path);
  if (!bytes) return tl::unexpected(bytes.error());
  return decode_script(*bytes, path, cols, rows);
} catch (...) {
  return caught(ErrorKind::kInput, "read " + path);
}

}  // namespace scarp
