// Reads points and breaklines of LandXML: survey points, and the source data of surfaces, or else the vertices of their
// TINs.
#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <optional>
#include <span>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

#include "io/lent.h"
#include "io/mesh/mesh_file_text.h"
#include "io/mesh/xml_reader.h"
#include "io/points/landxml.h"
#include "io/points/layer_list.h"
#include "io/points/line_points.h"
#include "io/points/point_heights.h"
#include "io/points/point_source.h"
#include "scarp/height_field.h"
#include "scarp/io.h"
#include "scarp/points.h"

namespace scarp::io {
namespace {

constexpr const char* kSurveyPoints = "CgPoints";

/// A surface, or the survey points.
struct Part {
  std::string name;
  PointSet source, vertices;                  ///< source data of a surface, and its TIN
  bool has_outer = false, has_voids = false;  ///< boundaries
  std::uint64_t faces = 0;
  std::uint64_t flat = 0, short_lines = 0;  ///< points and lines without elevation; lines with a single point

  bool has_source() const { return source.size() > 0; }
  PointSet& points() { return has_source() ? source : vertices; }
};

struct Content {
  std::vector<Part> parts;  ///< the survey points first
  LandXmlHead head;
};

class Reader {
 public:
  Reader(std::span<const std::uint8_t> bytes, std::optional<double> nodata) : xml_(bytes), nodata_(nodata) {
    content_.parts.push_back({kSurveyPoints, {}, {}});
  }

  Content take() { return std::move(content_); }

  /// Returns a complaint, or an empty string.
  std::string read() {
    const auto add_text = [this] {
      if (!reading_.empty()) text_ += xml_.text();
    };
    return read_events(
        xml_, [this] { begin_element(); }, add_text, [this] { return at_line(xml_, end_element()); });
  }

 private:
  Part& part() { return content_.parts.back(); }

  void begin_element() {
    const std::string_view name = xml_.name();
    content_.head.read(xml_);
    if (name == "Surface") {
      content_.parts.push_back({xml_.attribute("name"), {}, {}});
      in_surface_ = true;
    } else if (name == "SourceData") {
      in_source_ = in_surface_;
    } else if (name == "Breakline" || name == "Contour" || name == "Boundary") {
      line_ = name;
      elevation_ = xml_.attribute("elev");
      if (name == "Boundary" && in_surface_) note_boundary();
    } else if (name == "F" && in_surface_) {
      ++part().faces;
    } else if (is_list(name)) {
      reading_ = name;
      text_.clear();
    }
  }

  void note_boundary() {
    const bool is_outer = find_boundary_kind(xml_.attribute("bndType")) == BoundaryKind::kOuter;
    (is_outer ? part().has_outer : part().has_voids) = true;
  }

  bool is_list(std::string_view name) const {
    if (name == "CgPoint") return !in_surface_;
    if (name == "P") return in_surface_;
    return in_source_ && (name == "PntList3D" || name == "PntList2D");
  }

  std::string end_element() {
    const std::string_view name = xml_.name();
    if (name == "Surface") in_surface_ = false;
    if (name == "SourceData") in_source_ = false;
    if (name == line_) line_.clear();
    if (name != reading_) return {};
    std::string why;
    if (name == "CgPoint") {
      why = read_points(content_.parts.front().source, 0);
    } else if (name == "P") {
      why = read_points(part().vertices, 3);
    } else if (line_ != "Boundary") {
      why = read_list(name == "PntList3D");
    }
    reading_.clear();
    return why;
  }

  /// False for a point that --nodata omits.
  bool add(PointSet& points, double northing, double easting, double height) {
    if (nodata_ && height == *nodata_) {
      ++points.without_height;
      return false;
    }
    points.x.push_back(easting);
    points.y.push_back(northing);
    points.z.push_back(height);
    return true;
  }

  /// Reads one point. `wanted`: its number of coordinates; 0: a survey point, which may refer to another or lack a
  /// height.
  std::string read_points(PointSet& points, std::size_t wanted) {
    if (std::string why = read_numbers(text_, numbers_); !why.empty()) return why;
    if (wanted == 0 && numbers_.empty()) return {};
    if (wanted == 0 && numbers_.size() == 2) {
      ++content_.parts.front().flat;
      return {};
    }
    if (numbers_.size() != 3) return "a point needs its northing, easting and elevation";
    add(points, numbers_[0], numbers_[1], numbers_[2]);
    return {};
  }

  /// Reads a list of points; in a breakline or a contour, also their line.
  std::string read_list(bool has_heights) {
    if (std::string why = read_numbers(text_, numbers_); !why.empty()) return why;
    const std::size_t size = has_heights ? 3 : 2;
    if (numbers_.size() % size != 0)
      return fmt::format("a list of points has {} numbers, which {} does not divide", numbers_.size(), size);
    double elevation = 0;
    if (!has_heights && (!parse_number(elevation_, elevation) || !std::isfinite(elevation))) {
      ++part().flat;
      return {};
    }
    PointSet& points = part().source;
    LinePoints line(points);
    for (std::size_t k = 0; k < numbers_.size(); k += size) {
      if (add(points, numbers_[k], numbers_[k + 1], has_heights ? numbers_[k + 2] : elevation) && !line_.empty())
        line.add_last();
    }
    if (line_.empty()) return {};
    const std::string name = fmt::format("{} {} of the surface {}", line_, points.lines.size() + 1, part().name);
    if (!line.finish(name, line_ == "Breakline")) ++part().short_lines;
    return {};
  }

  XmlReader xml_;
  std::optional<double> nodata_;
  Content content_;
  std::string text_, reading_;    // content and name of the current element of points
  std::string line_, elevation_;  // the open breakline, contour or boundary
  std::vector<double> numbers_;
  bool in_surface_ = false, in_source_ = false;
};

std::string list_names(const std::vector<Part*>& parts) {
  std::string names;
  for (const Part* part : parts) names += (names.empty() ? "" : ", ") + part->name;
  return names;
}

Result<std::vector<Part*>> choose_parts(Content& content, const std::string& path, const std::string& wanted) {
  std::vector<Part*> filled;
  for (Part& part : content.parts) {
    if (part.points().size() > 0) filled.push_back(&part);
  }
  if (filled.empty()) return fail(ErrorKind::kInput, path + ": holds no points with northing, easting and elevation");
  if (wanted.empty() && filled.size() == 1) return filled;
  if (wanted.empty())
    return fail(ErrorKind::kInput,
                fmt::format("{}: holds {}: name those of the terrain with --layer A,B", path, list_names(filled)));
  const auto count = [&](const std::string& name) {
    return std::count_if(filled.begin(), filled.end(), [&](const Part* part) { return part->name == name; });
  };
  std::vector<Part*> chosen;
  for (const std::string& name : layer_list(wanted, count)) {
    if (count(name) > 1)
      return fail(ErrorKind::kInput, fmt::format("{}: holds two surfaces '{}': rename one", path, name));
    if (count(name) == 0)
      return fail(ErrorKind::kInput, fmt::format("{}: holds no '{}', only {}", path, name, list_names(filled)));
    const auto is_it = [&](const Part* part) { return part->name == name; };
    chosen.push_back(*std::find_if(filled.begin(), filled.end(), is_it));
  }
  return chosen;
}

/// Warns of everything that is omitted from the points.
void warn(const Part& part, PointSet& points) {
  const auto add = [&](const std::string& text) { points.warnings.push_back(points.path + ": " + text); };
  if (part.flat > 0) add(fmt::format("points and lines that have no elevation and were left out: {}", part.flat));
  if (part.short_lines > 0) add(fmt::format("lines of a single point, which count as points: {}", part.short_lines));
  if (part.has_outer)
    points.outlines.push_back(points.path + (part.name.empty() ? "" : ":" + part.name));
  else if (part.has_voids)
    add(fmt::format("the surface '{}' has voids without an outer boundary, which are not read", part.name));
  if (part.faces > 0 && !part.has_source())
    add(fmt::format("of the surface '{}' the vertices are read, not its triangles", part.name));
}

/// Sets the frame of x and y, and the unit of the heights.
Result<void> place(const Content& content, const ReadPointsOptions& options, PointSet& points) {
  const LandXmlHead& head = content.head;
  const HeightUnit unit = head.unit(), of_heights = head.height_unit();
  SCARP_RETURN_IF_ERROR(head.check(points.path));
  if (head.has_crs()) {
    points.crs = head.crs;
    SCARP_RETURN_IF_ERROR(place_lent_points(options, points));
    return settle_point_heights(options, of_heights, points);
  }
  if (!head.crs.empty()) points.warnings.push_back(warn_of_unknown_crs(head, points.path));
  points.unit_in_metres = points.heights.crs_unit_in_metres = unit.metres;
  points.heights.crs_unit = unit.name;
  SCARP_RETURN_IF_ERROR(place_without_crs(options, points));
  return settle_point_heights(options, of_heights, points);
}

}  // namespace

Result<PointSet> read_landxml_points(std::span<const std::uint8_t> bytes, const std::string& path,
                                     const ReadPointsOptions& options, const std::string& crs) {
  for (const auto& [option, value] :
       {std::pair{"--z-field", &options.z_field}, std::pair{"--columns", &options.columns}}) {
    if (!value->empty())
      return fail(ErrorKind::kUsage,
                  fmt::format("{} is for text and vector layers, and {} is LandXML: leave it out", option, path));
  }
  Reader reader(bytes, options.nodata);
  if (const std::string why = reader.read(); !why.empty()) return fail(ErrorKind::kInput, path + ": " + why);
  Content content = reader.take();
  if (content.head.crs.empty()) content.head.crs = crs;
  SCARP_TRY(const auto& parts, choose_parts(content, path, options.layer));
  PointSet points = parts.front()->points();
  points.path = path;
  points.format = "LandXML";
  for (Part* const part : parts) {
    if (part != parts.front()) SCARP_RETURN_IF_ERROR(append_points(part->points(), points));
    points.columns += (points.columns.empty() ? "" : ", ") +
                      (part->name == kSurveyPoints ? "survey points" : "surface " + part->name);
    warn(*part, points);
  }
  SCARP_RETURN_IF_ERROR(crop(options, points));
  SCARP_RETURN_IF_ERROR(place(content, options, points));
  return points;
}

}  // namespace scarp::io
