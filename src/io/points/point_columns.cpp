// Text in columns seldom has a header line that declares their contents. Without a header, the columns are x, y and
// height. After labels, they may also be northing, easting and height, the order of surveyors. If the values do not
// show the order, the user must give it, since a mirrored mesh also resembles land.
#include "io/points/point_columns.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <optional>
#include <unordered_set>

#include "io/commands.h"
#include "io/mesh/mesh_file_text.h"
#include "io/points/column_facts.h"
#include "io/points/column_names.h"
#include "io/points/text_lines.h"

namespace scarp::io {
namespace {

constexpr std::size_t kMostRows = 1 << 16;
constexpr std::array<ColumnRole, 3> kAxes{ColumnRole::kX, ColumnRole::kY, ColumnRole::kHeight};

std::vector<std::string_view> fields_of(std::string_view line, char separator) {
  std::vector<std::string_view> fields;
  while (const auto field = take_field(line, separator)) fields.push_back(*field);
  return fields;
}

std::size_t count_numbers(std::string_view line, char separator) {
  std::size_t numbers = 0;
  while (const auto field = take_field(line, separator)) numbers += parse_field(*field, separator != ',') ? 1 : 0;
  return numbers;
}

Rows look_at_rows(TextLines lines, std::string_view line, const PointColumns& columns) {
  Rows rows;
  std::unordered_set<std::string_view> labels;
  bool more = !columns.has_header || lines.next(line);
  for (; more && rows.count < kMostRows; more = lines.next(line)) {
    ++rows.count;
    std::size_t k = 0;
    while (const auto field = take_field(line, columns.separator)) {
      if (k == kMostColumns) break;
      if (k == rows.columns.size()) rows.columns.emplace_back();
      rows.columns[k].add(*field, columns.has_decimal_comma());
      if (k == 0) rows.are_labels_unique = labels.insert(*field).second && rows.are_labels_unique;
      ++k;
    }
  }
  while (!rows.columns.empty() && rows.columns.back().filled == 0) rows.columns.pop_back();  // trailing separators
  return rows;
}

std::string describe(const PointColumns& columns, std::size_t count) {
  std::string words;
  for (std::size_t k = 0; k < count; ++k) {
    const auto axis = std::find(columns.at.begin(), columns.at.end(), k);
    const std::string name = k < columns.names.size() ? " " + in_quotes(columns.names[k]) : "";
    const char* role =
        axis == columns.at.end() ? "not read" : role_name(kAxes[static_cast<std::size_t>(axis - columns.at.begin())]);
    words += fmt::format("{}{} {}{}", words.empty() ? "" : ", ", k + 1, role, name);
  }
  return words;
}

/// Finds the columns of x, y and height by a header's names; false if one is missing.
bool read_names(const std::string& z_field, PointColumns& columns, std::size_t& missing) {
  for (std::size_t axis = 0; axis < kAxes.size(); ++axis) {
    std::optional<std::size_t> best;
    const bool is_named = axis == 2 && !z_field.empty();
    for (std::size_t k = 0; k < columns.names.size(); ++k) {
      const std::string& name = columns.names[k];
      if (is_named ? lowered(name) != lowered(z_field) : role_of(name) != kAxes[axis]) continue;
      // The first of several names of equal rank counts, unless it is in the first column: "n, UTM_N, UTM_E".
      const auto is_better = [&] {
        const std::size_t rank = rank_of(name), least = rank_of(columns.names[*best]);
        return rank < least || (rank == least && *best == 0 && axis < 2);
      };
      if (!best || (!is_named && is_better())) best = k;
      if (axis == 2 && !is_named) columns.heights.push_back(k);
    }
    missing = axis;
    if (!best) return false;
    columns.at[axis] = *best;
    if (axis < 2) columns.in_degrees = columns.in_degrees || names_degrees(columns.names[*best]);
  }
  std::erase(columns.heights, columns.at[2]);
  return true;
}

void take_names(std::string_view line, char separator, PointColumns& columns) {
  columns.names.clear();
  columns.heights.clear();
  for (const std::string_view field : fields_of(line, separator)) columns.names.emplace_back(field);
}

void take_units(PointColumns& columns) {
  for (std::size_t axis = 0; axis < columns.at.size(); ++axis) {
    if (columns.at[axis] < columns.names.size()) columns.units[axis] = unit_named_in(columns.names[columns.at[axis]]);
  }
}

/// The value of --columns for columns at these positions.
std::string option_for(std::size_t count, std::array<std::size_t, 3> at, bool has_number) {
  std::string text(std::min(count, kMostColumns), '-');
  text.resize(*std::max_element(at.begin(), at.end()) + 1);
  for (std::size_t axis = 0; axis < at.size(); ++axis) text[at[axis]] = "enz"[axis];
  if (has_number && text[0] == '-') text[0] = 'p';
  return text;
}

/// Warns of headers with x and y in which x may be the northing, as geodesists define it: x is larger, or y precedes x.
void warn_of_turned_names(const Rows& rows, PointColumns& columns) {
  const auto [x, y, height] = columns.at;
  if (std::max(x, y) >= rows.columns.size()) return;
  const ColumnFacts &across = rows.columns[x], &up = rows.columns[y];
  if (!is_axis_letter(columns.names[x]) || !is_axis_letter(columns.names[y])) return;
  const bool are_on_map = across.low >= 1e5 && up.low >= 1e5;
  if (!fit_pair(across, up).is_north_first && !(are_on_map && y < x)) return;
  columns.warnings.push_back(
      fmt::format("x begins at {:.9g} and y at {:.9g}: if x is the northing here, as on many geodetic grids, name the "
                  "columns with --columns {}",
                  across.low, up.low, option_for(rows.columns.size(), {y, x, height}, false)));
}

bool are_degrees(const ColumnFacts& a, const ColumnFacts& b, const ColumnFacts& height) {
  const double extent = std::max(a.extent(), b.extent());
  return a.lies_in(-180, 180.1) && b.lies_in(-180, 180.1) && !a.are_whole && !b.are_whole && extent < 10 &&
         height.extent() > 10 * extent;
}

/// Checks if other columns are more likely x, y and height than the first three.
Result<void> check_places(const Rows& rows, const std::vector<std::size_t>& list, const std::string& name,
                          PointColumns& columns) {
  const auto option_at = [&](std::size_t one, std::size_t other, std::size_t height) {
    const ColumnFacts &a = rows.columns[one], &b = rows.columns[other];
    const PairFit fit = fit_pair(a, b);
    const bool is_turned =
        (fit.is_north_first && !fit.is_east_first) || (a.lies_in(-90, 90.1) && b.lies_in(-180, 180.1) && b.high > 90.1);
    const std::array<std::size_t, 3> at{is_turned ? other : one, is_turned ? one : other, height};
    return "--columns " + option_for(rows.columns.size(), at, list[0] > 0);
  };
  if (const auto k = find_later_pair(rows, list))
    return fail(ErrorKind::kInput,
                fmt::format("{}: columns {} and {} would be x and y, but {} and {} look more like them, and no header "
                            "names the columns: give {}, or name them otherwise",
                            name, list[0] + 1, list[1] + 1, list[*k] + 1, list[*k + 1] + 1,
                            option_at(list[*k], list[*k + 1], list[*k + 2])));
  const auto doubt = doubt_height(rows, list);
  if (!doubt) return {};
  const ColumnFacts& instead = rows.columns[doubt->instead];
  const std::string sentence =
      fmt::format("column {} would be the height and {}, while column {} reaches from {:.9g} to {:.9g}", list[2] + 1,
                  doubt->why, doubt->instead + 1, instead.low, instead.high);
  const std::string other = option_at(list[0], list[1], doubt->instead);
  if (!doubt->is_certain) {
    columns.warnings.push_back(fmt::format("{}: if that is the height, give {}", sentence, other));
    return {};
  }
  return fail(ErrorKind::kInput, fmt::format("{}: {}, and no header names the columns: give {} or {}", name, sentence,
                                             other, option_at(list[0], list[1], list[2])));
}

/// Determines which of the two columns before the height is the northing.
Result<void> tell_apart(const Rows& rows, const std::vector<std::size_t>& list, const std::string& name,
                        PointColumns& columns) {
  const ColumnFacts &a = rows.columns[list[0]], &b = rows.columns[list[1]], &height = rows.columns[list[2]];
  const bool has_labels = list[0] > 0;
  columns.at = {list[0], list[1], list[2]};
  const std::array<std::size_t, 3> turned{list[1], list[0], list[2]};
  const std::string straight_option = option_for(rows.columns.size(), columns.at, has_labels),
                    turned_option = option_for(rows.columns.size(), turned, has_labels);
  const std::string options = fmt::format("--columns {} or --columns {}", straight_option, turned_option);
  SCARP_RETURN_IF_ERROR(check_places(rows, list, name, columns));
  constexpr double kHighest = 1e5;  // the highest summit is at 29,032 feet
  if (height.low > kHighest || height.high < -kHighest)
    return fail(ErrorKind::kInput,
                fmt::format("{}: column {} would be the height, and reaches from {:.9g} to {:.9g}: no header names the "
                            "columns, so name them with --columns, such as --columns number,easting,northing,height",
                            name, list[2] + 1, height.low, height.high));
  if (are_degrees(a, b, height)) {
    const bool is_lat_first = a.lies_in(-90, 90.1) && !b.lies_in(-90, 90.1),
               is_lon_first = b.lies_in(-90, 90.1) && !a.lies_in(-90, 90.1);
    if (is_lat_first == is_lon_first)
      return fail(ErrorKind::kInput,
                  fmt::format("{}: columns {} and {} look like degrees, and no header says which is the longitude: "
                              "give {}",
                              name, list[0] + 1, list[1] + 1, options));
    if (is_lat_first) columns.at = turned;
    return {};
  }
  if (has_labels ? is_easting(a) && is_northing(b) : !fit_pair(a, b).is_north_first) return {};
  if (!has_labels || !is_northing(a) || !is_easting(b))
    return fail(ErrorKind::kInput,
                fmt::format("{}: no header says which of the columns {} and {} is the easting: give {}", name,
                            list[0] + 1, list[1] + 1, options));
  columns.at = turned;
  columns.warnings.push_back(fmt::format(
      "column {} ({:.9g} ...) is taken for the northing and column {} ({:.9g} ...) for the easting, by their "
      "size, since no header names them: --columns {} reads them the other way round",
      list[0] + 1, a.first, list[1] + 1, b.first, straight_option));
  return {};
}

Result<void> read_header(std::string_view line, const std::string& name, std::uint64_t number,
                         const ReadPointsOptions& options, PointColumns& columns) {
  take_names(line, columns.separator, columns);
  std::size_t missing = 0;
  if (read_names(options.z_field, columns, missing)) return {};
  constexpr const char* kUsual[] = {"x, easting, east, e, lon, rechtswert", "y, northing, north, n, lat, hochwert",
                                    "z, height, elevation, h, alt, hoehe"};
  const bool is_named = missing == 2 && !options.z_field.empty();
  return fail(ErrorKind::kInput,
              fmt::format("{}: line {} names no column {}: {} has none of the names {}; {}--columns names columns by "
                          "their order, such as --columns number,easting,northing,height",
                          name, number, std::string_view("xyz").substr(missing, 1), in_quotes(line),
                          is_named ? options.z_field : kUsual[missing],
                          missing == 2 && !is_named ? "--z-field names another, and " : ""));
}

/// The number of the last line of a preface: text before the column names or points. 0 if the first line, `line`, is no
/// such text.
std::uint64_t find_preface(TextLines lines, std::string_view line, const ReadPointsOptions& options) {
  constexpr int kMostLines = 50;
  std::size_t missing = 0;
  PointColumns first;
  take_names(line, find_separator(line), first);
  if (read_names(options.z_field, first, missing)) return 0;
  std::uint64_t last = lines.number();
  std::string_view next;
  for (int k = 0; k < kMostLines && lines.next(next); ++k) {
    const char separator = find_separator(next);
    PointColumns later;
    take_names(next, separator, later);
    const bool are_names = is_header(next, separator) && read_names(options.z_field, later, missing);
    const bool are_numbers = count_numbers(next, separator) >= 3 && fields_of(line, separator).size() < 3;
    if (are_names || are_numbers) return last;
    if (count_numbers(next, separator) >= 3) return 0;
    last = lines.number();
  }
  return 0;
}

}  // namespace

char find_separator(std::string_view line) {
  if (line.find(';') != std::string_view::npos) return ';';
  for (const char separator : {'\t', ' ', ','}) {
    const bool is_there = line.find(separator) != std::string_view::npos;
    if (is_there && count_numbers(line, separator) >= 2) return separator;
  }
  for (const char separator : {'\t', ','}) {
    if (line.find(separator) != std::string_view::npos) return separator;
  }
  return ' ';
}

bool is_header(std::string_view line, char separator) {
  std::string_view rest = line;
  const auto first = take_field(rest, separator);
  return !(first && parse_field(*first, separator != ',')) && count_numbers(line, separator) < 2;
}

Result<PointColumns> find_columns(std::string_view text, const std::string& name, const ReadPointsOptions& options) {
  PointColumns columns;
  TextLines lines(text);
  std::string_view line;
  if (!lines.next(line)) return fail(ErrorKind::kInternal, name + ": there is no line");
  columns.separator = find_separator(line);
  columns.has_header = is_header(line, columns.separator);
  if (!options.columns.empty()) {
    if (!options.z_field.empty())
      return fail(ErrorKind::kUsage, "--columns and --z-field both name the height: leave one out");
    SCARP_TRY(columns.at, parse_columns(options.columns, columns.words));
    if (columns.has_header) take_names(line, columns.separator, columns);
    take_units(columns);
    return columns;
  }
  const Rows rows = look_at_rows(lines, line, columns);
  const bool may_be_split =
      columns.separator == ',' && (!columns.has_header || rows.columns.size() > fields_of(line, ',').size());
  if (may_be_split && are_split_at_commas(rows))
    return fail(ErrorKind::kInput,
                fmt::format("{}: numbers seem to have a decimal comma, and commas stand between the columns, too: "
                            "separate the columns with semicolons, or write numbers with a decimal point",
                            name));
  std::size_t missing = 0;
  if (columns.has_header) {
    if (const std::uint64_t last = find_preface(lines, line, options); last > 0)
      return fail(ErrorKind::kInput,
                  fmt::format("{}: line {} names no columns and holds no point: put # in front of all lines up to {} "
                              "that do not ({})",
                              name, lines.number(), last, comment_out_command(name, last)));
    SCARP_RETURN_IF_ERROR(read_header(line, name, lines.number(), options, columns));
    warn_of_turned_names(rows, columns);
  } else if (const std::string_view comment = lines.comment(); !comment.empty()) {
    take_names(comment, find_separator(comment), columns);
    const bool is_whole = columns.names.size() == rows.columns.size();
    if (!is_whole || !read_names(options.z_field, columns, missing)) take_names({}, ',', columns);
  }
  if (columns.names.empty()) {
    if (!options.z_field.empty())
      return fail(ErrorKind::kInput, fmt::format("{}: there is no column {}, for no header line names the columns: put "
                                                 "one in front, such as x,y,{}, or name them with --columns",
                                                 name, in_quotes(options.z_field), options.z_field));
    const std::vector<std::size_t> list = rows.coordinates();
    columns.in_degrees = false;
    if (list.size() >= 3) {
      SCARP_RETURN_IF_ERROR(tell_apart(rows, list, name, columns));
    }
  }
  take_units(columns);
  columns.words = describe(columns, rows.columns.size());
  return columns;
}

}  // namespace scarp::io
