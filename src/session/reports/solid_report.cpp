#include "session/reports/solid_report.h"

#include <fmt/format.h>

#include <cmath>
#include <utility>

#include "session/text/json_text.h"
#include "session/text/text.h"

namespace scarp::cli {
namespace {

std::string size_text(const SolidFacts& facts, const PrintOptions& plan) {
  return fmt::format("{} x {} x {}{}", format_number(facts.high[0] - facts.low[0]),
                     format_number(facts.high[1] - facts.low[1]), format_number(facts.high[2] - facts.low[2]),
                     plan.size ? " mm" : "");
}

/// The relief in print units.
double relief_of(const Print& print) { return (print.heights.max - print.heights.min) * print.placement.scale[2]; }

/// The advice for a print that is nearly flat.
std::string relief_line(const PrintOptions& plan, const Print& print) {
  constexpr double kLow = 5, kGood = 8, kMost = 100;  // millimetres, millimetres, times
  const double relief = relief_of(print), factor = std::ceil(kGood / relief);
  if (!plan.size || !(relief > 0) || relief >= kLow || factor > kMost) return "";
  return summary_line(
      "hint", fmt::format("the relief is {:.2g} mm on the print; --solid exaggerate={} makes it {:.2g} mm", relief,
                          format_number(plan.exaggerate * factor), relief * factor));
}

Json describe_facts(const Mesh& mesh, const SolidFacts& facts) {
  Json size = Json::array();
  for (std::size_t k = 0; k < 3; ++k) size.push_back(facts.high[k] - facts.low[k]);
  return Json{{"vertices", mesh.vertex_count()}, {"triangles", facts.triangles}, {"size", std::move(size)},
              {"volume", facts.volume},          {"parts", facts.parts},         {"closed", facts.is_solid()}};
}

}  // namespace

Json describe_print(const PrintOptions& plan, const Print& print, const std::vector<std::string>& paths) {
  Json solid{{"base", print.base},
             {"vertices", print.vertices()},
             {"triangles", print.triangles()},
             {"unit", plan.size ? Json("mm") : Json(nullptr)},
             {"scale", print.placement.scale},
             {"max_error", print.max_error},
             {"relief", relief_of(print)},
             {"uncovered", print.uncovered}};
  Json list = Json::array();
  for (std::size_t k = 0; k < print.tiles.size(); ++k) {
    const PrintTile& tile = print.tiles[k];
    Json entry{{"path", paths.size() == 1 ? paths[0] : paths[k]}, {"row", tile.row}, {"column", tile.column}};
    entry.update(describe_facts(tile.mesh, tile.facts));
    list.push_back(std::move(entry));
  }
  solid["pieces"] = std::move(list);
  return solid;
}

std::string print_lines(const PrintOptions& plan, const Print& print) {
  const std::string on_print =
      plan.size ? fmt::format(", {:.2g} mm on the print", print.max_error * print.placement.scale[2]) : "";
  std::string text =
      summary_line("solid", fmt::format("{}, closed, base at {}, max error {} as written{}",
                                        format_plural(print.triangles(), "triangle"), format_number(print.base),
                                        format_number(print.max_error), on_print));
  text += relief_line(plan, print);
  if (print.uncovered > 0)
    text += summary_line("", format_plural(print.uncovered, "sample") + " in the gaps between print tiles");
  if (print.tiles.size() == 1) return text + summary_line("", size_text(print.tiles.front().facts, plan));
  for (const PrintTile& tile : print.tiles) {
    text += summary_line(
        fmt::format("tile r{} c{}", tile.row, tile.column).c_str(),
        fmt::format("{}, {}", format_plural(tile.facts.triangles, "triangle"), size_text(tile.facts, plan)));
  }
  return text;
}

}  // namespace scarp::cli
