// The surface whose triangles are refined: it handles samples, heights and the error, while refine_shapes() handles the
// plan.
#pragma once

#include <cstddef>
#include <cstdint>
#include <vector>

#include "base/point.h"
#include "tin/triangulation.h"

namespace scarp::shape {

class ShapeBench {
 public:
  virtual ~ShapeBench() = default;

  /// True if no sample breaks its bound.
  virtual bool done() const = 0;
  virtual bool is_full() const = 0;
  virtual double worst_error() const = 0;
  /// REQUIRES: !done().
  virtual void insert_worst() = 0;
  /// Inserts a vertex in a triangle or on a free edge. False where the surface has no height.
  virtual bool insert(Point p, const tin::Triangulation::Location& location) = 0;
  /// Inserts a vertex on an edge or next to it, with the height at this share of the way along the edge.
  virtual void insert_on_edge(Point p, tin::HalfEdge h, double share) = 0;
  /// The triangles around the vertex that was inserted last; no others changed.
  virtual const std::vector<tin::Triangle>& changed() const = 0;
  virtual std::uint64_t samples_scanned() const = 0;
  virtual std::uint64_t triangles_scanned() const = 0;

  /// For streamed samples. is_streamed(): true if they are read in bands; hold(): reads the samples around a band;
  /// scan(): finds a triangle's samples there that break their bound.
  virtual bool is_streamed() const { return false; }
  virtual void hold(std::size_t /*band*/) {}
  virtual void scan(tin::Triangle /*t*/) {}
};

}  // namespace scarp::shape
