#include "shape/raster_bench.h"

#include <algorithm>
#include <cmath>

#include "lines/breaklines.h"

namespace scarp::shape {

namespace {

grid::Band::Read aims_of(const metric::SourceBounds& bounds) {
  return [&bounds](Point first, std::int32_t cols, std::int32_t rows, float* out) {
    return bounds.read_aims(first, cols, rows, out, cols);
  };
}

}  // namespace

RasterBench::RasterBench(const grid::Raster& raster, tin::Triangulation& tin, const grid::VertexLattice& lattice,
                         const ShapeTask& task, const grid::Bands& bands, PlanDelaunay& delaunay)
    : bands_(bands),
      rows_(raster.samples == nullptr ? std::optional<grid::Band>(std::in_place, *task.field, 2 * bands.side)
                                      : std::nullopt),
      bound_rows_(task.source_bounds != nullptr
                      ? std::optional<grid::Band>(std::in_place, raster.cols, raster.rows, aims_of(*task.source_bounds),
                                                  2 * bands.side)
                      : std::nullopt),
      samples_(rows_ ? grid::SampleView(*rows_) : grid::SampleView(raster)),
      tin_(tin),
      heights_(samples_),
      error_metric_(bound_rows_ ? metric::LatticeMetric(samples_, heights_, *bound_rows_)
                                : metric::LatticeMetric(samples_, heights_, task.threshold, task.bounds)),
      fixed_(lattice.fixed) {
  if (lattice.are_samples()) tin_.scale(grid::kLatticeSteps);
  for (tin::Vertex v = 0; v < lattice.heights.size(); ++v) {
    const Point p = tin_.point(v);
    const float z = lattice.heights[v];
    if (rows_ || !metric::LatticeHeights::is_sample(p) || (!std::isnan(z) && z != heights_.at(p))) heights_.set(p, z);
  }
  restore_delaunay(tin_, delaunay);
  const auto start = rows_ ? refine::Refinement::Start::kClean : refine::Refinement::Start::kScan;
  refinement_.emplace(error_metric_, tin_, Algorithm::kHeap, EdgeRule{}, start);
  refinement_->follow(&delaunay);
}

void RasterBench::insert_worst() {
  refinement_->insert_worst();
  remember_height();
}

bool RasterBench::insert(Point p, const tin::Triangulation::Location& location) {
  if (!metric::LatticeHeights::is_sample(p)) {
    const float z = height_between(p, location);
    if (std::isnan(z)) return false;
    heights_.set(p, z);
  }
  refinement_->insert_at(p, location);
  remember_height();
  return true;
}

void RasterBench::insert_on_edge(Point p, tin::HalfEdge h, double share) {
  if (!metric::LatticeHeights::is_sample(p) ||
      !samples_.is_valid({p.x / grid::kLatticeSteps, p.y / grid::kLatticeSteps})) {
    const double za = heights_.at(tin_.point(tin_.origin(h)));
    const double zb = heights_.at(tin_.point(tin_.origin(tin::Triangulation::next(h))));
    heights_.set(p, static_cast<float>(za + (zb - za) * share));
  }
  refinement_->insert_at(p, {tin::Triangulation::Location::Kind::kOnEdge, std::min(h, tin_.twin(h))});
  remember_height();
}

void RasterBench::hold(std::size_t band) {
  bands_.hold(band, *rows_);
  if (bound_rows_) bands_.hold(band, *bound_rows_);
}

grid::VertexLattice RasterBench::lattice(bool all_may_go) const {
  grid::VertexLattice lattice{grid::kLatticeSteps, {}, {}};
  lattice.heights.reserve(tin_.vertex_count());
  for (tin::Vertex v = 0; v < tin_.vertex_count(); ++v) {
    const Point p = tin_.point(v);
    lattice.heights.push_back(heights_.at(p));
    const bool was_fixed = v < fixed_.size() && fixed_[v] != 0;
    lattice.fixed.push_back(was_fixed || (!all_may_go && !metric::LatticeHeights::is_sample(p)) ? 1 : 0);
  }
  return lattice;
}

/// The raster's height, but in a level triangle the triangle's height, so that water is flat up to its shore.
float RasterBench::height_between(Point p, const tin::Triangulation::Location& location) const {
  const bool is_on_edge = location.kind == tin::Triangulation::Location::Kind::kOnEdge;
  const tin::HalfEdge across = is_on_edge ? tin_.twin(location.edge) : location.edge;
  for (const tin::HalfEdge h : {location.edge, across}) {
    const auto [a, b, c] = tin_.corners(h / 3);
    const float z = heights_.at(a);
    if (heights_.at(b) == z && heights_.at(c) == z) return z;
  }
  return static_cast<float>(lines::height_between_samples(samples_, p));
}

/// Stores the height of the last vertex, so that its band is not read again.
void RasterBench::remember_height() {
  if (!rows_) return;
  const Point p = tin_.point(static_cast<tin::Vertex>(tin_.vertex_count() - 1));
  if (metric::LatticeHeights::is_sample(p)) heights_.set(p, heights_.at(p));
}

}  // namespace scarp::shape
