#include "commands/info_command.h"

#include <fmt/format.h>

#include <array>
#include <cmath>
#include <utility>

#include "options/option_table.h"
#include "reports/report.h"
#include "scarp/suggest.h"
#include "scarp/version.h"
#include "terminal/progress_display.h"
#include "terminal/text.h"

namespace scarp::cli {
namespace {

constexpr std::array<double, 3> kShares{0.01, 0.05, 0.20};

Json make_report(const OwnedHeightField& field, const Suggestions& suggestions, int band,
                 const std::string& command_line) {
  Json report;
  report["scarp"] = version();
  report["command"] = command_line;
  report["input"] = describe_input(field, field.info, band);
  report["frame"] = describe_frame(field.frame);
  report["full_triangles"] = full_grid_triangles(field);
  Json& rows = report["suggestions"];
  rows = Json::array();
  for (const Suggestion& row : suggestions.rows) {
    rows.push_back(Json{{"share", row.share},
                        {"triangles", static_cast<std::uint64_t>(
                                          std::floor(row.share * static_cast<double>(full_grid_triangles(field))))},
                        {"max_error", row.error ? Json(*row.error) : Json(nullptr)}});
  }
  report["suggestions_are_estimates"] = suggestions.is_estimate;
  report["warnings"] = field.info.warnings;
  return report;
}

std::string describe_cell(const RasterInfo& info) {
  if (!info.has_georeference) return "1 x 1 (no georeference)";
  const auto size = [](double x, double y) {
    return x == y ? format_number(x) : fmt::format("{} x {}", format_number(x), format_number(y));
  };
  std::string text = size(info.cell_x, info.cell_y) + (info.is_geographic ? " degrees" : " CRS units");
  if (info.cell_x_m > 0) text += fmt::format(", {:.4g} x {:.4g} m", info.cell_x_m, info.cell_y_m);
  return text;
}

/// "EPSG:4326", or the name that a WKT begins with.
std::string describe_crs(const std::string& crs) {
  if (crs.empty()) return "none";
  const std::size_t open = crs.find('"');
  if (open == std::string::npos) return crs;
  return crs.substr(open + 1, crs.find('"', open + 1) - open - 1);
}

std::string make_table(const OwnedHeightField& field, const Suggestions& suggestions) {
  const RasterInfo& info = field.info;
  const std::string unit = info.unit.empty() ? "" : " " + info.unit;
  const auto line = [](const char* name, const std::string& value) { return fmt::format("  {:<14}{}\n", name, value); };
  const std::uint64_t samples = static_cast<std::uint64_t>(field.cols) * static_cast<std::uint64_t>(field.rows);
  const double missing = static_cast<double>(samples - info.valid);

  std::string text = info.path + "\n";
  text += line("format", fmt::format("{}, {}", info.format, info.sample_type));
  text += line("size", fmt::format("{} columns x {} rows, {} samples", field.cols, field.rows, format_count(samples)));
  text += line("heights", fmt::format("{} to {}{}, relief {}", format_number(info.min), format_number(info.max), unit,
                                      format_number(info.max - info.min)));
  text += line("missing", fmt::format("{}{}", format_share(missing, static_cast<double>(samples)),
                                      info.nodata ? fmt::format(", nodata {}", format_number(*info.nodata)) : ""));
  text += line("CRS", describe_crs(info.crs));
  text += line("cell", describe_cell(info));
  text += line("mesh frame", field.frame.description);
  text += fmt::format("Suggested errors{}:\n", suggestions.is_estimate
                                                   ? fmt::format(" (an estimate from windows that hold {} samples)",
                                                                 format_count(suggestions.samples_used))
                                                   : "");
  text += "  triangles   of the full grid   simplify with\n";
  for (const Suggestion& row : suggestions.rows) {
    const auto triangles =
        static_cast<std::uint64_t>(std::floor(row.share * static_cast<double>(full_grid_triangles(field))));
    text += fmt::format("  {:>9}   {:>13.0f} %    {}\n", format_count(triangles), 100 * row.share,
                        row.error ? fmt::format("-e {}", format_number(*row.error))
                                  : "not possible: the outline of the valid samples alone needs more");
  }
  return text;
}

}  // namespace

InfoCommand::InfoCommand(CLI::App& program) : command_(add_command(program, kInfo)) {
  add_option(*command_, OptionId::kRaster, raster_.path);
  raster_.add_to(*command_);
  add_flag(*command_, OptionId::kJson, json_);
  add_flag(*command_, OptionId::kQuiet, quiet_);
  add_flag(*command_, OptionId::kJsonProgress, json_progress_);
}

Result<void> InfoCommand::run(const std::string& command_line) const {
  Result<ReadOptions> read = raster_.parse();
  if (!read) return tl::unexpected(std::move(read.error()));
  ProgressDisplay display(ProgressDisplay::choose(json_progress_, quiet_));
  read->run.progress = display.callback();
  const Result<OwnedHeightField> field = read_height_field(raster_.path, *read);
  if (!field) return tl::unexpected(field.error());
  const Result<Suggestions> suggestions = suggest_errors(*field, kShares, display.callback());
  if (!suggestions) return tl::unexpected(suggestions.error());
  display.finish();
  if (!quiet_) print_warnings(field->info.warnings);
  return print_to_stdout(json_ ? to_text(make_report(*field, *suggestions, read->band, command_line))
                               : make_table(*field, *suggestions));
}

}  // namespace scarp::cli
