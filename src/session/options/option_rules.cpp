#include "session/options/option_rules.h"

#include <fmt/format.h>

#include <algorithm>
#include <string>
#include <string_view>
#include <vector>

#include "session/options/given_options.h"

namespace scarp::cli {
namespace {

using enum OptionId;
constexpr auto kNeeds = OptionRule::Kind::kNeeds;
constexpr auto kExcludes = OptionRule::Kind::kExcludes;
constexpr auto kAllows = OptionRule::Kind::kAllows;

constexpr const char* kInParts = "it reads points in parts, and this needs all of them at once";

constexpr OptionRule kRules[] = {
    {{kVolume}, kAllows, {{{kUp}, {kJson}}}, "volumes lie between surfaces, without samples"},
    {{kDecode}, kExcludes, {{{kBand}}}, "decoding uses bands 1, 2 and 3"},
    {{kResolution}, kExcludes, {{{kDecode}}}, "means of packed colours are no heights"},
    {{kFillDistance}, kNeeds, {{{kNodataPolicy, "fill"}}}},
    {{kBackground}, kNeeds, {{{kNodataPolicy, "background"}}}, "", kSimplify},
    {{kNodataPolicy, "background"}, kNeeds, {{{kBackground}}}, "the height to use, such as height=0", kSimplify},
    {{kObjective, "rms"},
     kNeeds,
     {{{kMaxTriangles}, {kMaxPoints}}},
     "a max error alone decides the mesh, whatever its RMSE"},
    {{kVertices, "free"}, kExcludes, {{{kWater}, {kDetectFlats}}}, "water is level at samples and on its shore"},
    {{kLodsInOne}, kNeeds, {{{kLods}}}},
    {{kLods}, kNeeds, {{{kMaxError}, {kTolerance}, {kRoi}}}, "a budget finds another error for each raster and level"},
    {{kLockBorder},
     kNeeds,
     {{{kMaxError}, {kTolerance}, {kRoi}}},
     "a budget finds another error for each raster and level"},
    {{kLods}, kExcludes, {{{kBase}, {kSolid}}}, "levels are surfaces that replace each other, not solids"},
    {{kMask}, kExcludes, {{{kRoi}}}, "regions have errors, not weights"},
    {{kMask}, kExcludes, {{{kTolerance}}}, "divide the bound by the weights into one tolerance"},
    {{kFalloff}, kNeeds, {{{kRoi}}}, "there is no region that it could be around"},
    {{kFalloff}, kNeeds, {{{kMaxError}}}, "the bound of a region grows to that", kSimplify},
    {{kFalloff}, kNeeds, {{{kFailAbove}}}, "the bound of a region grows to that", kMeasure},
    {{kTextureWeight}, kNeeds, {{{kTexture}}}},
    {{kTextureWeight, "1"},
     kExcludes,
     {{{kMaxError}, {kTolerance}, {kRoi}}},
     "that weight ignores heights: ask for a size with -t or -p, or choose a smaller weight",
     kSimplify},
    {{kNorm}, kNeeds, {{{kTexture}, {kImage}}}},
    {{kChannelWeights}, kNeeds, {{{kTexture}, {kImage}}}},
    {{kImage}, kExcludes, {{{kTexture}, {kZScale}, {kZOffset}, {kZUnit}}}, "an image has no heights"},
    {{kImage}, kExcludes, {{{kDecode}}}, "decoded bands are heights"},
    {{kImage}, kExcludes, {{{kNodataPolicy, "!hole"}}}, "missing pixels are holes"},
    {{kBreaklineZ}, kNeeds, {{{kBreaklines}}}, "there are no lines without"},
    {{kSoftBreaklines}, kNeeds, {{{kBreaklines}}}, "there are no lines without"},
    {{kLineConflict}, kNeeds, {{{kBreaklines}, {kRivers}, {kWater}}}, "there are no lines without"},
    {{kSoftBreaklines}, kExcludes, {{{kBreaklineZ}}}, "drop one of them"},
    {{kInset}, kNeeds, {{{kCutline}}}, "there is no polygon without"},
    {{kMaskOutside}, kNeeds, {{{kCutline}}}, "there is no polygon without"},
    {{kKeepRidges}, kNeeds, {{{kRidges}}}, "there are none without"},
    {{kCliff}, kNeeds, {{{kMaxError}, {kMaxTriangles}, {kMaxPoints}}}, "walls are fitted to one bound"},
    {{kRidges}, kNeeds, {{{kMaxError}, {kMaxTriangles}, {kMaxPoints}}}, "lines are fitted to one bound"},
    {{kMaterialField}, kNeeds, {{{kMaterials}}}},
    {{kMaterials}, kExcludes, {{{kBase}}}, "a flow model has no underside"},
    {{kNodeStrings}, kExcludes, {{{kBase}}}, "a flow model has no underside"},
    {{kWaterPercentile}, kNeeds, {{{kWater}}}, "there is no lake without"},
    {{kWaterMask}, kNeeds, {{{kWater}}}, "it shows the lakes that are given there"},
    {{kDetectFlats}, kExcludes, {{{kWater}}}, "lakes are found, or named by a file"},
    {{kDrapeSize}, kNeeds, {{{kDrape}}}, "there is no image without"},
    {{kDrapeFormat}, kNeeds, {{{kDrape}}}, "there is no image without"},
    {{kDrape}, kExcludes, {{{kTexture}, {kImage}}}, "the colours of both would be multiplied"},
    {{kNormalMap}, kExcludes, {{{kNormals}}}, "the image has the normals of all samples"},
    {{kNormalMap}, kExcludes, {{{kImage}}}, "an image is flat, and its normals mean nothing"},
    {{kNormalMap}, kExcludes, {{{kBase}}}, "a solid's walls have no terrain normal"},
    {{kNormals}, kExcludes, {{{kBase}}}, "a solid's walls have no terrain normal"},
    {{kNormals}, kExcludes, {{{kImage}}}, "an image is flat, and its normals mean nothing"},
    {{kSplit}, kNeeds, {{{kSolid}}}, "print tiles are solids, such as --solid size=120mm"},
    {{kSolid}, kExcludes, {{{kBase}, {kNormals}, {kUvs}, {kImage}}}, "drop one of them"},
    {{kSolid}, kExcludes, {{{kTexture}, {kMask}, {kTolerance}, {kRoi}}}, "drop one of them"},
    {{kSolid}, kExcludes, {{{kScript}, {kImportance, "!global"}, {kOnePass}, {kAlgorithm}}}, "drop one of them"},
    {{kSolid}, kExcludes, {{{kBatch}, {kEdges, "data"}}}, "drop one of them"},
    {{kHtml},
     kExcludes,
     {{{kBase}, {kSolid}, {kImage}, {kMemory}}},
     "the page holds all samples of a terrain of heights"},
    {{kMemory}, kExcludes, {{{kImage}}}, "images are read as a whole"},
    {{kMemory}, kExcludes, {{{kDrape}, {kNormalMap}}}, "the image is held as a whole"},
    {{kMemory}, kExcludes, {{{kBreaklines}, {kWater}, {kDespike}, {kSolid}}}, kInParts, kEveryCommand, true},
    {{kMemory}, kExcludes, {{{kCutline}, {kBoundary, "!hull"}, {kTolerance}, {kRoi}}}, kInParts, kEveryCommand, true},
    {{kMemory}, kExcludes, {{{kErrorRaster}, {kLods}, {kPreview}}}, kInParts, kEveryCommand, true},
    {{kMemory}, kExcludes, {{{kEffort, "high"}, {kEffort, "max"}, {kVertices, "free"}}}, kInParts, kEveryCommand, true},
    {{kOnePass}, kExcludes, {{{kBatch}}}, "one pass ranks all samples once, without the mesh"},
    {{kEdgeScore}, kNeeds, {{{kEdges, "data"}}}, "Delaunay edges ignore the heights"},
    {{kShapeThreshold}, kNeeds, {{{kEdges, "data"}}}, "Delaunay edges ignore the heights"},
    {{kSupersample}, kNeeds, {{{kEdges, "data"}}}, "Delaunay edges ignore the heights"},
};

bool holds(const OptionTerm& term, const GivenOptions& given) {
  if (!given.has(term.id)) return false;
  const std::string_view value = term.value;
  if (value.empty()) return true;
  const Given& text = given[term.id];
  return value.starts_with('!') ? text != std::string(value.substr(1)) : text == std::string(value);
}

/// "--vertices free". An excluded value is printed as given; a part without its option, as spelled.
std::string describe(const OptionTerm& term, const GivenOptions& given) {
  const std::string_view value = term.value;
  if (!value.empty()) return fmt::format("{} {}", term.id, value.starts_with('!') ? *given[term.id] : value);
  const OptionRow* const row = find_option(given.command(), term.id);
  const bool is_alone = row != nullptr && row->part_of != kNone && !given.has(row->part_of);
  return is_alone ? row->name : name_of(term.id);
}

}  // namespace

std::span<const OptionRule> option_rules() { return kRules; }

Result<void> check_rule(const OptionRule& rule, const GivenOptions& given) {
  if (!holds(rule.one, given)) return {};
  const std::string why = rule.why[0] != 0 ? std::string(": ") + rule.why : "";
  const auto refuse = [&](const std::string& other) {
    return fail(ErrorKind::kUsage,
                fmt::format("{} cannot be combined with {}{}", describe(rule.one, given), other, why));
  };
  for (const OptionRow* row : rule.kind == kAllows ? given.given() : std::vector<const OptionRow*>()) {
    const auto is_row = [&](const OptionTerm& term) { return term.id == row->id; };
    const bool is_allowed = is_row(rule.one) || std::any_of(rule.others.begin(), rule.others.end(), is_row);
    if (!is_allowed && row->group != OptionGroup::kRun) return refuse(row->title());
  }
  std::string needed;
  for (const OptionTerm& other : rule.others) {
    if (other.id == kNone) continue;
    const bool is_given = holds(other, given);
    if (rule.kind == kExcludes && is_given) return refuse(describe(other, given));
    if (rule.kind == kNeeds && is_given) return {};
    needed += (needed.empty() ? "" : " or ") + name_of(other);
  }
  if (rule.kind != kNeeds) return {};
  return fail(ErrorKind::kUsage, fmt::format("{} needs {}{}", describe(rule.one, given), needed, why));
}

Result<void> check_rules(Commands command, const GivenOptions& given, bool are_for_points) {
  for (const OptionRule& rule : kRules) {
    if ((rule.commands & command) == 0 || rule.is_for_points != are_for_points) continue;
    SCARP_RETURN_IF_ERROR(check_rule(rule, given));
  }
  return {};
}

}  // namespace scarp::cli
