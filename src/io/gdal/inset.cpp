// Moves polygons inwards, by GEOS.
#include <fmt/format.h>
#include <ogr_geometry.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <memory>
#include <vector>

#include "base/caught.h"
#include "io/gdal/session.h"
#include "scarp/lines.h"

namespace scarp::gdal {
namespace {

using OwnedGeometry = std::unique_ptr<OGRGeometry>;

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

/// Converts rings to valid polygons in units of the distance; resolves self-crossings by the even-odd rule. False if
/// GEOS fails.
bool to_polygons(std::span<const Line> rings, const std::array<double, 2>& unit, OGRMultiPolygon& polygons) {
  for (std::size_t first = 0, end = 0; first < rings.size(); first = end) {
    OGRPolygon polygon;
    for (; end < rings.size() && rings[end].polygon == rings[first].polygon; ++end) {
      OGRLinearRing ring;
      for (const auto& point : rings[end].points) ring.addPoint(point[0] * unit[0], point[1] * unit[1]);
      polygon.addRing(&ring);
    }
    const OwnedGeometry valid(polygon.MakeValid());
    if (!valid) return false;
    collect_polygons(*valid, polygons);
  }
  return true;
}

/// True if the rounding of coordinates preserves the distance; otherwise GEOS makes polygons vanish.
bool is_distance(double distance, const OGRGeometry& polygons) {
  OGREnvelope box;
  polygons.getEnvelope(&box);
  const double largest =
      std::max({std::abs(box.MinX), std::abs(box.MaxX), std::abs(box.MinY), std::abs(box.MaxY), 0.0});
  return std::abs(distance) > 0x1p-40 * largest;
}

using Place = std::array<double, 2>;

Place way(const Place& from, const Place& to) { return {to[0] - from[0], to[1] - from[1]}; }
double cross(const Place& u, const Place& v) { return u[0] * v[1] - u[1] * v[0]; }
double length(const Place& u) { return std::hypot(u[0], u[1]); }

/// A vertex that replaces those from the first to the last.
struct Corner {
  Place at, first, last;
};

/// Merges the middle two of the last four vertices at the point where the edges before and after them intersect, if
/// this point is near and on the side to which the ring was moved.
bool sharpen(std::vector<Corner>& ring, double distance) {
  constexpr double kReach = 1.7320508;  // relative to the distance: a corner of 60 degrees, twice as far away as its
                                        // arc
  if (ring.size() < 4) return false;
  Corner *const a = &ring[ring.size() - 3], *const b = a + 1;
  const Place in = way((a - 1)->at, a->at), out = way(b->at, (b + 1)->at), edge = way(a->at, b->at);
  const double turn = cross(in, out);
  if (!(turn * distance < 0)) return false;
  const double ahead = cross(edge, out) / turn, back = cross(in, edge) / turn;
  const Place at{a->at[0] + ahead * in[0], a->at[1] + ahead * in[1]};
  const double reach = std::max(length(way(a->first, at)), length(way(b->last, at)));
  if (!(ahead > 0 && back > 0 && reach <= kReach * std::abs(distance))) return false;
  *a = {at, a->first, b->last};
  ring.erase(ring.end() - 2);
  return true;
}

/// Replaces arcs by corners. `distance`: how far the ring was moved to the left.
OGRLinearRing sharpened(const OGRLinearRing& ring, double distance) {
  const int count = ring.getNumPoints() - 1;
  const auto place = [&](int k) { return Place{ring.getX(k % count), ring.getY(k % count)}; };
  int longest = 0;  // index of its start, outside any arc
  for (int k = 1; k < count; ++k) {
    if (length(way(place(k), place(k + 1))) > length(way(place(longest), place(longest + 1)))) longest = k;
  }
  std::vector<Corner> corners;
  for (int k = longest; k < longest + count + 2; ++k) {
    corners.push_back({place(k), place(k), place(k)});
    while (sharpen(corners, distance)) continue;
  }
  OGRLinearRing result;
  for (std::size_t k = 1; k + 1 < corners.size(); ++k) result.addPoint(corners[k].at[0], corners[k].at[1]);
  result.closeRings();
  return result;
}

/// The polygons moved inwards; null if GEOS fails.
OwnedGeometry move_inwards(const OGRGeometry& whole, double distance, double sample) {
  constexpr double kSteps = 256, kShare = 0.125;
  const bool is_pointed = std::abs(distance) < sample;
  OwnedGeometry moved(whole.Buffer(-distance, kSegmentsPerQuarter));
  if (!moved || sample <= 0) return moved;
  OGRMultiPolygon parts, pointed;
  collect_polygons(*moved, parts);
  for (int i = 0; i < parts.getNumGeometries() && is_pointed; ++i) {
    const OGRPolygon& round = *parts.getGeometryRef(i);
    OGRPolygon polygon;
    for (int k = -1; k < round.getNumInteriorRings(); ++k) {
      const OGRLinearRing& ring = k < 0 ? *round.getExteriorRing() : *round.getInteriorRing(k);
      const bool is_left = (k < 0) != (ring.isClockwise() != 0);
      OGRLinearRing sharp = sharpened(ring, is_left ? distance : -distance);
      polygon.addRing(&sharp);
    }
    // Corners may meet across a neck.
    pointed.addGeometry(polygon.IsValid() ? &polygon : &round);
  }
  const OGRGeometry& from = is_pointed ? pointed : static_cast<const OGRGeometry&>(*moved);
  return OwnedGeometry(from.SimplifyPreserveTopology(std::min(sample / kSteps, kShare * std::abs(distance))));
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
  const OwnedGeometry whole(are_valid ? polygons.UnionCascaded() : nullptr);
  const bool moves = whole && is_distance(distance, *whole);
  const OwnedGeometry moved = !whole  ? nullptr
                              : moves ? move_inwards(*whole, distance, sample)
                                      : OwnedGeometry(whole->clone());
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
