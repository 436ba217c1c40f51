// The table of options in the program's use: parts, ranges, rules and the canonical command.
#include "session/options/given_options.h"

#include <gtest/gtest.h>

#include <CLI/CLI.hpp>
#include <algorithm>
#include <cmath>
#include <set>
#include <string>
#include <vector>

#include "session/options/option_rules.h"

namespace scarp::cli {
namespace {

using enum OptionId;
using Words = std::vector<std::string>;

/// The error for the words of a command; empty if valid.
std::string parse(GivenOptions& given, Words words) {
  CLI::App program;
  given.add_to(program);
  words.insert(words.begin(), command_name(given.command()));
  std::reverse(words.begin(), words.end());
  try {
    program.parse(words);
  } catch (const CLI::ParseError& error) {
    return error.what();
  }
  return "";
}

std::string canonical(Words words) {
  GivenOptions given(kSimplify);
  words.insert(words.begin(), {"in.tif", "out.glb", "--max-error", "1"});
  EXPECT_EQ(parse(given, words), "");
  return given.canonical();
}

std::vector<const OptionRow*> rows_with_values() {
  std::vector<const OptionRow*> rows = accepted_rows(kSimplify);
  std::erase_if(rows, [](const OptionRow* row) {
    return row->is_argument() || row->type == OptionType::kFlag || row->value_count() != 1;
  });
  return rows;
}

TEST(GivenOptions, PartsStandBehindTheValueOfTheirOption) {
  GivenOptions given(kSimplify);
  ASSERT_EQ(parse(given, {"in.tif", "out.glb", "--cutline", "site,2.gpkg:roads,inset=-2.5,whole-cells"}), "");
  EXPECT_EQ(given.all(kCutline), Words{"site,2.gpkg:roads"});
  EXPECT_EQ(given[kInset], "-2.5");
  EXPECT_TRUE(given.has(kMaskOutside));
}

TEST(GivenOptions, APartNeedsNoValueOfItsOption) {
  GivenOptions given(kSimplify);
  ASSERT_EQ(parse(given, {"in.tif", "out.glb", "--water", "flats=200"}), "");
  EXPECT_TRUE(given.all(kWater).empty());
  EXPECT_EQ(given[kDetectFlats], "200");
}

TEST(GivenOptions, AFlagOfAPartHasNoValue) {
  GivenOptions given(kSimplify);
  EXPECT_NE(parse(given, {"in.tif", "out.glb", "--cutline", "a.gpkg,whole-cells=1"}).find("--cutline whole-cells"),
            std::string::npos);
}

TEST(GivenOptions, ARegionHasNoOtherKeyThanFalloff) {
  const auto refusal = [](const std::string& value) {
    GivenOptions given(kSimplify);
    return parse(given, {"in.tif", "out.glb", "-e", "5", "--roi", value});
  };
  const std::string unknown = "--roi has no key fallof: choose falloff";
  EXPECT_EQ(refusal("a.geojson=0.1,fallof=3"), unknown);
  EXPECT_EQ(refusal("a.geojson,fallof=3"), unknown);
  EXPECT_EQ(refusal("a.geojson=0.1,blur=3"), "--roi has no key blur: choose falloff");
  EXPECT_EQ(refusal("a.geojson=0.1,falloff=3m"), "");
  EXPECT_EQ(refusal("a,b=3"), "");
  EXPECT_EQ(refusal("a=1.geojson=3"), "");
}

TEST(GivenOptions, UnknownKeysAndRepeatedPartsAreRefused) {
  GivenOptions given(kSimplify), twice(kSimplify);
  EXPECT_EQ(parse(given, {"in.tif", "out.glb", "--cutline", "a.gpkg,insett=1"}),
            "--cutline has no key insett: choose inset or whole-cells");
  EXPECT_EQ(parse(twice, {"in.tif", "out.glb", "--cutline", "a.gpkg,inset=1", "--inset", "2"}),
            "--cutline inset is given more than once");
}

TEST(GivenOptions, OldSpellingsAreTheSameCommand) {
  EXPECT_EQ(canonical({"--cutline", "a/b.gpkg,inset=2,whole-cells"}),
            canonical({"--cutline", "a/b.gpkg", "--inset", "2", "--mask-outside"}));
  EXPECT_EQ(canonical({"--nodata-policy", "background,height=-5"}),
            canonical({"--nodata-policy", "background", "--background", "-5"}));
  EXPECT_EQ(canonical({"--roi", "town.gpkg=0.2,falloff=30"}), canonical({"--roi", "town.gpkg=0.2", "--falloff", "30"}));
  EXPECT_EQ(canonical({"--water", "flats=50"}), canonical({"--detect-flats", "50"}));
}

TEST(GivenOptions, TheCanonicalCommandNamesFilesWithoutFoldersAndOmitsDefaults) {
  EXPECT_EQ(canonical({"--cutline", "a/b.gpkg,inset=2", "--objective", "max", "-j", "3", "--report", "r.json"}),
            " --max-error 1 --cutline b.gpkg,inset=2");
}

/// For each single option, parsing the canonical command gives the same command.
TEST(GivenOptions, TheCanonicalCommandIsAFixedPoint) {
  for (const OptionRow* row : rows_with_values()) {
    GivenOptions given(kSimplify);
    const std::string value = row->type == OptionType::kChoice ? row->list_choices().back() : "7";
    given.set(row->id, row->is_repeatable ? GivenOptions::Texts{value} : GivenOptions::Texts{});
    if (!row->is_repeatable) given.set(row->id, Given(value));
    const std::string text = given.canonical();
    if (text.empty()) continue;
    const std::size_t blank = text.find(' ', 1);
    GivenOptions again(kSimplify);
    const std::string complaint =
        parse(again, {"in.tif", "out.glb", text.substr(1, blank - 1), text.substr(blank + 1)});
    // A rule may require another option; values are separated before rules are checked.
    EXPECT_TRUE(complaint.empty() || complaint.find("needs") != std::string::npos) << complaint;
    EXPECT_EQ(again.canonical(), text);
  }
}

TEST(GivenOptions, ANumberBeyondItsRangeIsRefusedByItsName) {
  int checked = 0;
  for (const OptionRow* row : rows_with_values()) {
    if (row->type != OptionType::kNumber && row->type != OptionType::kCount) continue;
    for (const double beyond :
         {row->least - std::max(1.0, std::abs(row->least)), row->above, row->most + std::max(1.0, row->most)}) {
      if (!std::isfinite(beyond)) continue;
      GivenOptions given(kSimplify);
      given.set(row->id, Given(fmt::format("{}", beyond)));
      const auto number =
          row->type == OptionType::kNumber ? given.number(row->id).has_value() : given.count(row->id).has_value();
      ASSERT_FALSE(number) << row->name << " " << beyond;
      const Error error =
          row->type == OptionType::kNumber ? given.number(row->id).error() : given.count(row->id).error();
      EXPECT_EQ(error.message.find(row->title()), 0u) << error.message;
      ++checked;
    }
  }
  EXPECT_GT(checked, 30);
}

TEST(OptionTable, NamesOfACommandAreUnique) {
  for (const CommandRow& command : command_rows()) {
    std::set<std::string> names;
    for (const OptionRow* row : accepted_rows(command.command)) {
      EXPECT_TRUE(names.insert(row->name).second) << command.name << " " << row->name;
      EXPECT_TRUE(row->short_name[0] == 0 || names.insert(row->short_name).second) << row->short_name;
      EXPECT_TRUE(row->part_of == kNone || find_option(command.command, row->part_of) != nullptr) << row->name;
    }
  }
}

void give(const OptionTerm& term, GivenOptions& given) {
  const OptionRow* const row = find_option(given.command(), term.id);
  std::string value = term.value;
  if (value.empty() || value.starts_with('!'))
    value = row->type == OptionType::kChoice ? row->list_choices().back() : "1";
  if (row->is_repeatable)
    given.set(term.id, GivenOptions::Texts{value});
  else
    given.set(term.id, Given(value));
}

/// True if the message names the option, or the part as spelled until 0.2.
bool names(const std::string& sentence, Commands command, OptionId id) {
  return sentence.find(name_of(id)) != std::string::npos ||
         sentence.find(find_option(command, id)->name) != std::string::npos;
}

/// Each rule refuses its options with both names in the message, and passes without these options.
TEST(OptionRules, EachRefusesWhatItNames) {
  for (const OptionRule& rule : option_rules()) {
    if (rule.kind == OptionRule::Kind::kAllows) continue;
    for (const Commands command : {kSimplify, kMeasure, kTile}) {
      if ((rule.commands & command) == 0 || find_option(command, rule.one.id) == nullptr) continue;
      for (const OptionTerm& other : rule.others) {
        if (other.id == kNone || find_option(command, other.id) == nullptr) continue;
        GivenOptions given(command);
        give(rule.one, given);
        if (rule.kind == OptionRule::Kind::kExcludes) give(other, given);
        const Result<void> result = check_rule(rule, given);
        ASSERT_FALSE(result) << name_of(rule.one.id) << " and " << name_of(other.id);
        EXPECT_TRUE(names(result.error().message, command, rule.one.id)) << result.error().message;
        EXPECT_TRUE(names(result.error().message, command, other.id)) << result.error().message;
        GivenOptions fine(command);
        give(rule.one, fine);
        if (rule.kind == OptionRule::Kind::kNeeds) give(other, fine);
        EXPECT_TRUE(check_rule(rule, fine)) << name_of(rule.one.id) << " and " << name_of(other.id);
      }
    }
  }
}

/// A rule that allows some options refuses all other options of the command, except options of run behaviour.
TEST(OptionRules, EachAllowsWhatItNames) {
  int rules = 0, refused = 0;
  for (const OptionRule& rule : option_rules()) {
    if (rule.kind != OptionRule::Kind::kAllows) continue;
    ++rules;
    for (const OptionRow* row : rows_of(kMeasure)) {
      if (row->is_argument() || row->id == rule.one.id) continue;
      GivenOptions given(kMeasure);
      give({row->id}, given);
      EXPECT_TRUE(check_rule(rule, given)) << row->name;
      give(rule.one, given);
      const Result<void> result = check_rule(rule, given);
      const bool is_named = std::any_of(rule.others.begin(), rule.others.end(),
                                        [&](const OptionTerm& term) { return term.id == row->id; });
      EXPECT_EQ(result.has_value(), is_named || row->group == OptionGroup::kRun) << row->name;
      if (result) continue;
      ++refused;
      EXPECT_TRUE(names(result.error().message, kMeasure, row->id)) << result.error().message;
    }
  }
  EXPECT_EQ(rules, 1);
  EXPECT_GT(refused, 20);
}

}  // namespace
}  // namespace scarp::cli
