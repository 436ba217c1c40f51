#include "session/reports/feature_report.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <map>

#include "session/inputs/zones.h"
#include "session/options/values.h"
#include "session/text/json_text.h"
#include "session/text/text.h"

namespace scarp::cli {
namespace {

using enum OptionId;

double largest_edit(const std::vector<SampleEdit>& edits) {
  double largest = 0;
  for (const SampleEdit& edit : edits) largest = std::max(largest, std::abs(double{edit.after} - double{edit.before}));
  return largest;
}

std::string lakes_line(const std::vector<Lake>& lakes) {
  if (lakes.empty()) return "";
  std::uint64_t samples = 0;
  double largest = 0;
  for (const Lake& lake : lakes) {
    samples += lake.samples + lake.raised;
    largest = std::max(largest, lake.largest_change);
  }
  const std::string changed =
      samples == 0 ? ", flat as they are"
                   : fmt::format(" flattened ({} changed, at most {}); errors are relative to the flattened raster",
                                 format_plural(samples, "sample"), format_number(largest));
  return summary_line("water", format_plural(lakes.size(), "lake") + changed);
}

std::string rivers_line(const std::vector<River>& rivers) {
  if (rivers.empty()) return "";
  double deepest = 0;
  for (const River& river : rivers) deepest = std::max(deepest, river.deepest_cut);
  return summary_line("rivers", fmt::format("{}, up to {} below the raster", format_plural(rivers.size(), "line"),
                                            format_number(deepest)));
}

}  // namespace

Json describe_lines(const GivenOptions& given, const Simplified& simplified) {
  if (given.all(kBreaklines).empty()) return nullptr;
  const FarthestLine& farthest = simplified.farthest_line;
  return Json{{"files", given.all(kBreaklines)},
              {"lines", simplified.features.given_lines()},
              {"laid", simplified.lines_inserted},
              {"edited_samples", simplified.edits.size()},
              {"largest_edit", largest_edit(simplified.edits)},
              {"farthest", farthest.distance},
              {"farthest_line", farthest.name},
              {"farthest_is_at_zero", farthest.is_at_zero}};
}

std::string lines_line(std::uint64_t lines, std::uint64_t inserted, const std::vector<SampleEdit>& edits) {
  if (lines == 0) return "";
  std::string text = format_plural(lines, "line");
  if (inserted != lines) {
    text = fmt::format("{} of {}, the {} beside the raster", inserted == 0 ? "none" : format_count(inserted), text,
                       lines - inserted == 1 ? "other lies" : "others lie");
  }
  if (!edits.empty())
    text += fmt::format("; {} given their heights (changed by at most {}); errors are relative to the changed raster",
                        format_plural(edits.size(), "sample"), format_number(largest_edit(edits)));
  return summary_line("breaklines", text);
}

void warn_of_far_lines(const Simplified& simplified, double error, std::vector<std::string>& warnings) {
  constexpr double kMostErrors = 10;
  const FarthestLine& line = simplified.farthest_line;
  // Heights are seldom zero, so a small distance from the raster suffices.
  if (line.distance > (line.is_at_zero ? 1 : kMostErrors) * error) {
    warnings.push_back(
        fmt::format("{}: {} lies up to {} from the raster{}: {}{} gives lines the heights of the raster", kBreaklines,
                    line.name, format_number(line.distance), line.is_at_zero ? ", and all its heights are 0" : "",
                    line.is_at_zero ? fmt::format("{} names an attribute with heights, and ", kBreaklineZ)
                                    : "if its heights are wrong, ",
                    kSoftBreaklines));
  }
  const std::vector<River>& rivers = simplified.features.rivers;
  const auto deepest = std::max_element(rivers.begin(), rivers.end(),
                                        [](const River& a, const River& b) { return a.deepest_cut < b.deepest_cut; });
  if (deepest != rivers.end() && deepest->deepest_cut > kMostErrors * error) {
    warnings.push_back(
        fmt::format("{}: {} runs up to {} below the raster, for it crosses higher ground: draw it along the valley, or "
                    "give its file to {}, with {}, which cuts nothing",
                    kRivers, deepest->name, format_number(deepest->deepest_cut), kBreaklines, kSoftBreaklines));
  }
}

void warn_of_dry_lines(const Features& features, const std::vector<River>& rivers, std::vector<std::string>& warnings) {
  if (rivers.size() == features.rivers.size()) return;
  warnings.push_back(fmt::format("{}: {} outside the raster or closed: no river", kRivers,
                                 format_plural(features.rivers.size() - rivers.size(), "line")));
}

Json describe_lakes(const std::vector<Lake>& lakes) {
  Json list = Json::array();
  for (const Lake& lake : lakes)
    list.push_back(Json{{"name", lake.name},
                        {"level", lake.level},
                        {"edited_samples", lake.samples},
                        {"raised_around", lake.raised},
                        {"largest_edit", lake.largest_change}});
  return list;
}

Json describe_rivers(const std::vector<River>& rivers) {
  Json list = Json::array();
  for (const River& river : rivers)
    list.push_back(Json{{"name", river.name},
                        {"source", river.source},
                        {"mouth", river.mouth},
                        {"deepest_cut", river.deepest_cut},
                        {"turned", river.is_turned}});
  return list;
}

std::string waters_lines(const std::vector<Lake>& lakes, const std::vector<River>& rivers) {
  return lakes_line(lakes) + rivers_line(rivers);
}

Json describe_cliffs(const GivenOptions& given, const std::optional<Cliffs>& cliffs) {
  if (!cliffs) return nullptr;
  return Json{{"height", **given.number(kCliff)},
              {"walls", cliffs->wall_count},
              {"lines", cliffs->lines.size()},
              {"line_vertices", cliffs->vertices}};
}

std::string cliffs_line(const std::optional<Cliffs>& cliffs) {
  if (!cliffs) return "";
  return summary_line("cliffs",
                      fmt::format("{} ({})", format_plural(cliffs->wall_count, "wall"),
                                  cliffs->vertices == 1 ? "1 vertex" : format_count(cliffs->vertices) + " vertices"));
}

void warn_of_missing_walls(const GivenOptions& given, const std::optional<Cliffs>& cliffs,
                           std::vector<std::string>& warnings) {
  if (!cliffs || cliffs->wall_count > 0) return;
  warnings.push_back(
      fmt::format("{} {}: no wall was found; give the least height of one, the difference of two neighbouring samples",
                  kCliff, *given[kCliff]));
}

Json describe_ridges(const GivenOptions& given, const std::optional<Ridges>& ridges) {
  if (!ridges) return nullptr;
  return Json{{"height", **given.number(kRidges)},
              {"kept", given.has(kKeepRidges)},
              {"ridges", ridges->ridges.size()},
              {"valleys", ridges->valleys.size()},
              {"line_vertices", ridges->vertices}};
}

std::string ridges_line(const std::optional<Ridges>& ridges) {
  if (!ridges) return "";
  return summary_line("ridges",
                      fmt::format("{}, {}, {} vertices in all", format_plural(ridges->ridges.size(), "ridge"),
                                  format_plural(ridges->valleys.size(), "valley"), format_count(ridges->vertices)));
}

void warn_of_missing_ridges(const GivenOptions& given, const std::optional<Ridges>& ridges,
                            std::vector<std::string>& warnings) {
  if (!ridges || !ridges->ridges.empty() || !ridges->valleys.empty()) return;
  warnings.push_back(
      fmt::format("{} {}: no ridge or valley was found; give how far the land falls or rises from one on both "
                  "sides, at least",
                  kRidges, *given[kRidges]));
}

Json describe_cut(const GivenOptions& given, const Cut& cut, std::uint64_t outside) {
  if (!given.has(kCutline)) return nullptr;
  return Json{{"files", given.all(kCutline)},
              {"polygons", cut.polygons},
              {"inset", or_null(given[kInset])},
              {"mask_outside", given.has(kMaskOutside)},
              {"samples_outside", cut.masked + outside}};
}

std::string cut_words(const Cut& cut, std::uint64_t outside) {
  return fmt::format("{}, {} outside left out", format_plural(cut.polygons, "polygon"),
                     format_plural(cut.masked + outside, "sample"));
}

void add_zones(Json& report, const GivenOptions& given, const MeshZones& zones) {
  report["materials"] = report["node_strings"] = nullptr;
  if (given.has(kMaterials)) {
    std::map<std::uint32_t, std::uint64_t> counts;
    for (const std::uint32_t material : zones.materials) ++counts[material];
    report["materials"] = Json::array();
    for (const auto& [material, count] : counts)
      report["materials"].push_back({{"material", material}, {"triangles", count}});
  }
  if (!given.has(kNodeStrings)) return;
  report["node_strings"] = Json::array();
  for (std::size_t k = 0; k < zones.node_strings.size(); ++k)
    report["node_strings"].push_back(
        {{"number", k + 1}, {"name", zones.node_strings[k].name}, {"nodes", zones.node_strings[k].nodes.size()}});
}

std::string zones_lines(const GivenOptions& given, const MeshZones& zones) {
  std::string text;
  if (given.has(kMaterials)) {
    std::map<std::uint32_t, std::uint64_t> counts;
    for (const std::uint32_t material : zones.materials) ++counts[material];
    const auto elsewhere = counts.contains(kElsewhere) ? counts[kElsewhere] : 0;
    text += summary_line("materials", fmt::format("{}; {} of material {}", format_plural(counts.size(), "number"),
                                                  format_plural(elsewhere, "triangle"), kElsewhere));
  }
  if (given.has(kNodeStrings)) {
    std::size_t nodes = 0;
    for (const NodeString& string : zones.node_strings) nodes += string.nodes.size();
    text += summary_line(
        "node strings", fmt::format("{} of {}", format_count(zones.node_strings.size()), format_plural(nodes, "node")));
  }
  return text;
}

}  // namespace scarp::cli
