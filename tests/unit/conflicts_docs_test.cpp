// docs/conflicts.md holds the library's table. With SCARP_UPDATE_DOCS=1 this test writes it.
#include <gtest/gtest.h>

#include <string>

#include "docs_tables.h"
#include "scarp/conflicts.h"
#include "session/table/field_options.h"

namespace scarp::conflicts_docs_test {
namespace {

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

TEST(conflicts_docs, hold_the_table_of_the_library) {
  test::expect_tables("docs/conflicts.md", {{kHead, make_table()}, {kTileHead, make_tile_table()}}, "conflicts_docs.*");
}

}  // namespace
}  // namespace scarp::conflicts_docs_test
