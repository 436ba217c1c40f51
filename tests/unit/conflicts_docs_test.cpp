// docs/conflicts.md holds the library's table. With SCARP_UPDATE_DOCS=1 this test writes it.
#include <gtest/gtest.h>

#include <cstdlib>
#include <fstream>
#include <sstream>
#include <string>
#include <vector>

#include "scarp/conflicts.h"
#include "session/table/field_options.h"
#include "source_dir.h"

namespace scarp::conflicts_docs_test {
namespace {

const std::string kPath = source_dir() + "/docs/conflicts.md";

/// The option where there is one, else the library's word; a value of an option stands behind it where only that sets
/// it.
std::string word_of(Field field) {
  switch (field) {
    case Field::kIgnored:
      return "`--script` (lines `i`, `u`)";
    case Field::kPoints:
      return "`--script` (lines `s`)";
    case Field::kMaskSource:
      return "`--mask` (streamed)";
    case Field::kTolerance:
      return "`--tolerance`, `--roi`";
    case Field::kToleranceSource:
      return "`--tolerance`, `--roi` (streamed)";
    case Field::kBreaklines:
      return "`--breaklines`, `--water`, `--rivers`, `--cliff`, `--ridges`";
    case Field::kStrategy:
      return "`--importance`, `--one-pass`, `--algorithm`, `--batch`, `--edges data`";
    case Field::kShape:
      return "`--min-angle`, `--max-edge`, `--grade`";
    case Field::kChannels:
      return "`--texture`, `--image`";
    case Field::kCurvedFrame:
      return "`--crs` (of another projection)";
    case Field::kSpaceFrame:
      return "`--crs enu`, `--crs EPSG:4978`";
    case Field::kSource:
      return "`--memory` (where samples are streamed)";
    default:
      break;
  }
  if (const cli::OptionTerm option = cli::option_of(field); option.id != cli::OptionId::kNone)
    return "`" + cli::name_of(option) + "`";
  return "`" + std::string(name_of(field)) + "`";
}

std::string words_of(Fields fields) {
  // Differences that the program's options do not show.
  if (fields.has(Field::kTolerance)) fields = fields.without(Field::kToleranceSource);
  if (fields.has(Field::kMask)) fields = fields.without(Field::kMaskSource);
  std::string words;
  for (int k = 0; k < kFieldCount; ++k) {
    if (fields.has(static_cast<Field>(k))) words += (words.empty() ? "" : ", ") + word_of(static_cast<Field>(k));
  }
  return words;
}

bool is_of_tiles(const ConflictRule& rule) {
  for (int k = kSimplifyFieldCount; k < kFieldCount; ++k) {
    if (rule.one.has(static_cast<Field>(k))) return true;
  }
  return false;
}

const std::string kHead = "| setting | ", kTileHead = "| setting of tiles | ";

std::string make_tile_table() {
  std::string table = kTileHead + "does not go with | because |\n|---|---|---|\n";
  for (const ConflictRule& rule : conflict_rules()) {
    if (!is_of_tiles(rule)) continue;
    table += "| " + words_of(rule.one) + " | " + words_of(rule.other) + " | " + rule.reason + " |\n";
  }
  return table;
}

std::string make_table() {
  std::string table = kHead + "does not go with | if there is also | because |\n|---|---|---|---|\n";
  for (const ConflictRule& rule : conflict_rules()) {
    if (is_of_tiles(rule)) continue;
    // The program reads the weights and tolerances of streamed samples as these.
    const bool is_of_source = rule.one.has(Field::kSource);
    const Fields other = is_of_source ? rule.other.without(Field::kTolerance).without(Field::kMask) : rule.other;
    if (other.empty()) continue;
    const bool is_said = rule.one.has(Field::kSource) || rule.where == Where::kAlways;
    const std::string where = rule.where == Where::kInMemory ? "samples in memory" : "streamed samples";
    const std::string beside = is_said ? words_of(rule.beside) : where;
    table += "| " + words_of(rule.one) + " | " + words_of(other) + " | " + beside + " | " + rule.reason + " |\n";
  }
  return table;
}

/// The text with the table that begins so replaced; empty where it holds none.
std::string replace_table(const std::string& text, const std::string& head, const std::string& table) {
  const std::size_t begin = text.find(head), end = text.find("\n\n", begin);
  return begin == std::string::npos || end == std::string::npos ? ""
                                                                : text.substr(0, begin) + table + text.substr(end + 1);
}

TEST(conflicts_docs, hold_the_table_of_the_library) {
  std::stringstream read;
  read << std::ifstream(kPath).rdbuf();
  const std::string text = read.str();
  const std::string made = replace_table(replace_table(text, kHead, make_table()), kTileHead, make_tile_table());
  ASSERT_NE(made, "");
  const char* update = std::getenv("SCARP_UPDATE_DOCS");
  if (update != nullptr && std::string(update) == "1") std::ofstream(kPath) << made;
  EXPECT_TRUE(made == text || update != nullptr)
      << "docs/conflicts.md is not the library's table; write it with\n"
         "  SCARP_UPDATE_DOCS=1 build/bin/scarp_tests --gtest_filter='conflicts_docs.*'";
}

}  // namespace
}  // namespace scarp::conflicts_docs_test
