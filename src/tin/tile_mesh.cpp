#include "tin/tile_mesh.h"

#include <algorithm>
#include <cassert>

#include "geom/predicates.h"

namespace scarp::tin {

namespace {

constexpr unsigned kNext[3] = {1, 2, 0}, kPrevious[3] = {2, 0, 1};

/// orient() for points of a tile: 32 bits suffice (2 · 4096²).
std::int32_t orient(geom::TilePoint a, geom::TilePoint b, geom::TilePoint c) {
  const std::int32_t ax = geom::tile_x(a), ay = geom::tile_y(a);
  return (geom::tile_x(b) - ax) * (geom::tile_y(c) - ay) - (geom::tile_y(b) - ay) * (geom::tile_x(c) - ax);
}

/// True if p is strictly inside the circumcircle of a positive triangle. Exact in double: with differences below 2^12
/// every term is an integer below 2^53.
bool is_in_circle(const std::array<geom::TilePoint, 3>& corners, double x, double y) {
  const double ax = geom::tile_x(corners[0]) - x, ay = geom::tile_y(corners[0]) - y;
  const double bx = geom::tile_x(corners[1]) - x, by = geom::tile_y(corners[1]) - y;
  const double cx = geom::tile_x(corners[2]) - x, cy = geom::tile_y(corners[2]) - y;
  const double a2 = ax * ax + ay * ay, b2 = bx * bx + by * by, c2 = cx * cx + cy * cy;
  return ax * (by * c2 - b2 * cy) - ay * (bx * c2 - b2 * cx) + a2 * (bx * cy - by * cx) > 0;
}

}  // namespace

void TileMesh::reset(std::int32_t cols, std::int32_t rows) {
  assert(cols >= 2 && rows >= 2 && cols <= geom::kMaxTileSide && rows <= geom::kMaxTileSide);
  const geom::TilePoint a = geom::tile_point(0, 0), b = geom::tile_point(cols - 1, 0),
                        c = geom::tile_point(cols - 1, rows - 1), d = geom::tile_point(0, rows - 1);
  records_.resize(2);
  records_[0] = {{a, b, d}, {kBorder, 1 << 3 | 2, kBorder}, 0};
  records_[1] = {{b, c, d}, {kBorder, kBorder, 0 << 3 | 1}, 0};
  vertices_ = 4;
}

void TileMesh::assign(const Triangulation& tin) {
  records_.resize(tin.triangle_count());
  for (Triangle t = 0; t < tin.triangle_count(); ++t) {
    Record& record = records_[t];
    for (unsigned k = 0; k < 3; ++k) {
      const HalfEdge h = 3 * t + k, twin = tin.twin(h);
      const Point p = tin.point(tin.origin(h));
      record.corners[k] = geom::tile_point(p.x, p.y);
      record.links[k] = twin == kNone ? kBorder : (twin / 3) << 3 | (tin.is_constrained(h) ? 4u : 0u) | twin % 3;
    }
    record.key = tin.is_outside(t) ? kOutside : 0;
  }
  vertices_ = tin.vertex_count();
}

TileMesh::Cavity TileMesh::find_cavity(Id t, geom::TilePoint p) {
  removed_.clear();
  sides_.clear();
  stack_.clear();
  removed_.push_back(t);
  splits_constraint_ = false;
  Link split = kBorder;  // the edge of t that contains p, from the other side
  for (unsigned k = 0; k < 3; ++k) {
    const Record& record = records_[t];
    const Link beyond = record.links[k];
    if (is_constrained(beyond) && orient(record.corners[k], record.corners[kNext[k]], p) == 0) {
      split = beyond;
      splits_constraint_ = true;
      split_from_ = record.corners[k];
      split_to_ = record.corners[kNext[k]];
    }
  }
  const double x = geom::tile_x(p), y = geom::tile_y(p);
  // Depth first, with the next side counter-clockwise on top of the stack, so that sides are found in order.
  for (unsigned k = 3; k-- > 0;) stack_.push_back(t << 3 | k);
  while (!stack_.empty()) {
    const Link at = stack_.back();
    stack_.pop_back();
    const Record& record = records_[triangle_of(at)];
    const unsigned k = edge_of(at);
    const Link beyond = record.links[k];
    const bool absorbs =
        beyond != kBorder &&
        (beyond == split || (!is_constrained(beyond) && is_in_circle(records_[triangle_of(beyond)].corners, x, y)));
    if (absorbs) {
      const Id other = triangle_of(beyond);
      const unsigned e = edge_of(beyond);
      removed_.push_back(other);
      stack_.push_back(other << 3 | kPrevious[e]);
      stack_.push_back(other << 3 | kNext[e]);
    } else {
      sides_.push_back({record.corners[k], record.corners[kNext[k]], beyond, record.key < 0});
    }
  }
  return {removed_, sides_};
}

std::span<const TileMesh::Id> TileMesh::fill_cavity(geom::TilePoint p) {
  // If p is on the border, that side opens the fan: its ends are the first and the last spoke.
  const auto border = std::find_if(sides_.begin(), sides_.end(), [p](const Cavity::Side& side) {
    return side.beyond == kBorder && orient(side.from, side.to, p) == 0;
  });
  const bool is_open = border != sides_.end();
  if (is_open) {
    std::rotate(sides_.begin(), border + 1, sides_.end());
    sides_.pop_back();
  }
  const std::size_t count = sides_.size();
  fresh_.assign(removed_.begin(), removed_.begin() + static_cast<std::ptrdiff_t>(std::min(count, removed_.size())));
  while (fresh_.size() < count) {
    fresh_.push_back(static_cast<Id>(records_.size()));
    records_.resize(records_.size() + 1);
  }
  const auto spoke_flag = [this](geom::TilePoint q) {
    return splits_constraint_ && (q == split_from_ || q == split_to_) ? 4u : 0u;
  };
  for (std::size_t i = 0; i < count; ++i) {
    const Cavity::Side& side = sides_[i];
    const Id t = fresh_[i];
    const Link before = i > 0 ? fresh_[i - 1] << 3 | 2u : is_open ? kBorder : fresh_[count - 1] << 3 | 2u;
    const Link after = i + 1 < count ? fresh_[i + 1] << 3 : is_open ? kBorder : fresh_[0] << 3;
    records_[t] = {{p, side.from, side.to},
                   {before == kBorder ? kBorder : before | spoke_flag(side.from), side.beyond,
                    after == kBorder ? kBorder : after | spoke_flag(side.to)},
                   side.outside ? kOutside : 0};
    if (side.beyond != kBorder) set_link(side.beyond, t << 3 | (side.beyond & 4) | 1u);
  }
  ++vertices_;
  return fresh_;
}

TileMesh::Id TileMesh::locate(geom::TilePoint p, Id hint) const {
  // The edge that is tested first varies, since with constraints, a fixed order could cycle.
  std::uint32_t sequence = 12345;
  Link entered = kBorder;
  for (Id t = hint;;) {
    sequence = sequence * 1664525u + 1013904223u;
    const Record& record = records_[t];
    Link crossed = kBorder;
    for (unsigned i = 0, k = (sequence >> 16) % 3; i < 3 && crossed == kBorder; ++i, k = kNext[k]) {
      const bool came_from = entered != kBorder && edge_of(entered) == k;
      if (!came_from && orient(record.corners[k], record.corners[kNext[k]], p) < 0) crossed = record.links[k];
    }
    if (crossed == kBorder) return t;
    entered = crossed;
    t = triangle_of(crossed);
  }
}

TileMesh::Id TileMesh::insert(geom::TilePoint p, Id hint) {
  const Id t = locate(p, hint);
  const auto& corners = records_[t].corners;
  if (std::find(corners.begin(), corners.end(), p) != corners.end()) return t;
  find_cavity(t, p);
  return fill_cavity(p).front();
}

}  // namespace scarp::tin
