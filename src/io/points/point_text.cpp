// Points as text of columns: CSV, XYZ and their relatives.
//
// The first line that is no comment settles everything: the separator, and, if it begins with a word instead of a
// number, which columns are x, y and z. After that a line costs three numbers, read in place.
#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <charconv>
#include <cmath>
#include <optional>
#include <string_view>
#include <vector>

#include "io/mesh/mesh_file_text.h"
#include "io/points/point_source.h"

namespace scarp {
namespace {

bool is_blank_in_line(char c) { return c == ' ' || c == '\t'; }

std::string_view trimmed(std::string_view text) {
  while (!text.empty() && is_blank_in_line(text.front())) text.remove_prefix(1);
  while (!text.empty() && is_blank_in_line(text.back())) text.remove_suffix(1);
  return text;
}

/// The lines of a text without their ends; comments and empty ones are passed over.
class Lines {
 public:
  explicit Lines(std::string_view text) : rest_(text) {
    if (rest_.substr(0, 3) == "\xef\xbb\xbf") rest_.remove_prefix(3);  // a byte order mark
  }
  bool next(std::string_view& line) {
    while (!rest_.empty()) {
      const std::size_t end = std::min(rest_.find('\n'), rest_.size());
      line = rest_.substr(0, end);
      rest_.remove_prefix(std::min(end + 1, rest_.size()));
      ++number_;
      if (!line.empty() && line.back() == '\r') line.remove_suffix(1);
      const std::string_view content = trimmed(line);
      if (!content.empty() && content.front() != '#') return true;
    }
    return false;
  }
  /// Of the line that next() gave last, from 1.
  std::uint64_t number() const { return number_; }
  std::size_t bytes_left() const { return rest_.size(); }

 private:
  std::string_view rest_;
  std::uint64_t number_ = 0;
};

/// ' ' stands for runs of blanks and tabs.
char find_separator(std::string_view line) {
  for (const char separator : {';', ',', '\t'}) {
    if (line.find(separator) != std::string_view::npos) return separator;
  }
  return ' ';
}

/// Takes the first field off the line; nothing if there is none left.
std::optional<std::string_view> take_field(std::string_view& line, char separator) {
  if (separator == ' ') {
    line = trimmed(line);
    if (line.empty()) return std::nullopt;
    const std::size_t end = std::min(line.find_first_of(" \t"), line.size());
    const std::string_view field = line.substr(0, end);
    line.remove_prefix(end);
    return field;
  }
  if (line.data() == nullptr) return std::nullopt;
  const std::size_t end = line.find(separator);
  const std::string_view field = trimmed(line.substr(0, end));
  line = end == std::string_view::npos ? std::string_view() : line.substr(end + 1);
  return field;
}

/// Of a number that no double is near to: whether it is too small rather than too large.
bool is_below_one(std::string_view number) {
  const std::size_t e = std::min(number.find_first_of("eE"), number.size());
  const std::string_view digits = number.substr(0, e);
  std::int64_t exponent = 0;
  if (e < number.size()) {
    std::string_view text = number.substr(e + 1);
    if (text.starts_with('+')) text.remove_prefix(1);
    if (std::from_chars(text.data(), text.data() + text.size(), exponent).ec == std::errc::result_out_of_range)
      return text.starts_with('-');
  }
  const auto place = [&](std::string_view wanted) {
    return static_cast<std::int64_t>(std::min(digits.find_first_of(wanted), digits.size()));
  };
  return exponent < place("123456789") - place(".");
}

/// Nothing if the text is no number; infinities and NaN are numbers here, as is what overflows. What underflows is 0.
std::optional<double> parse(std::string_view text) {
  if (text.size() > 1 && text[0] == '+' && text[1] != '-') text.remove_prefix(1);
  double value = 0;
  const auto [end, error] = std::from_chars(text.data(), text.data() + text.size(), value);
  if (end != text.data() + text.size() || text.empty()) return std::nullopt;
  if (error == std::errc::result_out_of_range) return is_below_one(text) ? 0 : HUGE_VAL;
  if (error != std::errc()) return std::nullopt;
  return value;
}

/// The first of several fields that is a number but for its comma; empty if there is none.
std::string_view find_decimal_comma(std::string_view line) {
  line = trimmed(line);
  constexpr std::string_view kSeparators = "; \t";
  if (line.find_first_of(kSeparators) == std::string_view::npos) return {};
  while (!line.empty()) {
    const std::string_view field = line.substr(0, line.find_first_of(kSeparators));
    line.remove_prefix(std::min(field.size() + 1, line.size()));
    const std::size_t comma = field.find(',');
    if (comma == std::string_view::npos || field.find_first_of("0123456789", comma) != comma + 1) continue;
    std::string number(field);
    number[comma] = '.';
    if (parse(number)) return field;
  }
  return {};
}

tl::unexpected<Error> refuse_decimal_comma(std::string_view field, const std::string& name, std::uint64_t number) {
  return fail(ErrorKind::kInput, fmt::format("{}: line {}: {} has a decimal comma: write numbers with a decimal point",
                                             name, number, in_quotes(field)));
}

struct Columns {
  char separator = ',';
  std::array<std::size_t, 3> at{0, 1, 2};  ///< of x, y and z, from 0
  bool has_header = false;
  bool in_degrees = false;  ///< by the names in the header
};

/// The name of a column, without quotes and in small letters.
std::string plain_name(std::string_view name) {
  if (name.size() >= 2 && name.front() == '"' && name.back() == '"') name = trimmed(name.substr(1, name.size() - 2));
  return lowered(name);
}

Result<Columns> read_header(std::string_view line, const std::string& name, std::uint64_t number,
                            const ReadPointsOptions& options) {
  Columns columns;
  columns.separator = find_separator(line);
  std::string_view rest = line;
  const auto first = take_field(rest, columns.separator);
  columns.has_header = first && !parse(*first);
  if (!columns.has_header) {
    if (!options.z_field.empty())
      return fail(ErrorKind::kInput, fmt::format("{}: there is no column {}, for no header line names the columns: put "
                                                 "one in front, such as x,y,{}",
                                                 name, in_quotes(options.z_field), options.z_field));
    return columns;
  }
  std::vector<std::string> names;
  rest = line;
  while (const auto field = take_field(rest, columns.separator)) names.push_back(plain_name(*field));
  std::vector<std::string> heights{"z", "height", "elevation", "elev", "h"};
  if (!options.z_field.empty()) heights = {plain_name(options.z_field)};
  const std::array<std::vector<std::string>, 3> wanted{{{"x", "easting", "east", "longitude", "lon", "long", "lng"},
                                                        {"y", "northing", "north", "latitude", "lat"},
                                                        heights}};
  for (std::size_t k = 0; k < 3; ++k) {
    const auto found = std::find_first_of(wanted[k].begin(), wanted[k].end(), names.begin(), names.end());
    if (found == wanted[k].end()) {
      if (const auto field = find_decimal_comma(line); !field.empty()) return refuse_decimal_comma(field, name, number);
      return fail(ErrorKind::kInput,
                  fmt::format("{}: line {} names no column {}: {} has none of the names {}{}", name, number,
                              std::string_view("xyz").substr(k, 1), in_quotes(line), fmt::join(wanted[k], ", "),
                              k == 2 && options.z_field.empty() ? "; --z-field names another" : ""));
    }
    columns.at[k] = static_cast<std::size_t>(std::find(names.begin(), names.end(), *found) - names.begin());
    columns.in_degrees =
        columns.in_degrees || found->starts_with("lon") || found->starts_with("lat") || *found == "lng";
  }
  return columns;
}

/// What is wrong with a line that holds no point.
tl::unexpected<Error> explain(std::string_view line, const Columns& columns, const std::string& name,
                              std::uint64_t number) {
  const std::string_view decimal_comma = find_decimal_comma(line);
  std::vector<std::string_view> fields;
  while (const auto field = take_field(line, columns.separator)) fields.push_back(*field);
  for (std::size_t k = 0; k < 3; ++k) {
    const char axis = "xyz"[k];
    const bool is_number = columns.at[k] < fields.size() && parse(fields[columns.at[k]]);
    if (!is_number && !decimal_comma.empty()) return refuse_decimal_comma(decimal_comma, name, number);
    if (columns.at[k] >= fields.size())
      return fail(ErrorKind::kInput,
                  fmt::format("{}: line {} has {} columns, so that {} is missing", name, number, fields.size(), axis));
    const std::string_view field = fields[columns.at[k]];
    const auto value = parse(field);
    if (field.empty()) return fail(ErrorKind::kInput, fmt::format("{}: line {}: {} is empty", name, number, axis));
    if (!value && field.front() == '"')
      return fail(ErrorKind::kInput, fmt::format("{}: line {}: {} is {}: numbers in quotes are not read", name, number,
                                                 axis, in_quotes(field)));
    if (!value)
      return fail(ErrorKind::kInput,
                  fmt::format("{}: line {}: {} is {}, which is no number", name, number, axis, in_quotes(field)));
    if (!std::isfinite(*value))
      return fail(ErrorKind::kInput, fmt::format("{}: line {}: {} is {}, which is no finite number: remove that point",
                                                 name, number, axis, in_quotes(field)));
  }
  return fail(ErrorKind::kInternal, fmt::format("{}: line {} cannot be read", name, number));
}

bool read_line(std::string_view line, const Columns& columns, std::array<double, 3>& point) {
  const std::size_t last = *std::max_element(columns.at.begin(), columns.at.end());
  std::array<bool, 3> found{};
  for (std::size_t column = 0; column <= last; ++column) {
    const auto field = take_field(line, columns.separator);
    if (!field) return false;
    for (std::size_t k = 0; k < 3; ++k) {
      if (columns.at[k] != column) continue;
      const auto value = parse(*field);
      if (!value || !std::isfinite(*value)) return false;
      point[k] = *value;
      found[k] = true;
    }
  }
  return found[0] && found[1] && found[2];
}

/// Small coordinates on the globe under heights that are large beside them.
bool looks_like_degrees(const PointSet& points) {
  double extent = 0, relief = 0;
  for (std::size_t i = 0; i < points.size(); ++i) {
    if (std::abs(points.x[i]) > 180 || std::abs(points.y[i]) > 90) return false;
    extent = std::max({extent, std::abs(points.x[i] - points.x[0]), std::abs(points.y[i] - points.y[0])});
    relief = std::max(relief, std::abs(points.z[i] - points.z[0]));
  }
  return extent < 10 && relief > 10 * extent;
}

}  // namespace

bool looks_like_columns(std::span<const std::uint8_t> head) {
  std::string_view line;
  Lines lines({reinterpret_cast<const char*>(head.data()), head.size()});
  if (!lines.next(line)) return false;
  const auto field = take_field(line, find_separator(line));
  return field && parse(*field);
}

Result<PointSet> decode_columns(std::span<const std::uint8_t> bytes, const std::string& name,
                                const ReadPointsOptions& options) {
  if (!options.layer.empty())
    return fail(ErrorKind::kUsage, name + ": a text of columns has no layers: leave the layer out");
  if (!options.crs.empty() && options.crs != "source")
    return fail(ErrorKind::kUsage,
                fmt::format("{} says nothing of its CRS, so its coordinates cannot be given in '{}': ask for 'source', "
                            "or make a GeoPackage with a CRS of it (ogr2ogr -a_srs)",
                            name, options.crs));
  PointSet points;
  points.path = name;
  points.format = name.ends_with(".xyz") ? "XYZ" : "CSV";
  points.description = "the points' own coordinates (no CRS)";
  Lines lines({reinterpret_cast<const char*>(bytes.data()), bytes.size()});
  std::string_view line;
  if (!lines.next(line))
    return fail(ErrorKind::kInput, name + (bytes.empty() ? ": the file is empty" : ": the file holds no points"));
  const auto columns = read_header(line, name, lines.number(), options);
  if (!columns) return tl::unexpected(columns.error());
  bool has_line = !columns->has_header || lines.next(line);
  const std::size_t guess = bytes.size() / std::max<std::size_t>(8, line.size() + 1) + 16;
  for (auto* values : {&points.x, &points.y, &points.z}) values->reserve(guess);
  std::array<double, 3> point{};
  for (; has_line; has_line = lines.next(line)) {
    if (!read_line(line, *columns, point)) return explain(line, *columns, name, lines.number());
    points.x.push_back(point[0]);
    points.y.push_back(point[1]);
    points.z.push_back(point[2]);
    if (points.size() % (1 << 20) != 0 || !options.progress) continue;
    const double done = 1 - static_cast<double>(lines.bytes_left()) / static_cast<double>(bytes.size());
    if (!options.progress({"read", done, 0, 0})) return fail(ErrorKind::kCancelled, "cancelled while reading");
  }
  if (points.size() == 0) return fail(ErrorKind::kInput, name + ": the file holds a header line and no points");
  if (columns->in_degrees || looks_like_degrees(points))
    points.warnings.push_back(
        "x and y look like degrees, which do not mix with heights: make a GeoPackage with a CRS of the file "
        "(ogr2ogr -a_srs EPSG:4326) for a local frame in metres");
  return points;
}

}  // namespace scarp
