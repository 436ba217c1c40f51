#include "refine/refinement.h"

#include <cmath>

#include "geom/exact_error.h"
#include "geom/plane.h"
#include "geom/scan.h"

namespace scarp {

namespace {

std::array<float, 3> heights_at(const Raster& raster, const std::array<Point, 3>& corners) {
  return {raster.at(corners[0]), raster.at(corners[1]), raster.at(corners[2])};
}

/// Largest error by the plane's own arithmetic. NaN samples lose every comparison.
Candidate scan_worst(const Raster& raster, const std::array<Point, 3>& corners, const Plane& plane) {
  Candidate worst{-1, {}};
  scan_rows(corners, [&](std::int32_t y, std::int32_t first, std::int32_t last) {
    const float* samples = raster.row(y);
    const double row_height = plane.row_height(y);
    for (std::int32_t x = first; x <= last; ++x) {
      const double error =
          std::abs(row_height + plane.slope_x * static_cast<double>(x - plane.base.x) - double{samples[x]});
      if (error > worst.error) worst = {error, {x, y}};
    }
  });
  return worst;
}

/// The same among the samples that exceed the threshold as real numbers.
std::optional<Candidate> scan_worst_exactly(const Raster& raster, const std::array<Point, 3>& corners,
                                            const Plane& plane, double threshold) {
  const auto heights = heights_at(raster, corners);
  std::optional<Candidate> worst;
  scan_rows(corners, [&](std::int32_t y, std::int32_t first, std::int32_t last) {
    for (std::int32_t x = first; x <= last; ++x) {
      const Point p{x, y};
      const float sample = raster.at(p);
      const double error = std::abs(plane.height_at(p) - double{sample});
      if (!(error >= threshold - plane.guard) || (worst && error <= worst->error)) continue;
      if (exceeds_exactly(corners, heights, p, sample, threshold)) worst = Candidate{error, p};
    }
  });
  return worst;
}

}  // namespace

std::optional<Candidate> find_candidate(const Raster& raster, const std::array<Point, 3>& corners, double threshold) {
  const Plane plane = Plane::through(corners, heights_at(raster, corners));
  const Candidate worst = scan_worst(raster, corners, plane);
  if (worst.error > threshold + plane.guard) return worst;
  if (worst.error < threshold - plane.guard) return std::nullopt;
  // A level plane has no guard: one subtraction rounds, monotonely, so that only equality is in doubt.
  if (plane.guard == 0 && (threshold == 0 || worst.error != threshold)) return std::nullopt;
  return scan_worst_exactly(raster, corners, plane, threshold);
}

Refinement::Refinement(const Raster& raster, Triangulation& tin, double threshold)
    : raster_(raster), tin_(tin), threshold_(threshold) {
  queue_.grow(tin.triangle_count());
  for (Triangle t = 0; t < tin.triangle_count(); ++t) {
    if (tin.is_outside(t)) continue;
    ++inside_;
    rescan(t);
  }
}

void Refinement::rescan(Triangle t) {
  if (const auto candidate = find_candidate(raster_, tin_.corners(t), threshold_)) {
    queue_.set(t, *candidate);
  } else {
    queue_.remove(t);
  }
}

std::uint32_t Refinement::gain(const Triangulation::Location& location) const {
  const auto counts = [this](HalfEdge h) { return h != kNone && !tin_.is_outside(h / 3) ? 1u : 0u; };
  switch (location.kind) {
    case Triangulation::Location::Kind::kInside:
      return 2 * counts(location.edge);
    case Triangulation::Location::Kind::kOnEdge:
      return counts(location.edge) + counts(tin_.twin(location.edge));
    case Triangulation::Location::Kind::kOnVertex:
      break;
  }
  return 0;
}

std::uint32_t Refinement::next_gain() const {
  const Triangle t = queue_.worst();
  return gain(tin_.locate_in(queue_.candidate(t).at, t));
}

void Refinement::insert_worst() {
  const Triangle t = queue_.worst();
  const Point p = queue_.candidate(t).at;
  insert_at(p, tin_.locate_in(p, t));
}

void Refinement::insert_at(Point p, Triangulation::Location location) {
  inside_ += gain(location);
  const Vertex v = tin_.insert(p, location);
  queue_.grow(tin_.triangle_count());
  tin_.star(v, star_);
  for (const Triangle t : star_) {
    if (tin_.is_outside(t)) {
      queue_.remove(t);
    } else {
      rescan(t);
    }
  }
}

}  // namespace scarp
