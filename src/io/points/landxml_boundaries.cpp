// Boundaries of LandXML: lists of points, or references to survey points and vertices of the surface.
#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <limits>
#include <map>
#include <set>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

#include "io/points/landxml.h"

namespace scarp::io {
namespace {

using BoundaryPlace = std::array<double, 2>;           // easting, northing
using PointKey = std::pair<std::string, std::string>;  // surface, empty for survey points; name of the point

struct GivenBoundary {
  std::string surface;
  BoundaryKind kind = BoundaryKind::kOuter;
  std::vector<BoundaryPlace> places;
  std::vector<std::string> references;  ///< names of points, if given instead of coordinates
  std::size_t position = 0;             ///< in bytes from the start of the file
};

class BoundaryReader {
 public:
  /// `wanted`: points to find instead of boundaries; null: read boundaries.
  BoundaryReader(std::span<const std::uint8_t> bytes, const std::set<std::string>* wanted)
      : xml_(bytes), wanted_(wanted) {}

  std::string read() {
    const auto add_text = [this] {
      if (!reading_.empty()) text_ += xml_.text();
    };
    return read_events(
        xml_, [this] { begin_element(); }, add_text, [this] { return at_line(xml_, end_element()); });
  }

  LandXmlHead head;
  std::vector<GivenBoundary> boundaries;
  std::map<PointKey, BoundaryPlace> points;
  bool has_breaklines = false;

 private:
  void begin_element() {
    const std::string_view name = xml_.name();
    head.read(xml_);
    if (name == "Surface") {
      surface_ = xml_.attribute("name");
      in_surface_ = true;
    } else if (name == "Breakline" && in_surface_) {
      has_breaklines = true;
    } else if (name == "Boundary" && in_surface_) {
      type_ = xml_.attribute("bndType");
      boundaries.push_back({surface_, {}, {}, {}, xml_.position()});
      in_boundary_ = true;
    } else if (in_boundary_) {
      const std::string reference = xml_.attribute("pntRef");
      if (!reference.empty()) boundaries.back().references.push_back(reference);
      if (name == "PntList2D" || name == "PntList3D") start(name);
    } else if (wanted_ != nullptr && (in_surface_ ? name == "P" : name == "CgPoint")) {
      name_ = xml_.attribute(in_surface_ ? "id" : "name");
      if (wanted_->contains(name_)) start(name);
    }
  }

  void start(std::string_view element) {
    reading_ = element;
    text_.clear();
  }

  std::string end_element() {
    const std::string_view name = xml_.name();
    std::string why;
    if (name == "Surface") in_surface_ = false;
    if (name == "Boundary" && std::exchange(in_boundary_, false)) why = finish_boundary();
    if (name != reading_ || reading_.empty()) return why;
    why = in_boundary_ ? read_list(name == "PntList3D" ? 3 : 2) : read_point();
    reading_.clear();
    return why;
  }

  std::string finish_boundary() {
    const GivenBoundary& last = boundaries.back();
    const auto kind = find_boundary_kind(type_);
    if (!kind)
      return fmt::format("a boundary of the surface {} is of the kind '{}', which is not outer, void or island",
                         last.surface, type_.substr(0, 40));
    if (last.places.empty() && last.references.empty())
      return fmt::format("a boundary of the surface {} has no list of points", last.surface);
    boundaries.back().kind = *kind;
    return {};
  }

  std::string read_list(std::size_t size) {
    if (std::string why = read_numbers(text_, numbers_); !why.empty()) return why;
    if (numbers_.size() % size != 0)
      return fmt::format("a list of points has {} numbers, which {} does not divide", numbers_.size(), size);
    for (std::size_t k = 0; k < numbers_.size(); k += size)
      boundaries.back().places.push_back({numbers_[k + 1], numbers_[k]});
    return {};
  }

  std::string read_point() {
    if (std::string why = read_numbers(text_, numbers_); !why.empty()) return why;
    if (numbers_.size() >= 2) points[{in_surface_ ? surface_ : "", name_}] = {numbers_[1], numbers_[0]};
    return {};
  }

  XmlReader xml_;
  const std::set<std::string>* wanted_;
  std::string surface_, type_, name_;
  std::string text_, reading_;  // content and name of the current element
  std::vector<double> numbers_;
  bool in_surface_ = false, in_boundary_ = false;
};

/// The closed ring without repetitions; empty if it has no extent.
Line ring_of(const std::vector<BoundaryPlace>& places) {
  constexpr double kUnknown = std::numeric_limits<double>::quiet_NaN();
  Line ring;
  for (const auto& [x, y] : places) {
    if (ring.points.empty() || ring.points.back()[0] != x || ring.points.back()[1] != y)
      ring.points.push_back({x, y, kUnknown});
  }
  if (ring.points.size() < 3) return {};
  const auto &first = ring.points.front(), &last = ring.points.back();
  if (first[0] != last[0] || first[1] != last[1]) ring.points.push_back(std::array(first));
  if (ring.points.size() < 4) return {};
  ring.role = LineRole::kOuter;
  return ring;
}

/// Replaces references by the positions of their points. Returns a complaint, or an empty string.
std::string resolve(std::span<const std::uint8_t> bytes, std::vector<GivenBoundary>& boundaries) {
  std::set<std::string> wanted;
  for (const GivenBoundary& boundary : boundaries)
    wanted.insert(boundary.references.begin(), boundary.references.end());
  if (wanted.empty()) return {};
  BoundaryReader reader(bytes, &wanted);
  if (std::string why = reader.read(); !why.empty()) return why;
  for (GivenBoundary& boundary : boundaries) {
    for (const std::string& name : boundary.references) {
      auto found = reader.points.find({"", name});
      if (found == reader.points.end()) found = reader.points.find({boundary.surface, name});
      if (found == reader.points.end()) {
        XmlReader there(bytes);
        there.jump(boundary.position);
        return fmt::format("line {}: a boundary of the surface {} refers to the point '{}', which has no place",
                           there.line(), boundary.surface, name.substr(0, 40));
      }
      boundary.places.push_back(found->second);
    }
  }
  return {};
}

}  // namespace

std::optional<BoundaryKind> find_boundary_kind(const std::string& name) {
  constexpr std::array<std::pair<std::string_view, BoundaryKind>, 8> kKinds{{{"outer", BoundaryKind::kOuter},
                                                                             {"", BoundaryKind::kOuter},
                                                                             {"void", BoundaryKind::kVoid},
                                                                             {"hole", BoundaryKind::kVoid},
                                                                             {"inner", BoundaryKind::kVoid},
                                                                             {"hide", BoundaryKind::kVoid},
                                                                             {"island", BoundaryKind::kIsland},
                                                                             {"show", BoundaryKind::kIsland}}};
  for (const auto& [word, kind] : kKinds) {
    if (word == name) return kind;
  }
  return std::nullopt;
}

Result<LandXmlBoundaries> read_landxml_boundaries(std::span<const std::uint8_t> bytes, const std::string& path) {
  BoundaryReader reader(bytes, nullptr);
  std::string why = reader.read();
  if (why.empty()) why = resolve(bytes, reader.boundaries);
  if (!why.empty()) return fail(ErrorKind::kInput, path + ": " + why);
  LandXmlBoundaries found;
  found.head = std::move(reader.head);
  found.has_breaklines = reader.has_breaklines;
  for (GivenBoundary& boundary : reader.boundaries) {
    Line ring = ring_of(boundary.places);
    if (ring.points.empty())
      ++found.without_extent;
    else
      found.rings.push_back({std::move(boundary.surface), boundary.kind, std::move(ring)});
  }
  return found;
}

}  // namespace scarp::io
