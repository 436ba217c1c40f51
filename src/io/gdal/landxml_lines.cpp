#include "io/gdal/landxml_lines.h"

#include <fmt/format.h>
#include <ogr_geometry.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <memory>
#include <utility>
#include <vector>

#include "io/points/landxml.h"
#include "io/points/point_source.h"
#include "io/raster/crs_description.h"
#include "scarp/io.h"

namespace scarp::gdal {
namespace {

using OwnedGeometry = std::unique_ptr<OGRGeometry>;
using Boundaries = std::vector<io::LandXmlBoundary>;

/// The boundaries of the surface. Fails if there are none, or if there are several surfaces and no name.
Result<Boundaries> choose(Boundaries all, const std::string& path, const std::string& surface) {
  std::vector<std::string> names;
  for (const io::LandXmlBoundary& one : all) {
    if (std::find(names.begin(), names.end(), one.surface) == names.end()) names.push_back(one.surface);
  }
  if (names.empty())
    return fail(ErrorKind::kInput, path + ": LandXML without boundaries, from which polygons are made");
  const std::string list = fmt::format("{}", fmt::join(names, ", "));
  if (surface.empty() && names.size() > 1)
    return fail(ErrorKind::kInput, fmt::format("{}: holds boundaries of several surfaces; name one, as in {}:{}: {}",
                                               path, path, names.front(), list));
  const std::string& name = surface.empty() ? names.front() : surface;
  std::erase_if(all, [&](const io::LandXmlBoundary& one) { return one.surface != name; });
  if (all.empty())
    return fail(ErrorKind::kInput, fmt::format("{} has no surface '{}' with boundaries (found: {})", path, name, list));
  if (std::none_of(all.begin(), all.end(),
                   [](const io::LandXmlBoundary& one) { return one.kind == io::BoundaryKind::kOuter; }))
    return fail(ErrorKind::kInput, fmt::format("{}: the surface {} has no outer boundary, only voids", path, name));
  return all;
}

OGRPolygon polygon_of(const Line& ring) {
  OGRLinearRing outline;
  for (const auto& point : ring.points) outline.addPoint(point[0], point[1]);
  OGRPolygon polygon;
  polygon.addRing(&outline);
  return polygon;
}

/// Calls `visit` for each part that is a polygon.
template <class Visit>
void each_polygon(const OGRGeometry& geometry, const Visit& visit) {
  const OGRwkbGeometryType type = wkbFlatten(geometry.getGeometryType());
  if (type == wkbMultiPolygon || type == wkbGeometryCollection) {
    for (const OGRGeometry* const part : *geometry.toGeometryCollection()) each_polygon(*part, visit);
  }
  if (type == wkbPolygon && !geometry.IsEmpty()) visit(*geometry.toPolygon());
}

/// The union of successive boundaries; null if GEOS fails.
OwnedGeometry unite(Boundaries::const_iterator first, Boundaries::const_iterator end) {
  OGRMultiPolygon all;
  for (; first != end; ++first) {
    const OwnedGeometry valid(polygon_of(first->ring).MakeValid());
    if (!valid) return nullptr;
    each_polygon(*valid, [&](const OGRPolygon& polygon) { all.addGeometry(&polygon); });
  }
  return OwnedGeometry(all.UnionCascaded());
}

void add_rings(const OGRPolygon& polygon, const std::string& name, LineSet& set) {
  constexpr double kUnknown = std::numeric_limits<double>::quiet_NaN();
  LineRole role = LineRole::kOuter;
  for (const OGRLinearRing* const ring : polygon) {
    Line line;
    for (int i = 0; i < ring->getNumPoints(); ++i) line.points.push_back({ring->getX(i), ring->getY(i), kUnknown});
    line.role = std::exchange(role, LineRole::kHole);
    line.polygon = set.polygons;
    line.name = name;
    set.lines.push_back(std::move(line));
  }
  ++set.polygons;
}

/// Sorts outer boundaries first, then by decreasing size.
void sort_boundaries(Boundaries& boundaries) {
  std::vector<std::pair<double, io::LandXmlBoundary>> sorted;
  for (io::LandXmlBoundary& one : boundaries) {
    constexpr double kFirst = std::numeric_limits<double>::infinity();
    const double area = one.kind == io::BoundaryKind::kOuter ? kFirst : polygon_of(one.ring).get_Area();
    sorted.emplace_back(area, std::move(one));
  }
  std::stable_sort(sorted.begin(), sorted.end(), [](const auto& a, const auto& b) { return a.first > b.first; });
  boundaries.clear();
  for (auto& [area, one] : sorted) boundaries.push_back(std::move(one));
}

/// Subtracts voids from larger boundaries and adds islands.
Result<void> make_polygons(Session& session, Boundaries boundaries, const std::string& name, LineSet& set) {
  if (std::none_of(boundaries.begin(), boundaries.end(),
                   [](const io::LandXmlBoundary& one) { return one.kind == io::BoundaryKind::kVoid; })) {
    for (io::LandXmlBoundary& one : boundaries) {
      one.ring.polygon = set.polygons++;
      one.ring.name = name;
      set.lines.push_back(std::move(one.ring));
    }
    return {};
  }
  if (!OGRGeometryFactory::haveGEOS())
    return fail(ErrorKind::kUsage, set.path + ": has voids, and GDAL was built without GEOS, which cuts them out");
  sort_boundaries(boundaries);
  OwnedGeometry whole = std::make_unique<OGRPolygon>();
  for (auto first = boundaries.cbegin(), end = first; first != boundaries.cend() && whole; first = end) {
    const bool is_void = first->kind == io::BoundaryKind::kVoid;
    end = std::find_if(first, boundaries.cend(), [is_void](const io::LandXmlBoundary& one) {
      return (one.kind == io::BoundaryKind::kVoid) != is_void;
    });
    const OwnedGeometry part = unite(first, end);
    whole.reset(!part ? nullptr : is_void ? whole->Difference(part.get()) : whole->Union(part.get()));
  }
  if (!whole)
    return fail(ErrorKind::kInput, fmt::format("{}: its voids cannot be cut out: {}", set.path, session.reason()));
  each_polygon(*whole, [&](const OGRPolygon& polygon) { add_rings(polygon, name, set); });
  if (set.lines.empty()) return fail(ErrorKind::kInput, set.path + ": its voids cover its outer boundaries");
  return {};
}

/// Fails unless the unit of a file without CRS is that of the input, or unknown.
Result<void> check_unit(const io::HeightUnit& unit, const std::string& path, const ReadLinesOptions& options) {
  const auto crs = io::describe_crs(options.crs);
  const double metres = !crs ? options.unit_in_metres : crs->is_geographic ? 0 : crs->unit_in_metres;
  if (unit.metres == 0 || metres == 0 || std::abs(unit.metres / metres - 1) <= 1e-5) return {};
  return fail(ErrorKind::kInput, fmt::format("{}: names no CRS, its unit is {}, and that of the input is {:.9g} m: "
                                             "correct linearUnit in the file, or add its CRS (epsgCode)",
                                             path, unit.name, metres));
}

}  // namespace

Result<LineSet> read_landxml_lines(Session& session, const std::string& path, const std::string& surface,
                                   const ReadLinesOptions& options) {
  SCARP_TRY(const auto& declared, io::read_declared_crs(path));
  SCARP_TRY(const auto& bytes, read_file(path));
  SCARP_TRY(auto&& found, io::read_landxml_boundaries(bytes, path));
  io::LandXmlHead& head = found.head;
  LineSet set;
  if (head.crs.empty()) head.crs = declared;
  SCARP_RETURN_IF_ERROR(head.check(path));
  if (head.has_crs()) {
    set.crs = head.crs;
  } else {
    if (!head.crs.empty()) set.warnings.push_back(io::warn_of_unknown_crs(head, path));
    SCARP_RETURN_IF_ERROR(check_unit(head.unit(), path, options));
  }
  SCARP_TRY(auto&& boundaries, choose(std::move(found.rings), path, surface));
  set.path = path;
  set.layer = boundaries.front().surface;
  set.format = "LandXML";
  SCARP_RETURN_IF_ERROR(
      make_polygons(session, std::move(boundaries), fmt::format("{}:{} boundary", path, set.layer), set));
  if (found.without_extent > 0)
    set.warnings.push_back(fmt::format("{}: boundaries of no extent, left out: {}", path, found.without_extent));
  if (found.has_breaklines && !options.ignore_z)
    set.warnings.push_back(path + ": of its surfaces only the boundaries are read as lines, not the breaklines");
  return set;
}

}  // namespace scarp::gdal
