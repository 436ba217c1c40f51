#include "fit/patch.h"

#include <utility>

namespace scarp {

namespace {

constexpr unsigned next(unsigned k) { return k == 2 ? 0 : k + 1; }
constexpr unsigned previous(unsigned k) { return k == 0 ? 2 : k - 1; }
constexpr Patch::Link link_to(Patch::Id f, unsigned edge) { return f << 2 | edge; }

}  // namespace

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
  faces_[f].links[edge] = beyond;
  if (!is_border(beyond)) faces_[triangle_of(beyond)].links[edge_of(beyond)] = link_to(f, edge);
}

void Patch::remove(Id v, const Star& star, std::span<const RingTriangle> triangles) {
  open_.clear();
  const Link closing = star.closed ? star.beyond.back() : star.side;
  for (std::size_t i = 0; i < triangles.size(); ++i) {
    const auto& [first, middle, last, worst, energy] = triangles[i];
    const Id f = star.faces[i];
    Face& face = faces_[f];
    face.corners = {star.ring[first], star.ring[middle], star.ring[last]};
    face.worst = worst;
    face.energy = energy;
    for (const Id corner : face.corners) nodes_[corner].face = f;
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
  for (std::size_t i = triangles.size(); i < star.faces.size(); ++i) faces_[star.faces[i]].corners[0] = kNone;
  nodes_[v].face = kNone;
}

void Patch::pack() {
  std::vector<Id> ids(faces_.size(), kNone);
  Id count = 0;
  for (Id f = 0; f < faces_.size(); ++f) {
    if (faces_[f].corners[0] != kNone) ids[f] = count++;
  }
  std::vector<Face> packed(count);
  for (Id f = 0; f < faces_.size(); ++f) {
    if (ids[f] == kNone) continue;
    Face& face = packed[ids[f]] = faces_[f];
    for (Link& link : face.links) {
      if (!is_border(link)) link = link_to(ids[triangle_of(link)], edge_of(link));
    }
    for (const Id corner : face.corners) nodes_[corner].face = ids[f];
  }
  faces_ = std::move(packed);
}

}  // namespace scarp
