// Scripts: one step per line.
#include "io/raster/script.h"

#include <fmt/format.h>

#include <optional>
#include <unordered_map>
#include <utility>

#include "base/caught.h"
#include "io/mesh/mesh_file_text.h"

namespace scarp {
namespace {

struct Step {
  SampleAt at;
  bool inserts = false;
};

/// Returns a complaint about the cursor's line, or an empty string. The cursor stays within the line.
std::string read_line(io::TextCursor& cursor, int cols, int rows, std::optional<Step>& step) {
  const auto next = [&] {
    const std::string_view word = cursor.word();
    return word.starts_with('#') ? std::string_view() : word;
  };
  const std::string_view action = next();
  if (action.empty()) return {};
  if (action != "s" && action != "i" && action != "u") {
    return fmt::format("{} is none of s (insert), i (ignore) and u (unknown)", io::in_quotes(action));
  }
  std::int64_t place[2] = {};
  for (std::int64_t& number : place) {
    const std::string_view word = next();
    if (word.empty()) return fmt::format("'{}' needs a column and a row", action);
    if (!io::parse_integer(word, number)) return fmt::format("{} is no whole number", io::in_quotes(word));
  }
  if (const std::string_view more = next(); !more.empty()) {
    return fmt::format("{} stands behind the column and the row", io::in_quotes(more));
  }
  if (place[0] < 0 || place[0] >= cols || place[1] < 0 || place[1] >= rows) {
    return fmt::format("({}, {}) lies outside of the raster, whose columns are 0 to {} and rows 0 to {}", place[0],
                       place[1], cols - 1, rows - 1);
  }
  step = Step{{static_cast<std::int32_t>(place[0]), static_cast<std::int32_t>(place[1])}, action == "s"};
  return {};
}

/// The steps of previous lines for each sample.
class Said {
 public:
  /// Returns a complaint if an earlier line requests the opposite, or an empty string.
  std::string add(const Step& step, std::size_t line) {
    const auto key = (static_cast<std::uint64_t>(step.at.row) << 32) | static_cast<std::uint32_t>(step.at.col);
    const auto [found, is_new] = samples_.try_emplace(key, step.inserts, line);
    const auto& [inserts, earlier] = found->second;
    if (is_new || inserts == step.inserts) return {};
    return fmt::format("sample ({}, {}) is {}, but line {} {} it: remove one of the two", step.at.col, step.at.row,
                       step.inserts ? "inserted" : "ignored", earlier, step.inserts ? "ignores" : "inserts");
  }

 private:
  std::unordered_map<std::uint64_t, std::pair<bool, std::size_t>> samples_;
};

}  // namespace

Result<Script> io::decode_script(std::span<const std::uint8_t> bytes, const std::string& name, int cols, int rows) {
  TextCursor cursor(bytes);
  Script script;
  Said said;
  while (!cursor.at_end()) {
    const std::size_t line = cursor.line();
    std::optional<Step> step;
    std::string why = read_line(cursor, cols, rows, step);
    if (step) {
      why = said.add(*step, line);
      (step->inserts ? script.inserted : script.ignored).push_back(step->at);
    }
    if (!why.empty()) return fail(ErrorKind::kInput, fmt::format("{}: line {}: {}", name, line, why));
    cursor.rest_of_line();
  }
  return script;
}

Result<Script> read_script(const std::string& path, int cols, int rows) try {
  SCARP_TRY(auto&& bytes, read_file(path));
  return io::decode_script(bytes, path, cols, rows);
} catch (...) {
  return caught(ErrorKind::kInput, "read " + path);
}

}  // namespace scarp
