#include "shape/size_field.h"

#include <algorithm>
#include <cmath>
#include <limits>

namespace scarp::shape {

double SizeField::length(tin::Vertex v, tin::Vertex w) const {
  return std::sqrt(metric_.square(tin_.point(v), tin_.point(w)));
}

void SizeField::lower(tin::Vertex v, double size) {
  if (!(size < sizes_[v])) return;
  sizes_[v] = size;
  if ((states_[v] & kWaits) != 0) return;
  states_[v] |= kWaits;
  queue_.push_back(v);
}

void SizeField::take_lengths(tin::Triangle t) {
  if (tin_.is_outside(t)) return;
  for (tin::HalfEdge h = 3 * t; h < 3 * t + 3; ++h) {
    const tin::Vertex v = tin_.origin(h), w = tin_.origin(tin::Triangulation::next(h));
    const double size = std::max(length(v, w), least_);
    lower(v, size);
    lower(w, size);
  }
}

// Computes the least fixed point, which is independent of the order; a first-in, first-out queue needs few repetitions.
void SizeField::spread(const std::vector<tin::HalfEdge>& out, std::vector<tin::Vertex>* fallen) {
  while (!queue_.empty()) {
    wave_.swap(queue_);
    for (const tin::Vertex v : wave_) {
      if (fallen != nullptr && (states_[v] & kFell) == 0) fallen->push_back(v);
      states_[v] = kFell;
      visit_around(tin_, out[v], [&](tin::HalfEdge h) {
        if (tin_.is_outside(h / 3)) return;
        for (const tin::Vertex w :
             {tin_.origin(tin::Triangulation::next(h)), tin_.origin(tin::Triangulation::previous(h))})
          lower(w, sizes_[v] + grade_ * length(v, w));
      });
    }
    wave_.clear();
  }
}

void SizeField::measure_all(const std::vector<tin::HalfEdge>& out) {
  sizes_.assign(tin_.vertex_count(), std::numeric_limits<double>::infinity());
  states_.assign(tin_.vertex_count(), 0);
  for (tin::Triangle t = 0; t < tin_.triangle_count(); ++t) take_lengths(t);
  spread(out, nullptr);
  std::fill(states_.begin(), states_.end(), std::uint8_t{0});
}

void SizeField::update(const std::vector<tin::Triangle>& changed, const std::vector<tin::HalfEdge>& out,
                       std::vector<tin::Vertex>& fallen) {
  sizes_.resize(tin_.vertex_count(), std::numeric_limits<double>::infinity());
  states_.resize(tin_.vertex_count(), 0);
  const std::size_t before = fallen.size();
  for (const tin::Triangle t : changed) take_lengths(t);
  // New edges are new paths, along which vertices pass on small sizes even if their own sizes did not fall.
  for (const tin::Triangle t : changed) {
    if (tin_.is_outside(t)) continue;
    for (tin::HalfEdge h = 3 * t; h < 3 * t + 3; ++h) {
      const tin::Vertex v = tin_.origin(h), w = tin_.origin(tin::Triangulation::next(h));
      const double way = grade_ * length(v, w);
      lower(w, sizes_[v] + way);
      lower(v, sizes_[w] + way);
    }
  }
  spread(out, &fallen);
  for (std::size_t k = before; k < fallen.size(); ++k) states_[fallen[k]] = 0;
}

}  // namespace scarp::shape
