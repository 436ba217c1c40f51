#include "fit/patch.h"

#include <algorithm>
#include <utility>

namespace scarp::fit {

namespace {

constexpr unsigned next(unsigned k) { return k == 2 ? 0 : k + 1; }
constexpr unsigned previous(unsigned k) { return k == 0 ? 2 : k - 1; }
constexpr Patch::Link link_to(Patch::Id f, unsigned edge) { return f << 2 | edge; }

}  // namespace

Patch::Star::Star() {
  constexpr std::size_t kUsual = 16;
  for (std::vector<Id>* ids : {&faces, &ring, &beyond}) ids->reserve(kUsual);
}

bool Patch::walk(Id f, unsigned corner, Star& star) const {
  star.faces.clear();
  star.ring.clear();
  star.beyond.clear();
  for (const Id begin = f;;) {
    const Face& face = faces_[f];
    star.faces.push_back(f);
    star.ring.push_back(face.corners[next(corner)]);
    star.beyond.push_back(face.links[next(corner)]);
    const Link after = face.links[previous(corner)];
    if (is_border(after)) {
      star.ring.push_back(face.corners[previous(corner)]);
      star.side = after;
      return false;
    }
    f = triangle_of(after);
    corner = edge_of(after);
    if (f == begin) return true;
  }
}

void Patch::find_star(Id v, Star& star) const {
  Id f = nodes_[v].face;
  const auto& corners = faces_[f].corners;
  unsigned k = corners[0] == v ? 0 : corners[1] == v ? 1 : 2;
  star.closed = walk(f, k, star);
  if (star.closed) return;
  Link before = faces_[f].links[k];
  for (; !is_border(before); before = faces_[f].links[k]) {
    f = triangle_of(before);
    k = next(edge_of(before));
  }
  walk(f, k, star);
  if (before == kConstrainedSide) star.side = before;
}

void Patch::attach(Id f, unsigned edge, Link beyond) {
  change(f).links[edge] = beyond;
  if (!is_border(beyond)) change(triangle_of(beyond)).links[edge_of(beyond)] = link_to(f, edge);
}

void Patch::remove(Id v, const Star& star, std::span<const RingTriangle> triangles) {
  open_.clear();
  const Link closing = star.closed ? star.beyond.back() : star.side;
  for (std::size_t i = 0; i < triangles.size(); ++i) {
    const auto& [first, middle, last, worst, energy] = triangles[i];
    const Id f = star.faces[i];
    Face& face = change(f);
    face.corners = {star.ring[first], star.ring[middle], star.ring[last]};
    face.worst = worst;
    face.energy = energy;
    for (const Id corner : face.corners) name_face(corner, f);
    Link back = closing;
    if (i > 0) {
      back = open_.back();
      open_.pop_back();
    }
    attach(f, 2, back);
    if (last == middle + 1) {
      attach(f, 1, star.beyond[middle]);
    } else {
      open_.push_back(link_to(f, 1));
    }
    if (middle == first + 1) {
      attach(f, 0, star.beyond[first]);
    } else {
      open_.push_back(link_to(f, 0));
    }
  }
  for (std::size_t i = triangles.size(); i < star.faces.size(); ++i) change(star.faces[i]).corners[0] = tin::kNone;
  name_face(v, tin::kNone);
}

Patch::Id Patch::insert(const FitCorner& at, Id f) {
  const Face face = faces_[f];
  const std::array<Rim, 3> rim{
      {{face.corners[0], face.links[0]}, {face.corners[1], face.links[1]}, {face.corners[2], face.links[2]}}};
  return fan(at, rim, {f}, 1);
}

Patch::Id Patch::insert(const FitCorner& at, Id f, unsigned edge) {
  const Face near = faces_[f];
  const Id beyond = triangle_of(near.links[edge]);
  const unsigned back = edge_of(near.links[edge]);
  const Face far = faces_[beyond];
  const unsigned bc = next(edge), ca = previous(edge), ad = next(back), db = previous(back);
  const std::array<Rim, 4> rim{{{near.corners[bc], near.links[bc]},
                                {near.corners[ca], near.links[ca]},
                                {far.corners[ad], far.links[ad]},
                                {far.corners[db], far.links[db]}}};
  return fan(at, rim, {f, beyond}, 2);
}

/// Adds a vertex with a triangle for each edge of a rim; reuses the given faces first.
Patch::Id Patch::fan(const FitCorner& at, std::span<const Rim> rim, std::array<Id, 4> faces, std::size_t reused) {
  const auto v = static_cast<Id>(nodes_.size());
  nodes_.push_back({at, faces[0]});
  locked_.push_back(0);
  for (std::size_t i = reused; i < rim.size(); ++i) {
    faces[i] = static_cast<Id>(faces_.size());
    faces_.push_back({});
  }
  for (std::size_t i = 0; i < rim.size(); ++i) {
    const std::size_t after = i + 1 == rim.size() ? 0 : i + 1;
    Face& face = faces_[faces[i]];
    face.corners = {v, rim[i].from, rim[after].from};
    face.worst = face.energy = -1;
    nodes_[rim[i].from].face = faces[i];
  }
  for (std::size_t i = 0; i < rim.size(); ++i) {
    attach(faces[i], 1, rim[i].beyond);
    attach(faces[i], 2, link_to(faces[i + 1 == rim.size() ? 0 : i + 1], 0));
  }
  return v;
}

Patch::Quad Patch::quad(Id f, unsigned edge) const {
  const Face& face = faces_[f];
  const Link link = face.links[edge];
  const Id beyond = triangle_of(link);
  return {f,
          beyond,
          face.corners[edge],
          face.corners[next(edge)],
          face.corners[previous(edge)],
          faces_[beyond].corners[previous(edge_of(link))]};
}

void Patch::flip(const Quad& q) {
  Face& near = change(q.face);
  Face& far = change(q.beyond);
  const auto edge_from = [](const Face& face, Id corner) {
    return face.corners[0] == corner ? 0u : face.corners[1] == corner ? 1u : 2u;
  };
  const Link bc = near.links[edge_from(near, q.b)], ca = near.links[edge_from(near, q.c)];
  const Link ad = far.links[edge_from(far, q.a)], db = far.links[edge_from(far, q.d)];
  near.corners = {q.c, q.a, q.d};
  far.corners = {q.d, q.b, q.c};
  attach(q.face, 0, ca);
  attach(q.face, 1, ad);
  attach(q.face, 2, link_to(q.beyond, 2));
  attach(q.beyond, 0, db);
  attach(q.beyond, 1, bc);
  for (const Id corner : near.corners) name_face(corner, q.face);
  name_face(q.b, q.beyond);
}

void Patch::begin() {
  face_journal_.begin(faces_.size());
  node_journal_.begin(nodes_.size());
}

void Patch::commit() {
  face_journal_.commit();
  node_journal_.commit();
}

void Patch::roll_back() {
  face_journal_.roll_back(faces_);
  node_journal_.roll_back(nodes_);
}

std::size_t Patch::count_faces() const {
  return static_cast<std::size_t>(
      std::count_if(faces_.begin(), faces_.end(), [](const Face& face) { return face.corners[0] != tin::kNone; }));
}

void Patch::pack() {
  std::vector<Id> ids(faces_.size(), tin::kNone);
  Id count = 0;
  for (Id f = 0; f < faces_.size(); ++f) {
    if (faces_[f].corners[0] != tin::kNone) ids[f] = count++;
  }
  std::vector<Face> packed(count);
  for (Id f = 0; f < faces_.size(); ++f) {
    if (ids[f] == tin::kNone) continue;
    Face& face = packed[ids[f]] = faces_[f];
    for (Link& link : face.links) {
      if (!is_border(link)) link = link_to(ids[triangle_of(link)], edge_of(link));
    }
    for (const Id corner : face.corners) nodes_[corner].face = ids[f];
  }
  faces_ = std::move(packed);
}

}  // namespace scarp::fit
