#include "session/table/conflict_words.h"

#include <fmt/format.h>

#include <string>
#include <vector>

#include "pieces/conflicts.h"
#include "session/table/field_options.h"

namespace scarp::cli {
namespace {

/// The options of the setting, if any, else the library's word.
std::vector<std::string> words_of(pieces::Field field) {
  using enum OptionId;
  const auto with = [](OptionId id, const char* note) { return fmt::format("{} ({})", id, note); };
  switch (field) {
    case pieces::Field::kIgnored:
      return {with(kScript, "lines i, u")};
    case pieces::Field::kPoints:
      return {with(kScript, "lines s")};
    case pieces::Field::kMaskSource:
      return {with(kMask, "streamed")};
    case pieces::Field::kTolerance:
      return {name_of(kTolerance), name_of(kRoi)};
    case pieces::Field::kToleranceSource:
      return {name_of(kTolerance), with(kRoi, "streamed")};
    case pieces::Field::kBreaklines:
      return {name_of(kBreaklines), name_of(kWater), name_of(kRivers), name_of(kCliff), name_of(kRidges)};
    case pieces::Field::kStrategy:
      return {name_of(kImportance), name_of(kOnePass), name_of(kAlgorithm), name_of(kBatch),
              name_of(OptionTerm{kEdges, "data"})};
    case pieces::Field::kShape:
      return {name_of(kMinAngle), name_of(kMaxEdge), name_of(kGrade)};
    case pieces::Field::kChannels:
      return {name_of(kTexture), name_of(kImage)};
    case pieces::Field::kCurvedFrame:
      return {with(kCrs, "of another projection")};
    case pieces::Field::kSpaceFrame:
      return {name_of(OptionTerm{kCrs, "enu"}), name_of(OptionTerm{kCrs, "EPSG:4978"})};
    case pieces::Field::kSource:
      return {with(kMemory, "where samples are streamed")};
    default:
      break;
  }
  const OptionTerm option = option_of(field);
  return {option.id != kNone ? name_of(option) : std::string(pieces::name_of(field))};
}

std::vector<std::string> words_of(pieces::Fields fields) {
  // These variants have no option of their own.
  if (fields.has(pieces::Field::kTolerance)) fields = fields.without(pieces::Field::kToleranceSource);
  if (fields.has(pieces::Field::kMask)) fields = fields.without(pieces::Field::kMaskSource);
  std::vector<std::string> words;
  for (int k = 0; k < pieces::kFieldCount; ++k) {
    if (!fields.has(static_cast<pieces::Field>(k))) continue;
    for (std::string& word : words_of(static_cast<pieces::Field>(k))) words.push_back(std::move(word));
  }
  return words;
}

bool is_of_tiles(const pieces::ConflictRule& rule) {
  for (int k = pieces::kSimplifyFieldCount; k < pieces::kFieldCount; ++k) {
    if (rule.one.has(static_cast<pieces::Field>(k))) return true;
  }
  return false;
}

}  // namespace

nlohmann::ordered_json describe_conflicts() {
  auto rows = nlohmann::ordered_json::array();
  for (const pieces::ConflictRule& rule : pieces::conflict_rules()) {
    // The program streams the weights and tolerances of streamed samples, so these conflicts cannot occur.
    const bool is_of_source = rule.one.has(pieces::Field::kSource);
    const pieces::Fields other =
        is_of_source ? rule.other.without(pieces::Field::kTolerance).without(pieces::Field::kMask) : rule.other;
    if (other.empty()) continue;
    std::vector<std::string> beside = words_of(rule.beside);
    if (!is_of_source && rule.where != pieces::Where::kAlways)
      beside = {rule.where == pieces::Where::kInMemory ? "samples in memory" : "streamed samples"};
    rows.push_back({{"tiles", is_of_tiles(rule)},
                    {"setting", words_of(rule.one)},
                    {"with", words_of(other)},
                    {"beside", beside},
                    {"because", rule.reason}});
  }
  return rows;
}

}  // namespace scarp::cli
