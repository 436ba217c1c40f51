// Polygons moved inwards, by GEOS.
#include <fmt/format.h>
#include <ogr_geometry.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <memory>

#include "base/caught.h"
#include "io/gdal/session.h"
#include "scarp/cutline.h"

namespace scarp::gdal {
namespace {

using Owned = std::unique_ptr<OGRGeometry>;

constexpr int kSegmentsPerQuarter = 8;

/// The parts of a geometry that are polygons.
void collect_polygons(const OGRGeometry& geometry, OGRMultiPolygon& polygons) {
  const OGRwkbGeometryType type = wkbFlatten(geometry.getGeometryType());
  if (type == wkbPolygon) {
    if (!geometry.IsEmpty()) polygons.addGeometry(&geometry);
  } else if (type == wkbMultiPolygon || type == wkbGeometryCollection) {
    const OGRGeometryCollection& parts = *geometry.toGeometryCollection();
    for (int i = 0; i < parts.getNumGeometries(); ++i) collect_polygons(*parts.getGeometryRef(i), polygons);
  }
}

/// In lengths of the distance, each valid by itself: what crosses itself is made whole, even-odd. False where GEOS
/// fails.
bool to_polygons(std::span<const Line> rings, const std::array<double, 2>& unit, OGRMultiPolygon& polygons) {
  for (std::size_t first = 0, end = 0; first < rings.size(); first = end) {
    OGRPolygon polygon;
    for (; end < rings.size() && rings[end].polygon == rings[first].polygon; ++end) {
      OGRLinearRing ring;
      for (const auto& point : rings[end].points) ring.addPoint(point[0] * unit[0], point[1] * unit[1]);
      polygon.addRing(&ring);
    }
    const Owned valid(polygon.MakeValid());
    if (!valid) return false;
    collect_polygons(*valid, polygons);
  }
  return true;
}

/// Coordinates can tell the distance from 0; GEOS makes polygons vanish where they cannot.
bool is_distance(double distance, const OGRGeometry& polygons) {
  OGREnvelope box;
  polygons.getEnvelope(&box);
  const double largest =
      std::max({std::abs(box.MinX), std::abs(box.MaxX), std::abs(box.MinY), std::abs(box.MaxY), 0.0});
  return std::abs(distance) > 0x1p-40 * largest;
}

/// Null where GEOS fails. Instead of segments GEOS takes minus the length of pointed corners.
OGRGeometry* buffer(const OGRGeometry& polygons, double distance, double sample) {
  constexpr int kPointed = -2;
  constexpr double kSteps = 256, kShare = 0.125;
  const Owned moved(polygons.Buffer(distance, std::abs(distance) < sample ? kPointed : kSegmentsPerQuarter));
  if (!moved || sample <= 0) return moved ? moved->clone() : nullptr;
  return moved->SimplifyPreserveTopology(std::min(sample / kSteps, kShare * std::abs(distance)));
}

void add_ring(const OGRLinearRing& ring, LineRole role, std::uint32_t polygon, const std::array<double, 2>& unit,
              const std::string& name, std::vector<Line>& rings) {
  Line line;
  line.role = role;
  line.polygon = polygon;
  line.name = name;
  for (int i = 0; i < ring.getNumPoints(); ++i)
    line.points.push_back({ring.getX(i) / unit[0], ring.getY(i) / unit[1], std::numeric_limits<double>::quiet_NaN()});
  if (line.points.size() >= 4) rings.push_back(std::move(line));
}

Result<std::vector<Line>> inset(std::span<const Line> rings, double distance, const std::array<double, 2>& unit,
                                double sample) {
  Session session(false);
  if (!OGRGeometryFactory::haveGEOS())
    return fail(ErrorKind::kUsage, "polygons cannot be moved inwards: GDAL was built without GEOS, which does that");
  OGRMultiPolygon polygons;
  const bool are_valid = to_polygons(rings, unit, polygons);
  const Owned whole(are_valid ? polygons.UnionCascaded() : nullptr);
  const bool moves = whole && is_distance(distance, *whole);
  const Owned moved(!whole ? nullptr : moves ? buffer(*whole, -distance, sample) : whole->clone());
  if (!moved)
    return fail(ErrorKind::kInput,
                fmt::format("the polygons cannot be moved inwards by {}: {}", distance, session.reason()));
  OGRMultiPolygon parts;
  collect_polygons(*moved, parts);
  const std::string name = rings.empty() ? "" : rings.front().name;
  std::vector<Line> result;
  for (int i = 0; i < parts.getNumGeometries(); ++i) {
    const OGRPolygon& polygon = *parts.getGeometryRef(i);
    const auto number = static_cast<std::uint32_t>(i);
    add_ring(*polygon.getExteriorRing(), LineRole::kOuter, number, unit, name, result);
    for (int k = 0; k < polygon.getNumInteriorRings(); ++k)
      add_ring(*polygon.getInteriorRing(k), LineRole::kHole, number, unit, name, result);
  }
  return result;
}

}  // namespace
}  // namespace scarp::gdal

namespace scarp {

Result<std::vector<Line>> inset_polygons(std::span<const Line> rings, double distance,
                                         const std::array<double, 2>& unit, double sample) try {
  return gdal::inset(rings, distance, unit, sample);
} catch (...) {
  return caught(ErrorKind::kInput, "move polygons inwards");
}

}  // namespace scarp
