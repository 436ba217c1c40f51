// Scarp's two engines for the programs of bench/speed: from samples in memory to the triangulation.
#pragma once

#include <optional>
#include <string>
#include <utility>

#include "field.h"
#include "metric/height_metric.h"
#include "pieces/release.h"
#include "pieces/tiled.h"
#include "refine/domain.h"
#include "refine/refinement.h"

namespace bench {

struct EngineRun {
  scarp::refine::DomainMesh domain;
  scarp::Order order = scarp::Order::kGreedy;  // the order that was used
  scarp::Work work;
};

inline scarp::grid::Raster view_of(const RawRaster& raw) { return {raw.samples.data(), raw.cols, raw.rows}; }

inline scarp::refine::DomainMesh start_greedy(const scarp::grid::Raster& raster) {
  return check(scarp::refine::build_domain(raster, 0, scarp::grid_frame(raster.rows)));
}

inline EngineRun refine_greedily(const RawRaster& raw, double error) {
  const scarp::grid::Raster raster = view_of(raw);
  EngineRun run{start_greedy(raster), scarp::Order::kGreedy, {}};
  const scarp::metric::HeightMetric metric(raster, error);
  scarp::refine::Refinement refinement(metric, run.domain.tin);
  while (!refinement.done()) refinement.insert_worst();
  run.work = refinement.work();
  return run;
}

/// Refines in the dominant order, or greedily if that engine declines, like simplify(). `side` 0: chosen by the engine.
inline EngineRun refine_dominantly(const RawRaster& raw, double error, int threads, int side = 0) {
  scarp::pieces::TiledOptions options;
  options.threshold = error;
  options.threads = threads;
  options.tile_side = side;
  auto tiled = check(scarp::pieces::refine_tiled(field_of(raw), options));
  if (!tiled) return refine_greedily(raw, error);
  EngineRun run{std::move(tiled->domain), scarp::Order::kDominant, tiled->work};
  const scarp::metric::HeightMetric metric(view_of(raw), error);
  const scarp::Work seams = scarp::pieces::release_seams(run.domain.tin, metric, std::move(tiled->seams));
  run.work.samples_scanned += seams.samples_scanned;
  run.work.triangles_scanned += seams.triangles_scanned;
  return run;
}

inline const char* name_of(scarp::Order order) { return order == scarp::Order::kDominant ? "dominant" : "greedy"; }

}  // namespace bench
