#include "refine/size_field.h"

#include <algorithm>
#include <cmath>
#include <limits>

namespace scarp {

double SizeField::length(Vertex v, Vertex w) const { return std::sqrt(metric_.square(tin_.point(v), tin_.point(w))); }

void SizeField::lower(Vertex v, double size) {
  if (!(size < sizes_[v])) return;
  sizes_[v] = size;
  if (waits_[v] != 0) return;
  waits_[v] = 1;
  queue_.push_back(v);
}

void SizeField::take_lengths(Triangle t) {
  if (tin_.is_outside(t)) return;
  for (HalfEdge h = 3 * t; h < 3 * t + 3; ++h) {
    const Vertex v = tin_.origin(h), w = tin_.origin(Triangulation::next(h));
    const double size = std::max(length(v, w), least_);
    lower(v, size);
    lower(w, size);
  }
}

// The least fixed point, whatever the order: first in, first out keeps detours few.
void SizeField::spread(const std::vector<HalfEdge>& out, std::vector<Vertex>* fallen) {
  for (std::size_t k = 0; k < queue_.size(); ++k) {
    const Vertex v = queue_[k];
    waits_[v] = 0;
    if (fallen != nullptr) fallen->push_back(v);
    visit_around(tin_, out[v], [&](HalfEdge h) {
      if (tin_.is_outside(h / 3)) return;
      for (const Vertex w : {tin_.origin(Triangulation::next(h)), tin_.origin(Triangulation::previous(h))})
        lower(w, sizes_[v] + grade_ * length(v, w));
    });
  }
  queue_.clear();
}

void SizeField::measure_all(const std::vector<HalfEdge>& out) {
  sizes_.assign(tin_.vertex_count(), std::numeric_limits<double>::infinity());
  waits_.assign(tin_.vertex_count(), 0);
  for (Triangle t = 0; t < tin_.triangle_count(); ++t) take_lengths(t);
  spread(out, nullptr);
}

void SizeField::update(const std::vector<Triangle>& changed, const std::vector<HalfEdge>& out,
                       std::vector<Vertex>& fallen) {
  sizes_.resize(tin_.vertex_count(), std::numeric_limits<double>::infinity());
  waits_.resize(tin_.vertex_count(), 0);
  for (const Triangle t : changed) take_lengths(t);
  // New edges are new ways: vertices that know of small sizes tell the others, whether theirs fell or not.
  for (const Triangle t : changed) {
    if (tin_.is_outside(t)) continue;
    for (HalfEdge h = 3 * t; h < 3 * t + 3; ++h) {
      const Vertex v = tin_.origin(h), w = tin_.origin(Triangulation::next(h));
      const double way = grade_ * length(v, w);
      lower(w, sizes_[v] + way);
      lower(v, sizes_[w] + way);
    }
  }
  spread(out, &fallen);
}

}  // namespace scarp
