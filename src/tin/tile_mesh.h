// The workbench of one tile: a constrained Delaunay triangulation that grows by cavities instead of flips.
//
// A triangle has 32 bytes, two to a cache line, with all that insertion reads: corners as points, links, and a word for
// the caller (its candidate). There is no array of vertices: a vertex is its point. Each insertion finds the cavity of
// the point (the triangles whose circumcircle contains it, up to constrained edges), then writes every new triangle
// once. Lawson's flips write most of them several times. Both methods give the same triangulation, up to cocircular
// ties.
#pragma once

#include <array>
#include <cstdint>
#include <span>
#include <vector>

#include "base/array.h"
#include "geom/tile_view.h"
#include "tin/triangulation.h"

namespace scarp::tin {

class TileMesh {
 public:
  using Id = std::uint32_t;
  /// triangle << 3 | constrained << 2 | edge of that triangle; edge k runs from corner k to corner k + 1.
  using Link = std::uint32_t;
  static constexpr Link kBorder = 0xffffffffu;

  struct Record {
    std::array<geom::TilePoint, 3> corners;  // positive orientation
    std::array<Link, 3> links;               // links beyond edge k
    std::int64_t key;                        // for the caller, at least 0; kOutside: not part of the domain
  };
  static_assert(sizeof(Record) == 32);
  static constexpr std::int64_t kOutside = -1;

  static constexpr Id triangle_of(Link link) { return link >> 3; }
  static constexpr unsigned edge_of(Link link) { return link & 3; }
  static constexpr bool is_constrained(Link link) { return link != kBorder && (link & 4) != 0; }

  /// The rectangle as two triangles, diagonal as in Triangulation. Reuses the memory.
  void reset(std::int32_t cols, std::int32_t rows);
  /// Copies a triangulation of the same rectangle, with its constraints and outside triangles; keys are 0.
  void assign(const Triangulation& tin);

  std::size_t triangle_count() const { return records_.size(); }
  std::size_t vertex_count() const { return vertices_; }
  Record& operator[](Id t) { return records_[t]; }
  const Record& operator[](Id t) const { return records_[t]; }
  bool is_outside(Id t) const { return records_[t].key < 0; }

  /// The effect of inserting p: the removed triangles, and those beyond them. Valid until the next call. REQUIRES: p in
  /// the closed triangle t, but not a corner of it.
  struct Cavity {
    std::span<const Id> removed;  ///< begins with t
    struct Side {
      geom::TilePoint from, to;  ///< the cavity lies to the left
      Link beyond;
      bool outside;  ///< state of the removed triangle at this side
    };
    std::span<const Side> sides;  ///< counter-clockwise around p
  };
  Cavity find_cavity(Id t, geom::TilePoint p);

  /// Replaces the cavity of the last find_cavity(t, p) by a fan around p; returns the new triangles, with keys 0 or
  /// kOutside. Reuses removed ids. Constraints and outside marks are inherited.
  std::span<const Id> fill_cavity(geom::TilePoint p);

  /// Walks from `hint` to the triangle that holds p (closed).
  Id locate(geom::TilePoint p, Id hint) const;
  /// Inserts p anywhere; `hint` is any triangle. Returns one of the new triangles, or one at p if p is a vertex.
  Id insert(geom::TilePoint p, Id hint);

 private:
  void set_link(Link at, Link to) { records_[triangle_of(at)].links[edge_of(at)] = to; }

  Array<Record> records_;
  std::size_t vertices_ = 0;
  std::vector<Id> removed_, fresh_;
  std::vector<Cavity::Side> sides_;
  std::vector<Link> stack_;
  bool splits_constraint_ = false;  // p lies on a constrained edge, whose halves stay constrained
  geom::TilePoint split_from_ = 0, split_to_ = 0;
};

}  // namespace scarp::tin
