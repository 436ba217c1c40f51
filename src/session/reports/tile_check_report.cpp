#include "session/reports/tile_check_report.h"

#include <fmt/format.h>

#include <algorithm>

#include "session/text/json_text.h"
#include "session/text/text.h"

namespace scarp::cli {
namespace {

std::string format_length(const TileCheck& check, const std::optional<double>& length) {
  return length ? format_number(*length) + unit_behind(check.units) : std::string("-");
}

CheckedLevel sum_of(const TileCheck& check) {
  CheckedLevel sum;
  for (const CheckedLevel& level : check.levels) {
    sum.tiles += level.tiles;
    sum.triangles += level.triangles;
    sum.edges += level.edges;
    sum.edges_apart += level.edges_apart;
    sum.corners += level.corners;
    sum.corners_apart += level.corners_apart;
    sum.gap = std::max(sum.gap, level.gap);
  }
  return sum;
}

void add_counts(Json& json, const CheckedLevel& level) {
  json["tiles"] = level.tiles;
  json["triangles"] = level.triangles;
  json["edges"] = level.edges;
  json["edges_apart"] = level.edges_apart;
  json["corners"] = level.corners;
  json["corners_apart"] = level.corners_apart;
  json["gap"] = level.gap;
}

/// "12 of border, 1 of header".
std::string list_faults(const TileCheck& check) {
  std::string list;
  for (std::size_t k = 0; k < kTileFaultKinds; ++k) {
    if (check.faults[k] == 0) continue;
    list += fmt::format("{}{} of {}", list.empty() ? "" : ", ", format_count(check.faults[k]),
                        name_of(static_cast<TileFaultKind>(k)));
  }
  return list;
}

}  // namespace

void add_tile_check(Json& report, const TileCheck& check) {
  report["format"] = check.format == TileFormat::kGlb ? "3dtiles" : "qm";
  add_counts(report, sum_of(check));
  report["nodes"] = check.nodes;
  Json levels = Json::array();
  for (std::size_t z = 0; z < check.levels.size(); ++z) {
    const CheckedLevel& level = check.levels[z];
    Json json{{"zoom", z}};
    add_counts(json, level);
    json["sag"] = level.sag;
    json["promised_node_error"] = or_null(level.promised_node_error);
    json["promised_bound"] = or_null(level.promised_bound);
    json["promised_source_error"] = or_null(level.promised_source_error);
    json["node_error"] = or_null(level.node_error);
    json["distance"] = or_null(level.distance);
    json["source_error"] = or_null(level.source_error);
    levels.push_back(std::move(json));
  }
  report["levels"] = std::move(levels);
  Json faults = Json::object();
  for (std::size_t k = 0; k < kTileFaultKinds; ++k) faults[name_of(static_cast<TileFaultKind>(k))] = check.faults[k];
  report["faults"] = std::move(faults);
  Json described = Json::array();
  for (const TileFault& fault : check.described)
    described.push_back({{"kind", name_of(fault.kind)}, {"sentence", fault.sentence}});
  report["described"] = std::move(described);
}

std::string make_check_summary(const std::string& set, const TileCheck& check, double seconds) {
  const CheckedLevel all = sum_of(check);
  std::string text = fmt::format("{}: {}, levels 0 to {}, {}\n", set, format_plural(all.tiles, "tile"),
                                 check.levels.size() - 1, format_plural(all.triangles, "triangle"));
  text +=
      "  level      tiles      edges  apart  largest gap  promised: nodes   in space  measured: nodes   in space    "
      "samples\n";
  for (std::size_t z = 0; z < check.levels.size(); ++z) {
    const CheckedLevel& level = check.levels[z];
    text += fmt::format("  {:5} {:>10} {:>10} {:>6} {:>12} {:>16} {:>10} {:>16} {:>10} {:>10}\n", z,
                        format_count(level.tiles), format_count(level.edges), format_count(level.edges_apart),
                        format_length(check, level.gap), format_length(check, level.promised_node_error),
                        format_length(check, level.promised_bound), format_length(check, level.node_error),
                        format_length(check, level.distance), format_length(check, level.source_error));
  }
  for (const TileFault& fault : check.described) {
    const std::uint64_t count = check.faults[static_cast<std::size_t>(fault.kind)];
    text += fmt::format("  fault of {}: {}{}\n", name_of(fault.kind), fault.sentence,
                        count > 1 ? fmt::format(" (and {} more)", format_count(count - 1)) : "");
  }
  text +=
      fmt::format("  borders    {} compared, {} apart; {} across, {} apart\n", format_plural(all.edges, "edge"),
                  format_count(all.edges_apart), format_plural(all.corners, "corner"), format_count(all.corners_apart));
  if (check.nodes > 0) text += fmt::format("  nodes      {} compared\n", format_count(check.nodes));
  text += fmt::format("  faults     {}\n", check.holds() ? "none" : list_faults(check));
  text += fmt::format("  time       {} s\n", format_seconds(seconds));
  return text;
}

std::string describe_faults(const std::string& set, const TileCheck& check) {
  return fmt::format("{} has {} ({}): {}", set, format_plural(check.count(), "fault"), list_faults(check),
                     check.described.front().sentence);
}

}  // namespace scarp::cli
