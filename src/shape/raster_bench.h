// A raster as the surface whose shapes are refined.
#pragma once

#include <optional>

#include "grid/bands.h"
#include "grid/vertex_lattice.h"
#include "metric/lattice_metric.h"
#include "refine/refinement.h"
#include "shape/plan_metric.h"
#include "shape/shape_bench.h"
#include "shape/shape_refinement.h"

namespace scarp::shape {

class RasterBench final : public ShapeBench {
 public:
  /// Scales `tin` to kLatticeSteps, and restores its Delaunay edges. All arguments stay alive, and no other code
  /// changes `tin`.
  RasterBench(const grid::Raster& raster, tin::Triangulation& tin, const grid::VertexLattice& lattice,
              const ShapeTask& task, const grid::Bands& bands, PlanDelaunay& delaunay);

  bool done() const override { return refinement_->done(); }
  bool is_full() const override { return refinement_->is_full(); }
  double worst_error() const override { return refinement_->worst_error(); }
  void insert_worst() override;
  bool insert(Point p, const tin::Triangulation::Location& location) override;
  void insert_on_edge(Point p, tin::HalfEdge h, double share) override;
  const std::vector<tin::Triangle>& changed() const override { return refinement_->changed(); }
  std::uint64_t samples_scanned() const override { return refinement_->work().samples_scanned; }
  std::uint64_t triangles_scanned() const override { return refinement_->work().triangles_scanned; }
  bool is_streamed() const override { return rows_.has_value(); }
  void hold(std::size_t band) override;
  void scan(tin::Triangle t) override { refinement_->scan({&t, 1}); }

  /// The lattice of the vertices. Vertices that were fixed remain so; vertices between samples are also fixed unless
  /// `all_may_go`.
  grid::VertexLattice lattice(bool all_may_go) const;

 private:
  float height_between(Point p, const tin::Triangulation::Location& location) const;
  void remember_height();

  const grid::Bands& bands_;
  std::optional<grid::Band> rows_;  ///< used if the samples are not entirely in memory
  std::optional<grid::Band> bound_rows_;
  grid::SampleView samples_;
  tin::Triangulation& tin_;
  metric::LatticeHeights heights_;
  metric::LatticeMetric error_metric_;
  std::vector<std::uint8_t> fixed_;  ///< the vertices that were fixed at the start
  std::optional<refine::Refinement> refinement_;
};

}  // namespace scarp::shape
