// The workbench of fitting: a piece of a triangulation that is changed in place, one star at a time.
//
// A patch contains only triangles of the domain. Its border consists of the edges that must not change: edges to other
// patches or to the outside, and constrained edges, which are borders on both sides. Their ends are locked. The
// rectangle's sides are borders too, but only its corners are locked: a vertex on a side may be removed, since the side
// stays the same.
//
//     beyond[2]  r3 ──── r2  beyond[1]      the star of v: triangles (v, r_i, r_i+1) in positive order; closed, or from
//               /  \   /  \                 side to side
//              r4 ── v ── r1                its ring: r_0 … r_k-1, a polygon that lies to the left of its edges
//               \  /   \  /
//                r5 ──── r0  beyond[0]
#pragma once

#include <array>
#include <cstdint>
#include <span>
#include <vector>

#include "fit/journal.h"
#include "fit/triangle_error.h"
#include "tin/triangulation.h"

namespace scarp::fit {

class Patch {
 public:
  using Id = std::uint32_t;
  /// triangle << 2 | edge of that triangle, where edge k joins corners k and k + 1; or a border.
  using Link = std::uint32_t;
  static constexpr Link kBorder = 0x80000000u;  ///< kBorder | index into fixed(), or one of the next two:
  static constexpr Link kSide = 0xffffffffu;    ///< the rectangle's side
  static constexpr Link kConstrainedSide = 0xfffffffeu;
  static constexpr bool is_border(Link link) { return (link & kBorder) != 0; }
  static constexpr bool is_side(Link link) { return link >= kConstrainedSide; }
  static constexpr Id triangle_of(Link link) { return link >> 2; }
  static constexpr unsigned edge_of(Link link) { return link & 3; }

  /// Half a cache line.
  struct Face {
    std::array<Id, 3> corners;  ///< positive; corners[0] is kNone if the triangle was removed
    std::array<Link, 3> links;
    float worst, energy;  ///< values in TriangleError::Verdict; negative: unknown
  };
  static_assert(sizeof(Face) == 32);

  struct Node {
    FitCorner at;
    Id face = tin::kNone;  ///< one of its triangles; kNone if the vertex was removed
  };

  /// Triangles around a vertex, and links beyond them.
  struct Star {
    Star();

    bool closed = true;
    std::vector<Id> faces;     ///< face i is (v, ring i, ring i + 1)
    std::vector<Id> ring;      ///< one more than faces in an open star
    std::vector<Link> beyond;  ///< links beyond the edge from ring i to ring i + 1
    Link side = kSide;         ///< open: link of the edge that will close the ring
  };

  /// One triangle of a triangulated ring, by indices into the ring, first < middle < last. A list of them is in order
  /// if each triangle is followed by those beyond its edge first → middle, then by those beyond middle → last.
  struct RingTriangle {
    std::uint8_t first, middle, last;
    float worst, energy;
  };

  std::size_t face_count() const { return faces_.size(); }  ///< including removed ones until pack()
  std::size_t node_count() const { return nodes_.size(); }
  const Face& face(Id f) const { return faces_[f]; }
  const FitCorner& at(Id v) const { return nodes_[v].at; }
  bool is_removed(Id v) const { return nodes_[v].face == tin::kNone; }
  bool is_locked(Id v) const { return locked_[v] != 0; }
  /// The half-edges of the triangulation that became borders, by index.
  const std::vector<tin::HalfEdge>& fixed() const { return fixed_; }
  /// The samples that the triangles may read.
  struct Window {
    Point first;  ///< origin from which lattice points are counted
    std::int32_t cols = 0, rows = 0;
  };
  const Window& window() const { return window_; }

  void set_measure(Id f, float worst, float energy) {
    face_journal_.touch(faces_, f);
    faces_[f].worst = worst;
    faces_[f].energy = energy;
  }

  /// Around a locked vertex, the star is only the part from border to border that contains one of its triangles.
  /// REQUIRES: v is not removed. Cost: O(its degree).
  void find_star(Id v, Star& star) const;

  /// Removes v and replaces its star by the triangles. REQUIRES: they triangulate the star's ring, are positive and in
  /// order.
  void remove(Id v, const Star& star, std::span<const RingTriangle> triangles);

  /// Inserts a vertex within the face, or on its edge if one is given. Three triangles around the vertex replace the
  /// face; on an edge, four replace its two faces. The errors of these triangles are unknown. Returns the vertex.
  /// REQUIRES: the triangles are positive; the edge is no border; no transaction is open.
  Id insert(const FitCorner& at, Id f);
  Id insert(const FitCorner& at, Id f, unsigned edge);

  /// The triangles (c, a, d) and (d, b, c) that would replace (a, b, c) and, beyond its edge a b, (b, a, d).
  struct Quad {
    Id face = tin::kNone, beyond = tin::kNone;
    Id a = tin::kNone, b = tin::kNone, c = tin::kNone, d = tin::kNone;
  };
  /// REQUIRES: the edge is no border.
  Quad quad(Id f, unsigned edge) const;

  /// Changes the diagonal: (c, a, d) replaces q.face, and (d, b, c) replaces q.beyond. REQUIRES: both are positive.
  void flip(const Quad& q);

  /// REQUIRES: the triangles around v stay positive; a vertex on a side stays on it.
  void move(Id v, const FitCorner& to) {
    node_journal_.touch(nodes_, v);
    nodes_[v].at = to;
  }

  /// Begins a transaction: roll_back() undoes later changes.
  void begin();
  void commit();
  void roll_back();
  /// The triangles touched since begin(), in their earlier state.
  std::span<const Journal<Face>::Copy> touched() const { return face_journal_.copies(); }

  std::size_t count_faces() const;  ///< without removed ones

  /// Renumbers the faces without gaps, and frees the memory of removed ones.
  void pack();

 private:
  friend class PatchCutter;

  /// One corner of a rim; corners are counter-clockwise.
  struct Rim {
    Id from;
    Link beyond;  // link of the edge to the next
  };
  /// Fills the star from triangle f on; false if it ends at a border.
  bool walk(Id f, unsigned corner, Star& star) const;
  Id fan(const FitCorner& at, std::span<const Rim> rim, std::array<Id, 4> faces, std::size_t reused);
  void attach(Id f, unsigned edge, Link beyond);
  Face& change(Id f) {
    face_journal_.touch(faces_, f);
    return faces_[f];
  }
  void name_face(Id v, Id f) {
    node_journal_.touch(nodes_, v);
    nodes_[v].face = f;
  }

  Window window_;
  std::vector<Face> faces_;
  std::vector<Node> nodes_;
  std::vector<std::uint8_t> locked_;
  std::vector<tin::HalfEdge> fixed_;
  Journal<Face> face_journal_;
  Journal<Node> node_journal_;
  std::vector<Link> open_;  // edges that await their triangles
};

}  // namespace scarp::fit
