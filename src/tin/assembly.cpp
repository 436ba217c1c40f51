#include "tin/assembly.h"

#include <algorithm>
#include <cassert>
#include <utility>

#include "base/sort.h"

namespace scarp::tin {

namespace {

/// The arrays to append: points and half-edges, counted from 0.
struct PieceView {
  const TilePiece& piece;
  Point first;
  std::int32_t cols, rows;

  std::size_t point_count() const { return piece.points.size(); }
  Point point(std::uint32_t i) const { return geom::point_of(piece.points[i]); }
  std::size_t triangle_count() const { return piece.outside.size(); }
  std::uint32_t corner(HalfEdge h) const { return piece.corners[h]; }
  HalfEdge twin(HalfEdge h) const {
    const TileMesh::Link link = piece.links[h];
    return link == TileMesh::kBorder ? kNone : 3 * TileMesh::triangle_of(link) + TileMesh::edge_of(link);
  }
  bool is_constrained(HalfEdge h) const { return TileMesh::is_constrained(piece.links[h]); }
  bool is_outside(Triangle t) const { return piece.outside[t] != 0; }
};

struct TinView {
  const Triangulation& tin;
  Point first;
  std::int32_t cols, rows;

  std::size_t point_count() const { return tin.vertex_count(); }
  Point point(Vertex v) const { return tin.point(v); }
  std::size_t triangle_count() const { return tin.triangle_count(); }
  Vertex corner(HalfEdge h) const { return tin.origin(h); }
  HalfEdge twin(HalfEdge h) const { return tin.twin(h); }
  bool is_constrained(HalfEdge h) const { return tin.is_constrained(h); }
  bool is_outside(Triangle t) const { return tin.is_outside(t); }
};

}  // namespace

/// Frees all slots. At least half remain free with `vertices` vertices.
void PieceMaker::clear(std::size_t vertices) {
  unsigned bits = 4;
  while ((std::size_t{1} << bits) < 2 * vertices) ++bits;
  shift_ = 32 - bits;
  slots_.resize(std::size_t{1} << bits);
  std::fill(slots_.begin(), slots_.end(), Slot{0, kNone});
}

/// The slot of p, or the free slot for it.
PieceMaker::Slot& PieceMaker::find(geom::TilePoint p) {
  constexpr std::uint32_t kGolden = 2654435769;  // 2^32 / golden ratio: spreads neighbours
  std::size_t i = (p * kGolden) >> shift_;
  while (slots_[i].id != kNone && slots_[i].at != p) i = (i + 1) & (slots_.size() - 1);
  return slots_[i];
}

TilePiece PieceMaker::make(const TileMesh& mesh, Point first, std::int32_t cols, std::int32_t rows) {
  TilePiece piece{first, cols, rows, {}, {}, {}, {}};
  clear(mesh.vertex_count());
  const std::size_t count = mesh.triangle_count();
  piece.corners.resize(3 * count);
  piece.links.resize(3 * count);
  piece.outside.resize(count);
  for (TileMesh::Id t = 0; t < count; ++t) {
    const TileMesh::Record& record = mesh[t];
    for (std::size_t k = 0; k < 3; ++k) {
      Slot& slot = find(record.corners[k]);
      if (slot.id == kNone) {
        slot = {record.corners[k], static_cast<std::uint32_t>(piece.points.size())};
        piece.points.push_back(record.corners[k]);
      }
      piece.corners[3 * t + k] = slot.id;
      piece.links[3 * t + k] = record.links[k];
    }
    piece.outside[t] = record.key < 0;
  }
  return piece;
}

Vertex Assembly::Border::find(std::int32_t at) const {
  const auto found = std::lower_bound(vertices.begin(), vertices.end(), at,
                                      [](const auto& entry, std::int32_t value) { return entry.first < value; });
  assert(found != vertices.end() && found->first == at);
  return found->second;
}

void Assembly::Border::sort() {
  sort_rarely(vertices);
  sort_rarely(edges, [](const BorderEdge& a, const BorderEdge& b) { return a.at < b.at; });
}

template <class Part>
void Assembly::add_vertices(const Part& part) {
  const bool has_left = column_ > 0, has_top = !is_first_row_, is_alone = below_.empty();
  ids_.clear();
  ids_.reserve(part.point_count());
  for (std::uint32_t i = 0; i < part.point_count(); ++i) {
    const auto [x, y] = part.point(i);
    Vertex v = kNone;
    if (x == 0 && has_left) v = beside_.find(y);
    if (y == 0 && has_top) v = below_[column_].find(x);
    if (v == kNone) {
      v = static_cast<Vertex>(tin_.points_.size());
      tin_.points_.push_back({part.first.x + x, part.first.y + y});
    }
    ids_.push_back(v);
    if (is_alone) continue;
    if (x == part.cols - 1) right_.vertices.push_back({y, v});
    if (y == part.rows - 1) bottom_.vertices.push_back({x, v});
  }
}

template <class Part>
void Assembly::add_triangles(const Part& part) {
  const auto base = static_cast<HalfEdge>(tin_.corners_.size());
  const auto count = static_cast<HalfEdge>(3 * part.triangle_count());
  const bool is_alone = below_.empty();
  tin_.corners_.resize(base + count);
  tin_.twins_.resize(base + count);
  for (HalfEdge h = 0; h < count; ++h) {
    const HalfEdge here = base + h, twin = part.twin(h);
    tin_.corners_[here] = ids_[part.corner(h)];
    tin_.twins_[here] = twin == kNone ? kNone : base + twin;
    if (twin != kNone || is_alone) continue;
    const auto [x, y] = part.point(part.corner(h));
    const auto [x2, y2] = part.point(part.corner(Triangulation::next(h)));
    if (x == 0 && x2 == 0) left_.edges.push_back({std::min(y, y2), here});
    if (x == part.cols - 1 && x2 == x) right_.edges.push_back({std::min(y, y2), here});
    if (y == 0 && y2 == 0) top_.edges.push_back({std::min(x, x2), here});
    if (y == part.rows - 1 && y2 == y) bottom_.edges.push_back({std::min(x, x2), here});
  }
  for (Triangle t = 0; t < part.triangle_count(); ++t) {
    std::uint8_t flags = part.is_outside(t) ? Triangulation::kOutside : 0;
    is_whole_ = is_whole_ && flags == 0;
    for (unsigned k = 0; k < 3; ++k) {
      if (part.is_constrained(3 * t + k)) flags |= static_cast<std::uint8_t>(1u << k);
    }
    tin_.flags_.push_back(flags);
  }
}

void Assembly::sew(const Border& theirs, Border& ours) {
  ours.sort();
  assert(theirs.edges.size() == ours.edges.size());
  for (std::size_t i = 0; i < ours.edges.size(); ++i) {
    assert(theirs.edges[i].at == ours.edges[i].at);
    const HalfEdge h = ours.edges[i].edge, g = theirs.edges[i].edge;
    tin_.link(h, g);
    const bool here = tin_.is_outside(h / 3), there = tin_.is_outside(g / 3);
    if (here != there) tin_.set_constrained(h);
    if (!here && !there) seams_.push_back(h);
  }
}

template <class Part>
void Assembly::append_part(const Part& part) {
  for (Border* border : {&left_, &top_, &right_, &bottom_}) *border = {};
  add_vertices(part);
  add_triangles(part);
  if (below_.empty()) return;
  if (column_ > 0) sew(beside_, left_);
  if (!is_first_row_) sew(below_[column_], top_);
  right_.sort();
  bottom_.sort();
  beside_ = std::move(right_);
  below_[column_] = std::move(bottom_);
  if (++column_ == below_.size()) {
    column_ = 0;
    is_first_row_ = false;
  }
}

void Assembly::append(const TilePiece& piece) { append_part(PieceView{piece, piece.first, piece.cols, piece.rows}); }

void Assembly::append(const Triangulation& tin, Point first, std::int32_t cols, std::int32_t rows) {
  append_part(TinView{tin, first, cols, rows});
}

Triangulation Assembly::finish(std::vector<HalfEdge>& seams) {
  seams = std::move(seams_);
  return std::move(tin_);
}

}  // namespace scarp::tin
