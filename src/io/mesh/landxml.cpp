// LandXML 1.2, the exchange format of civil engineering: one TIN surface. Numbered points have northing, easting and
// elevation; faces refer to three points. A Feature, LandXML's extension element, holds the mesh's metadata.
//
// A LandXML file has one unit for all lengths, including heights, and no degrees. So incompatible meshes are rejected
// rather than converted. The date required by the schema is constant, so that equal meshes give equal files.

#include <fmt/format.h>

#include <cmath>
#include <iterator>
#include <limits>

#include "io/mesh/id_table.h"
#include "io/mesh/mesh_file.h"
#include "io/mesh/mesh_file_text.h"
#include "io/mesh/xml_reader.h"
#include "io/raster/crs_description.h"
#include "io/raster/height_unit.h"
#include "scarp/version.h"

namespace scarp::io {
namespace {

constexpr std::string_view kOriginLabel = "scarp.origin", kFeature = "scarp";

struct LengthUnit {
  const char* name;  // in LandXML
  double metres;
  bool is_metric;
};
constexpr LengthUnit kUnits[] = {
    {"meter", 1, true},        {"foot", 0.3048, false},    {"USSurveyFoot", 1200.0 / 3937, false},
    {"kilometer", 1000, true}, {"centimeter", 0.01, true}, {"millimeter", 0.001, true},
    {"inch", 0.0254, false},   {"mile", 1609.344, false}};

const LengthUnit* find_unit(double metres) {
  for (const LengthUnit& unit : kUnits) {
    if (std::fabs(metres / unit.metres - 1) < 1e-9) return &unit;
  }
  return nullptr;
}

std::string value_of(const Mesh& mesh, const char* key) {
  const auto found = mesh.metadata.find(key);
  return found == mesh.metadata.end() ? std::string() : found->second;
}

tl::unexpected<Error> refuse_to_write(std::string why) { return fail(ErrorKind::kOutput, std::move(why)); }

/// The unit of all lengths, and the CRS if any.
struct Reference {
  const LengthUnit* unit = &kUnits[0];
  std::optional<CrsDescription> crs;
};

Result<Reference> find_reference(const Mesh& mesh) {
  Reference reference;
  if (const std::string crs = value_of(mesh, "crs"); !crs.empty()) {
    reference.crs = describe_crs(crs);
    if (!reference.crs)
      return refuse_to_write(fmt::format("LandXML names its unit of length, and that of {} is unknown here", crs));
    if (reference.crs->is_geographic) {
      return refuse_to_write(fmt::format(
          "LandXML has lengths only, and {} has degrees: choose a projected CRS, or the frame 'local'", crs));
    }
    reference.unit = find_unit(reference.crs->unit_in_metres);
    if (reference.unit == nullptr) {
      return refuse_to_write(
          fmt::format("LandXML has no name for the unit of {}, which is {} m", crs, reference.crs->unit_in_metres));
    }
  }
  const std::string unit = value_of(mesh, "unit");
  const double metres = find_metres(unit).value_or(reference.unit->metres);  // the default applies to unknown units
  if (const double factor = metres / reference.unit->metres; std::fabs(factor - 1) > 1e-9) {
    const LengthUnit* const named = find_unit(metres);
    return refuse_to_write(fmt::format(
        "LandXML has one unit for all lengths, and here x and y are in {} but heights in {} ({}): scale them by "
        "{:.10g} (--z-scale)",
        reference.unit->name, named != nullptr ? named->name : "another", unit, factor));
  }
  return reference;
}

std::string units_element(const LengthUnit& unit) {
  constexpr std::string_view kMetric =
      "volumeUnit=\"cubicMeter\" temperatureUnit=\"celsius\" pressureUnit=\"milliBars\" diameterUnit=\"millimeter\"";
  constexpr std::string_view kImperial =
      "volumeUnit=\"cubicYard\" temperatureUnit=\"fahrenheit\" pressureUnit=\"inchHG\" diameterUnit=\"inch\"";
  return fmt::format(
      "  <Units>\n    <{} areaUnit=\"{}\" linearUnit=\"{}\" {} angularUnit=\"decimal degrees\" "
      "directionUnit=\"decimal degrees\"/>\n  </Units>\n",
      unit.is_metric ? "Metric" : "Imperial", unit.is_metric ? "squareMeter" : "squareFoot", unit.name,
      unit.is_metric ? kMetric : kImperial);
}

std::string crs_element(const CrsDescription& crs) {
  std::string text = fmt::format("  <CoordinateSystem name=\"{}\"", with_entities(crs.name));
  if (!crs.epsg.empty()) text += fmt::format(" epsgCode=\"{}\"", crs.epsg);
  return text + fmt::format(" ogcWktCode=\"{}\"/>\n", with_entities(crs.wkt));
}

std::string property(std::string_view label, const std::string& value) {
  return fmt::format("        <Property label=\"{}\" value=\"{}\"/>\n", with_entities(label), with_entities(value));
}

/// Reads surfaces separately, since each has its own point numbers.
class LandXmlReader {
 public:
  explicit LandXmlReader(std::span<const std::uint8_t> bytes) : xml_(bytes) {}

  Mesh mesh;

  std::string read() {
    const auto add_text = [this] {
      if (in_point_ || in_face_) content_ += xml_.text();
    };
    std::string why = read_events(
        xml_, [this] { begin_element(); }, add_text, [this] { return end_element(); });
    if (why.empty() && origin_ && find_unreadable(mesh).empty()) set_origin(mesh, *origin_);
    return why;
  }

 private:
  void begin_element() {
    const std::string_view name = xml_.name();
    if (name == "Surface") {
      points_ = IdTable();
      corners_.clear();
      first_point_ = mesh.vertex_count();
      in_surface_ = true;
    } else if (in_surface_ && name == "Pnts") {
      in_points_ = true;
    } else if (in_surface_ && name == "Faces") {
      in_faces_ = true;
    } else if (in_points_ && name == "P") {
      in_point_ = true;
      number_ = xml_.attribute("id");
      content_.clear();
    } else if (in_faces_ && name == "F") {
      in_face_ = true;
      is_invisible_ = xml_.attribute("i") == "1";
      content_.clear();
    } else if (name == "Feature") {
      in_feature_ = xml_.attribute("code") == kFeature;
    } else if (in_feature_ && name == "Property") {
      read_property(xml_.attribute("label"), xml_.attribute("value"));
    }
  }

  std::string end_element() {
    const std::string_view name = xml_.name();
    std::string why;
    if (in_point_ && name == "P") {
      why = add_point();
      in_point_ = false;
    } else if (in_face_ && name == "F") {
      why = add_face();
      in_face_ = false;
    } else if (name == "Pnts") {
      in_points_ = false;
    } else if (name == "Faces") {
      in_faces_ = false;
    } else if (name == "Feature") {
      in_feature_ = false;
    } else if (name == "Surface" && in_surface_) {
      in_surface_ = in_points_ = in_faces_ = false;
      return end_surface();
    }
    return why.empty() ? why : fmt::format("line {}: {}", xml_.line(), why);
  }

  void read_property(const std::string& label, const std::string& value) {
    if (label == kOriginLabel) {
      origin_ = parse_origin(value);
    } else if (!label.empty()) {
      mesh.metadata[undo_ascii_text(label)] = undo_ascii_text(value);
    }
  }

  TextCursor words() const {
    return TextCursor({reinterpret_cast<const std::uint8_t*>(content_.data()), content_.size()});
  }

  std::string add_point() {
    std::int64_t number = 0;
    if (!parse_integer(number_, number)) return "a point needs a whole number as its name";
    TextCursor cursor = words();
    double p[3] = {};  // northing, easting, elevation
    for (double& part : p) {
      if (!parse_number(cursor.word_anywhere(), part) || !std::isfinite(part)) {
        return "a point needs its northing, easting and elevation as finite numbers";
      }
    }
    points_.add(number);
    mesh.positions.insert(mesh.positions.end(), {p[1], p[0], p[2]});
    return {};
  }

  std::string add_face() {
    if (is_invisible_) return {};
    TextCursor cursor = words();
    std::vector<std::int64_t> ids;
    for (std::string_view word = cursor.word_anywhere(); !word.empty(); word = cursor.word_anywhere()) {
      ids.emplace_back();
      if (!parse_integer(word, ids.back())) return "a face names a point that is no whole number";
    }
    if (ids.size() < 3) return "a face needs at least three points";
    for (std::size_t k = 2; k < ids.size(); ++k) corners_.insert(corners_.end(), {ids[0], ids[k - 1], ids[k]});
    return {};
  }

  std::string end_surface() {
    if (mesh.vertex_count() > std::numeric_limits<std::uint32_t>::max())
      return "it has more points than 32 bits number";
    if (const auto twice = points_.finish(static_cast<std::uint32_t>(first_point_))) {
      return fmt::format("two points of a surface have the number {}", *twice);
    }
    for (const std::int64_t corner : corners_) {
      const auto vertex = points_.find(corner);
      if (!vertex) return fmt::format("a face names point {}, which its surface has not", corner);
      mesh.triangles.push_back(*vertex);
    }
    return {};
  }

  XmlReader xml_;
  IdTable points_;                     // points of the current surface
  std::vector<std::int64_t> corners_;  // point numbers, three per triangle
  std::size_t first_point_ = 0;
  std::string number_, content_;  // number and content of the current point or face
  bool in_surface_ = false, in_points_ = false, in_faces_ = false, in_point_ = false, in_face_ = false;
  bool in_feature_ = false, is_invisible_ = false;
  std::optional<std::array<double, 3>> origin_;
};

}  // namespace

Result<std::vector<std::uint8_t>> encode_landxml(const Mesh& mesh) {
  SCARP_TRY(const auto& reference, find_reference(mesh));
  std::vector<std::uint8_t> bytes;
  bytes.reserve(mesh.positions.size() * 20 + mesh.triangles.size() * 10);
  auto out = std::back_inserter(bytes);
  fmt::format_to(out,
                 "<?xml version=\"1.0\" encoding=\"UTF-8\"?>\n"
                 "<LandXML xmlns=\"http://www.landxml.org/schema/LandXML-1.2\" version=\"1.2\" date=\"1970-01-01\" "
                 "time=\"00:00:00\" language=\"English\" readOnly=\"false\">\n{}",
                 units_element(*reference.unit));
  if (reference.crs) fmt::format_to(out, "{}", crs_element(*reference.crs));
  fmt::format_to(out,
                 "  <Application name=\"Scarp\" version=\"{}\"/>\n  <Surfaces>\n    <Surface name=\"terrain\">\n"
                 "      <Definition surfType=\"TIN\">\n        <Pnts>\n",
                 version());
  for (std::size_t v = 0; v < mesh.vertex_count(); ++v) {
    const auto p = mesh.vertex(v);
    fmt::format_to(out, "<P id=\"{}\">{} {} {}</P>\n", v + 1, p[1], p[0], p[2]);
  }
  fmt::format_to(out, "        </Pnts>\n        <Faces>\n");
  for (std::size_t t = 0; t < mesh.triangle_count(); ++t) {
    const std::uint32_t* corners = &mesh.triangles[3 * t];
    fmt::format_to(out, "<F>{} {} {}</F>\n", corners[0] + 1, corners[1] + 1, corners[2] + 1);
  }
  fmt::format_to(out, "        </Faces>\n      </Definition>\n");
  const bool has_origin = mesh.origin != std::array<double, 3>{};
  if (has_origin || !mesh.metadata.empty()) {
    fmt::format_to(out, "      <Feature code=\"{}\">\n", kFeature);
    if (has_origin) fmt::format_to(out, "{}", property(kOriginLabel, origin_text(mesh.origin)));
    for (const auto& [key, value] : mesh.metadata) {
      fmt::format_to(out, "{}", property(ascii_text(key), ascii_text(value)));
    }
    fmt::format_to(out, "      </Feature>\n");
  }
  fmt::format_to(out, "    </Surface>\n  </Surfaces>\n</LandXML>\n");
  return bytes;
}

Result<Mesh> decode_landxml(std::span<const std::uint8_t> bytes) {
  LandXmlReader reader(bytes);
  if (std::string why = reader.read(); !why.empty()) return fail(ErrorKind::kInput, std::move(why));
  return std::move(reader.mesh);
}

}  // namespace scarp::io
