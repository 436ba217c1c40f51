// Points as text in columns: CSV, XYZ and similar formats.
//
// The columns are determined once (point_columns.h). Then only three numbers per line are parsed, in place.
#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <optional>
#include <string_view>
#include <vector>

#include "io/commands.h"
#include "io/kinds.h"
#include "io/lent.h"
#include "io/mesh/mesh_file_text.h"
#include "io/points/column_names.h"
#include "io/points/point_columns.h"
#include "io/points/point_heights.h"
#include "io/points/point_source.h"
#include "io/points/text_lines.h"
#include "scarp/io.h"

namespace scarp::io {
namespace {

/// The first of several blank-separated fields that is a number with a decimal comma; empty if there is none.
std::string_view find_decimal_comma(std::string_view line) {
  if (trim_field(line).find_first_of(" \t") == std::string_view::npos) return {};
  while (const auto field = take_field(line, ' ')) {
    if (!parse_field(*field, false) && parse_field(*field, true)) return *field;
  }
  return {};
}

/// The complaint about a line that holds no point.
tl::unexpected<Error> explain(std::string_view line, const PointColumns& columns, const std::string& name,
                              std::uint64_t number) {
  const std::string_view decimal_comma = columns.separator == ',' ? find_decimal_comma(line) : std::string_view();
  std::vector<std::string_view> fields;
  while (const auto field = take_field(line, columns.separator)) fields.push_back(*field);
  for (std::size_t k = 0; k < 3; ++k) {
    const char axis = "xyz"[k];
    const auto value =
        columns.at[k] < fields.size() ? parse_field(fields[columns.at[k]], columns.has_decimal_comma()) : std::nullopt;
    if (!value && !decimal_comma.empty())
      return fail(
          ErrorKind::kInput,
          fmt::format("{}: line {}: {} has a decimal comma, and commas stand between the columns: separate them "
                      "with semicolons, or write numbers with a decimal point",
                      name, number, in_quotes(decimal_comma)));
    if (columns.at[k] >= fields.size())
      return fail(
          ErrorKind::kInput,
          fmt::format("{}: line {} has {} {}, so that {} is missing: put # in front of lines that hold no point", name,
                      number, fields.size(), fields.size() == 1 ? "column" : "columns", axis));
    if (value && std::isfinite(*value)) continue;
    const std::string_view field = fields[columns.at[k]];
    const char* fault = field.empty() ? "empty" : value ? ", which is no finite number" : ", which is no number";
    const std::string_view remedy =
        k == 2 ? ": --nodata nan leaves out all points without a height" : ": remove that point";
    if (field.empty())
      return fail(ErrorKind::kInput, fmt::format("{}: line {}: {} is {}{}", name, number, axis, fault, remedy));
    return fail(ErrorKind::kInput,
                fmt::format("{}: line {}: {} is {}{}{}", name, number, axis, in_quotes(field), fault, remedy));
  }
  return fail(ErrorKind::kInternal, fmt::format("{}: line {} cannot be read", name, number));
}

/// Reads x, y and z of a line; NaN for a field that is no finite number. False if fields are missing.
bool read_line(std::string_view line, const PointColumns& columns, std::array<double, 3>& point) {
  const std::size_t last = *std::max_element(columns.at.begin(), columns.at.end());
  for (std::size_t column = 0; column <= last; ++column) {
    const auto field = take_field(line, columns.separator);
    if (!field) return false;
    for (std::size_t k = 0; k < 3; ++k) {
      if (columns.at[k] != column) continue;
      const auto value = parse_field(*field, columns.has_decimal_comma());
      point[k] = value && std::isfinite(*value) ? *value : NAN;
    }
  }
  return true;
}

/// True for coordinates so small that they may be degrees, with heights that are large in comparison.
bool looks_like_degrees(const PointSet& points) {
  double extent = 0, relief = 0;
  for (std::size_t i = 0; i < points.size(); ++i) {
    if (std::abs(points.x[i]) > 180 || std::abs(points.y[i]) > 90) return false;
    extent = std::max({extent, std::abs(points.x[i] - points.x[0]), std::abs(points.y[i] - points.y[0])});
    relief = std::max(relief, std::abs(points.z[i] - points.z[0]));
  }
  return extent < 10 && relief > 10 * extent;
}

Result<void> read_lines_of(TextLines lines, std::string_view line, const PointColumns& columns,
                           const ReadPointsOptions& options, std::size_t bytes, PointSet& points) {
  const std::size_t guess = bytes / std::max<std::size_t>(8, line.size() + 1) + 16;
  for (auto* values : {&points.x, &points.y, &points.z}) {
    values->clear();
    values->reserve(guess);
  }
  // Columns named by the option may have a header that contradicts them.
  bool has_line = !columns.has_header || lines.next(line);
  std::array<double, 3> point{};
  for (; has_line; has_line = lines.next(line)) {
    const bool is_whole = read_line(line, columns, point);
    const bool is_left_out = options.nodata && (is_whole ? std::isnan(point[2]) || point[2] == *options.nodata : false);
    if (!is_whole || (!is_left_out && std::isnan(point[2])) || std::isnan(point[0]) || std::isnan(point[1]))
      return explain(line, columns, points.path, lines.number());
    if (is_left_out) {
      ++points.without_height;
      continue;
    }
    points.x.push_back(point[0]);
    points.y.push_back(point[1]);
    points.z.push_back(point[2]);
    if (points.size() % (1 << 20) != 0 || !options.progress) continue;
    const double done = 1 - static_cast<double>(lines.bytes_left()) / static_cast<double>(bytes);
    if (!options.progress({"read", done, 0, 0})) return fail(ErrorKind::kCancelled, "cancelled while reading");
  }
  return {};
}

bool are_all_alike(const std::vector<double>& heights) {
  return std::all_of(heights.begin(), heights.end(), [&](double z) { return z == heights.front(); });
}

/// Sets the units in the header.
void take_units_of(const PointColumns& columns, PointSet& points) {
  const auto& [x, y, height] = columns.units;
  points.heights.unit = height;
  const double metres = find_metres(x).value_or(0);
  if (metres == 0 || metres != find_metres(y).value_or(0)) return;
  points.unit_in_metres = points.heights.crs_unit_in_metres = metres;
  points.heights.crs_unit = x;
}

}  // namespace

std::string declare_crs_command(const std::string& path, const std::string& crs) {
  return fmt::format("echo {} > {}", crs, file_word(projection_path(path)));
}

bool looks_like_columns(std::span<const std::uint8_t> head) {
  std::string_view line;
  TextLines lines({reinterpret_cast<const char*>(head.data()), head.size()});
  return lines.next(line) && !is_header(line, find_separator(line));
}

Result<PointSet> decode_columns(std::span<const std::uint8_t> bytes, const std::string& name,
                                const ReadPointsOptions& options, const std::string& crs) {
  if (!options.layer.empty())
    return fail(ErrorKind::kUsage, name + ": a text of columns has no layers: leave the layer out");
  PointSet points;
  points.path = name;
  points.format = name.ends_with(".xyz") ? "XYZ" : "CSV";
  const std::string_view text{reinterpret_cast<const char*>(bytes.data()), bytes.size()};
  if (const std::string wide = describe_wide_text(name, text); !wide.empty())
    return fail(ErrorKind::kInput, fmt::format("{}: {}", name, wide));
  TextLines lines(text);
  std::string_view line;
  if (!lines.next(line))
    return fail(ErrorKind::kInput, name + (bytes.empty() ? ": the file is empty" : ": the file holds no points"));
  SCARP_TRY(auto&& columns, find_columns(text, name, options));
  SCARP_RETURN_IF_ERROR(read_lines_of(lines, line, columns, options, bytes.size(), points));
  if (points.size() == 0 && points.without_height == 0)
    return fail(ErrorKind::kInput, name + ": the file holds a header line and no points");
  if (points.size() == 0) return fail(ErrorKind::kInput, name + ": no point has a height other than that of --nodata");
  SCARP_RETURN_IF_ERROR(crop(options, points));
  points.warnings = std::move(columns.warnings);
  points.columns = columns.words;
  take_units_of(columns, points);
  const auto name_at = [&](std::size_t column) { return in_quotes(columns.names[column]); };
  if (!columns.heights.empty() && options.z_field.empty()) {
    const std::string chosen = name_at(columns.at[2]), other = columns.names[columns.heights.front()];
    if (are_all_alike(points.z)) {
      ReadPointsOptions with_other = options;
      with_other.z_field = other;
      auto again = decode_columns(bytes, name, with_other, crs);
      if (again)
        again->warnings.push_back(fmt::format(
            "{}: the heights of the column {} are all {:.9g}, so those of {} count: --z-field names another", name,
            chosen, points.z.front(), in_quotes(other)));
      return again;
    }
    points.warnings.push_back(fmt::format("{}: the heights are those of the column {}: --z-field {} reads the others",
                                          name, chosen, file_word(other)));
  }
  if (!crs.empty()) {
    points.crs = crs;
    SCARP_TRY(const auto& vertical, place_lent_points(options, points));
    SCARP_RETURN_IF_ERROR(settle_point_heights(options, vertical, points));
    return points;
  }
  if (columns.in_degrees || looks_like_degrees(points))
    points.warnings.push_back(fmt::format(
        "x and y look like degrees, which do not mix with heights: declare their CRS in a file next to it ({}) for a "
        "local frame in metres",
        declare_crs_command(name, "EPSG:4326")));
  SCARP_RETURN_IF_ERROR(place_without_crs(options, points));
  SCARP_RETURN_IF_ERROR(settle_point_heights(options, {}, points));
  return points;
}

}  // namespace scarp::io
