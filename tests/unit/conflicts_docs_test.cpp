// docs/conflicts.md holds the library's table. With SCARP_UPDATE_DOCS=1 this test writes it.
#include <gtest/gtest.h>

#include <cstdlib>
#include <fstream>
#include <sstream>
#include <string>
#include <vector>

#include "options/field_options.h"
#include "scarp/conflicts.h"
#include "source_dir.h"

namespace scarp::conflicts_docs_test {
namespace {

const std::string kPath = source_dir() + "/docs/conflicts.md";

/// The option where there is one, else the library's word; what only a value of an option tells stands behind it.
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
  if (const char* option = cli::option_of(field)) return "`" + std::string(option) + "`";
  return "`" + std::string(name_of(field)) + "`";
}

std::string words_of(Fields fields) {
  // What the program's options do not tell apart.
  if (fields.has(Field::kTolerance)) fields = fields.without(Field::kToleranceSource);
  if (fields.has(Field::kMask)) fields = fields.without(Field::kMaskSource);
  std::string words;
  for (int k = 0; k < kFieldCount; ++k) {
    if (fields.has(static_cast<Field>(k))) words += (words.empty() ? "" : ", ") + word_of(static_cast<Field>(k));
  }
  return words;
}

std::string make_table() {
  std::string table = "| setting | does not go with | if there is also | because |\n|---|---|---|---|\n";
  for (const ConflictRule& rule : conflict_rules()) {
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
  std::stringstream read;
  read << std::ifstream(kPath).rdbuf();
  const std::string text = read.str();
  const std::size_t begin = text.find("| setting |"), end = text.find("\n\n", begin);
  ASSERT_NE(begin, std::string::npos);
  ASSERT_NE(end, std::string::npos);
  const std::string made = text.substr(0, begin) + make_table() + text.substr(end + 1);
  const char* update = std::getenv("SCARP_UPDATE_DOCS");
  if (update != nullptr && std::string(update) == "1") std::ofstream(kPath) << made;
  EXPECT_TRUE(made == text || update != nullptr)
      << "docs/conflicts.md is not the library's table; write it with\n"
         "  SCARP_UPDATE_DOCS=1 build/bin/scarp_tests --gtest_filter='conflicts_docs.*'";
}

}  // namespace
}  // namespace scarp::conflicts_docs_test
