#include "session/reports/info_report.h"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <filesystem>
#include <limits>
#include <map>
#include <string_view>
#include <utility>
#include <vector>

#include "scarp/mesh.h"
#include "scarp/version.h"
#include "session/reports/place.h"
#include "session/reports/points_report.h"
#include "session/reports/report.h"
#include "session/text/json_text.h"
#include "session/text/point_classes.h"
#include "session/text/text.h"

namespace scarp::cli {
namespace {

std::string fact_line(const char* name, const std::string& value) { return fmt::format("  {:<14}{}\n", name, value); }

std::string describe_cell(const OwnedHeightField& field) {
  const RasterInfo& info = field.info;
  if (!info.has_georeference)
    return fmt::format("{0} x {0} (no georeference)", format_number(std::abs(field.frame.affine[1])));
  const auto size = [](double x, double y) {
    return x == y ? format_number(x) : fmt::format("{} x {}", format_number(x), format_number(y));
  };
  std::string text = size(info.cell_x, info.cell_y) + " " + unit_words(info.crs_unit);
  const bool is_metric = !info.is_geographic && info.cell_x_m == info.cell_x && info.cell_y_m == info.cell_y;
  if (info.cell_x_m > 0 && !is_metric) text += fmt::format(", {:.4g} x {:.4g} m", info.cell_x_m, info.cell_y_m);
  return text;
}

struct Box {
  std::array<double, 3> low, high;

  Box() { low.fill(std::numeric_limits<double>::infinity()), high.fill(-low[0]); }
  void add(const std::array<double, 3>& place) {
    for (std::size_t k = 0; k < 3; ++k) low[k] = std::min(low[k], place[k]), high[k] = std::max(high[k], place[k]);
  }
};

/// Ten digits show coordinates of a projected CRS in millimetres.
std::string range_line(const char* name, const Box& box, std::size_t axis) {
  return fact_line(name, fmt::format("{:.10g} to {:.10g}, {:.6g} in all", box.low[axis], box.high[axis],
                                     box.high[axis] - box.low[axis]));
}

Json describe_box(const Box& box) { return Json{{"low", box.low}, {"high", box.high}}; }

Box box_of(const PointSet& points) {
  Box box;
  for (std::size_t k = 0; k < points.size(); ++k) box.add({points.x[k], points.y[k], points.z[k]});
  return box;
}

Box box_of(const Mesh& mesh) {
  Box box;
  for (std::size_t v = 0; v < mesh.vertex_count(); ++v) box.add(mesh.vertex(v));
  return box;
}

std::vector<std::string> list_attributes(const Mesh& mesh) {
  std::vector<std::string> names;
  if (!mesh.normals.empty()) names.emplace_back("normals");
  if (!mesh.uvs.empty()) names.emplace_back("uvs");
  if (!mesh.colors.empty()) names.emplace_back("colors");
  if (mesh.channel_count > 0)
    names.emplace_back(format_plural(static_cast<std::uint64_t>(mesh.channel_count), "channel"));
  return names;
}

bool has_offsets(const MeshFile& file) {
  return file.axes.has_offsets && file.mesh.origin != std::array<double, 3>{0, 0, 0};
}

/// Explains how the file's numbers differ from the printed ranges, which are z up and absolute.
std::string describe_axes(const MeshFile& file) {
  std::string text = "z is up";
  if (file.axes.up == 'y') text = "y is up (above: z)";
  if (file.axes.up == 0) text = "nothing says which axis is up: z is taken";
  if (!has_offsets(file)) return text;
  const std::array<double, 3>& o = file.mesh.origin;
  return text + fmt::format("; positions are offsets from x {:.10g}, y {:.10g}, z {:.10g}", o[0], o[1], o[2]);
}

Json axes_report(const MeshFile& file) {
  return Json{{"up", file.axes.up == 0 ? Json(nullptr) : Json(std::string(1, file.axes.up))},
              {"offsets_from", has_offsets(file) ? Json(file.mesh.origin) : Json(nullptr)}};
}

/// The metadata with the file's own "up"; the mesh that was read is always z up.
std::map<std::string, std::string> metadata_of(const MeshFile& file) {
  std::map<std::string, std::string> metadata = file.mesh.metadata;
  metadata.erase("up");
  return metadata;
}

/// An error as a value of -e. For outputs in metres, a plain number is in metres.
std::string goal_words(double error, const RasterInfo& info) {
  const double metres = info.unit_in_metres;
  if (metres == 1 || metres == 0) return format_number(error);
  if (std::abs(metres / 0.3048 - 1) < 1e-5) return format_number(error) + "ft";
  return format_number(error * metres) + "m";
}

}  // namespace

std::string raster_facts(const OwnedHeightField& field) {
  const RasterInfo& info = field.info;
  const std::string unit = info.unit.empty() ? "" : " " + info.unit;
  const std::uint64_t samples = static_cast<std::uint64_t>(field.cols) * static_cast<std::uint64_t>(field.rows);
  const double missing = static_cast<double>(samples - info.valid);

  std::string text = info.path + "\n";
  if (!info.view.empty()) text += fact_line("read as", info.view);
  text += fact_line("format", fmt::format("{}, {}", info.format, info.sample_type));
  text +=
      fact_line("size", fmt::format("{} columns x {} rows, {} samples", field.cols, field.rows, format_count(samples)));
  text += fact_line("heights", fmt::format("{} to {}{}, relief {}", format_number(info.min), format_number(info.max),
                                           unit, format_number(info.max - info.min)));
  text += fact_line("missing", fmt::format("{}{}", format_share(missing, static_cast<double>(samples)),
                                           info.nodata ? fmt::format(", nodata {}", format_number(*info.nodata)) : ""));
  text += fact_line("CRS", crs_words(info.crs));
  text += fact_line("cell", describe_cell(field));
  text += fact_line("mesh frame", field.frame.description);
  return text;
}

std::string suggestion_table(const OwnedHeightField& field, const Suggestions& suggestions) {
  std::string text = fmt::format(
      "Suggested errors{}:\n", suggestions.is_estimate ? fmt::format(" (an estimate from windows that hold {} samples)",
                                                                     format_count(suggestions.samples_used))
                                                       : "");
  text += "  triangles   of the full grid   simplify with\n";
  for (const Suggestion& row : suggestions.rows) {
    const auto triangles =
        static_cast<std::uint64_t>(std::floor(row.share * static_cast<double>(full_grid_triangles(field))));
    text += fmt::format("  {:>9}   {:>13.0f} %    {}\n", format_count(triangles), 100 * row.share,
                        row.error ? "-e " + goal_words(*row.error, field.info)
                                  : "not possible: the outline of the valid samples alone needs more");
  }
  return text;
}

Json raster_report(const OwnedHeightField& field, const Suggestions& suggestions, int band,
                   const std::string& command_line) {
  Json report;
  report["scarp"] = version();
  report["command"] = command_line;
  report["input"] = describe_input(field, field.info, band);
  report["frame"] = describe_frame(field.frame, field.info, field.rows);
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

namespace {

/// Average number of points in a square of one unit of x and y within their extent; 0 for an extent without area.
double density(const PointSet& points, const Box& box) {
  const double area = (box.high[0] - box.low[0]) * (box.high[1] - box.low[1]);
  return area > 0 ? static_cast<double>(points.size()) / area : 0;
}

std::string las_lines(const PointSet& points, const std::vector<std::string>& inputs, const Box& box) {
  std::string classes;
  bool has_ground = false;
  for (const PointClass& of : points.las->classes) {
    constexpr int kGround = 2;
    has_ground = has_ground || of.number == kGround;
    const std::string_view name = class_name(of.number);
    classes += fmt::format("{}{}{}: {}", classes.empty() ? "" : ", ", of.number,
                           name.empty() ? "" : fmt::format(" {}", name), format_count(of.points));
  }
  std::string text = fact_line("classes", classes);
  const bool is_metric = points.unit_in_metres == 1;
  if (const double dense = density(points, box); dense > 0)
    text += fact_line("density", fmt::format("{} points per {}", format_number(dense),
                                             is_metric ? "square metre" : "square unit of x and y"));
  std::string command = "scarp simplify";
  for (const std::string& input : inputs) command += " " + shell_word(input);
  const std::string output = std::filesystem::path(base_name(inputs.front())).replace_extension(".glb").string();
  return text + fact_line("next", fmt::format("{} {} -e 1%{}", command, shell_word(output),
                                              has_ground ? " --class ground" : ""));
}

}  // namespace

std::string points_facts(const PointSet& points, const std::vector<std::string>& inputs) {
  const Box box = box_of(points);
  std::string text = points.path + "\n";
  text += fact_line("format", points.format + (points.las ? fmt::format(" {}, point format {}", points.las->version,
                                                                        points.las->point_format)
                                                          : ""));
  text += fact_line("points", format_count(points.size()) + left_out(points));
  if (!points.columns.empty()) text += fact_line("read as", points.columns);
  if (!points.lines.empty()) text += fact_line("lines", format_count(points.lines.size()));
  text += range_line("x", box, 0) + range_line("y", box, 1);
  const std::string& unit = points.heights.unit;
  text +=
      fact_line("heights", fmt::format("{} to {}, relief {}{}", format_number(box.low[2]), format_number(box.high[2]),
                                       format_number(box.high[2] - box.low[2]), unit.empty() ? "" : " " + unit));
  text += fact_line("CRS", crs_words(points.crs));
  text += fact_line("mesh frame", points.description);
  return points.las ? text + las_lines(points, inputs, box) : text;
}

Json points_facts_report(const PointSet& points, const std::string& command_line) {
  Json report{{"scarp", version()}, {"command", command_line}};
  report["points"] = Json{{"path", points.path},         {"format", points.format},
                          {"count", points.size()},      {"crs", points.crs},
                          {"frame", points.description}, {"bounds", describe_box(box_of(points))},
                          {"columns", points.columns},   {"without_height", points.without_height},
                          {"unit", points.heights.unit}};
  if (points.las) {
    report["points"]["las"] = describe_las(*points.las);
    report["points"]["density"] = density(points, box_of(points));
  }
  report["warnings"] = points.warnings;
  return report;
}

std::string mesh_facts(const MeshFile& file) {
  const Mesh& mesh = file.mesh;
  const Box box = box_of(mesh);
  std::string attributes;
  for (const std::string& name : list_attributes(mesh)) attributes += (attributes.empty() ? "" : ", ") + name;
  std::string text = file.path + "\n";
  text += fact_line("format", fmt::format("{}, {}", file.format, format_bytes(file.bytes)));
  text += fact_line(
      "mesh", fmt::format("{}, {} vertices{}", format_plural(mesh.triangle_count(), "triangle"),
                          format_count(mesh.vertex_count()), measure_solid(mesh).is_solid() ? ", a closed solid" : ""));
  if (mesh.vertex_count() > 0) text += range_line("x", box, 0) + range_line("y", box, 1) + range_line("z", box, 2);
  text += fact_line("in the file", describe_axes(file));
  text += fact_line("attributes", attributes.empty() ? "none" : attributes);
  for (const auto& [key, value] : metadata_of(file)) {
    constexpr std::size_t kMost = 200;
    text += fact_line(key.c_str(), value.size() > kMost ? value.substr(0, kMost) + " ..." : value);
  }
  return text;
}

Json mesh_facts_report(const MeshFile& file, const std::string& command_line) {
  Json report{{"scarp", version()}, {"command", command_line}};
  report["mesh"] = Json{{"path", file.path},
                        {"format", file.format},
                        {"bytes", file.bytes},
                        {"triangles", file.mesh.triangle_count()},
                        {"vertices", file.mesh.vertex_count()},
                        {"closed", measure_solid(file.mesh).is_solid()},
                        {"bounds", file.mesh.vertex_count() > 0 ? describe_box(box_of(file.mesh)) : Json(nullptr)},
                        {"axes", axes_report(file)},
                        {"attributes", list_attributes(file.mesh)},
                        {"metadata", metadata_of(file)}};
  return report;
}

}  // namespace scarp::cli
