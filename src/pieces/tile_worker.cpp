#include "pieces/tile_worker.h"

#include <algorithm>

#include "pieces/border_chain.h"
#include "pieces/tiling.h"
#include "refine/dominant.h"
#include "refine/lazy_levels.h"
#include "refine/tile_domain.h"
#include "refine/tile_order.h"

namespace scarp::pieces {

namespace {

refine::DominantRun refine_in_order(refine::TileOrder order, tin::TileMesh& mesh, refine::TileScanner& scanner,
                                    std::size_t most) {
  switch (order) {
    case refine::TileOrder::kLazyHalf:
      return refine::refine_lazily(mesh, scanner, refine::AreaPower::kHalf, most);
    case refine::TileOrder::kLazyOne:
      return refine::refine_lazily(mesh, scanner, refine::AreaPower::kOne, most);
    case refine::TileOrder::kDominant:
      break;
  }
  return refine::refine_dominant(mesh, scanner, most);
}

}  // namespace

double expected_density(std::size_t kept, std::int64_t steps) {
  // The squared density along a line, times a factor that was 2 to 10 on all kinds of terrain.
  const double along = static_cast<double>(kept) / static_cast<double>(std::max<std::int64_t>(1, steps));
  return 5 * along * along;
}

void add(Work& sum, const Work& work) {
  sum.samples_scanned += work.samples_scanned;
  sum.triangles_scanned += work.triangles_scanned;
  sum.queue_moves += work.queue_moves;
  sum.passes += work.passes;
}

TileOutcome TileWorker::refine(const HeightField& field, const refine::TileWindow& window,
                               const refine::SharedSides& shared, double threshold, double density, std::size_t most) {
  TileOutcome outcome;
  if (outcome.status = tile_.load(field, window); !outcome.status) return outcome;
  outcome.is_unsuited = !is_suited();
  if (outcome.is_unsuited) return outcome;
  if (outcome.status = find_border(field, window, shared, threshold); !outcome.status) return outcome;
  return refine_loaded(field, window, shared, threshold, density, most, {});
}

TileOutcome TileWorker::refine_alone(const HeightField& field, std::span<const Point> on_sides,
                                     std::span<const Point> inside, double threshold, std::size_t most) {
  const refine::TileWindow window{0, 0, field.cols, field.rows};
  TileOutcome outcome;
  if (outcome.status = tile_.load(field, window); !outcome.status) return outcome;
  outcome.is_unsuited = !tile_.is_whole() || !is_suited();
  if (outcome.is_unsuited) return outcome;
  border_.clear();
  for (const Point p : on_sides) border_.push_back(geom::tile_point(p.x, p.y));
  steps_ = 2 * (std::int64_t{field.cols} + field.rows - 2);
  return refine_loaded(field, window, {true, true, true, true}, threshold, 0, most, inside);
}

TileOutcome TileWorker::refine_loaded(const HeightField& field, const refine::TileWindow& window,
                                      const refine::SharedSides& shared, double threshold, double density,
                                      std::size_t most, std::span<const Point> inside) {
  TileOutcome outcome;
  if (outcome.status = refine::start_tile(tile_, border_, mesh_); !outcome.status) return outcome;
  tin::TileMesh::Id last = 0;
  for (const Point p : inside) last = mesh_.insert(geom::tile_point(p.x, p.y), last);
  const double expected = steps_ > 0 ? expected_density(border_.size(), steps_) : density;
  const refine::TileOrder order = refine::choose_order(tile_.view(), expected);
  coarse_.insert(tile_, shared, threshold, expected, order == refine::TileOrder::kLazyOne, mesh_);
  refine::TileScanner scanner(tile_.view(), threshold);
  scanner.set_shared(shared);
  const refine::DominantRun run = refine_in_order(order, mesh_, scanner, most);
  outcome.is_broken_off = !run.finished;
  if (outcome.is_broken_off) return outcome;
  outcome.is_unsuited = scanner.has_given_up();
  outcome.work = {scanner.samples_scanned(), scanner.triangles_scanned(), run.moves, run.insertions};
  add(outcome.work, coarse_.work());
  outcome.piece = pieces_.make(mesh_, {window.col, window.row}, window.cols, window.rows);
  if (field.samples == nullptr) {
    for (const geom::TilePoint p : outcome.piece.points) outcome.heights.push_back(tile_.view().at(p));
  }
  return outcome;
}

Result<void> TileWorker::find_border(const HeightField& field, const refine::TileWindow& window,
                                     const refine::SharedSides& shared, double threshold) {
  border_.clear();
  steps_ = 0;
  for (const BorderLine& line : shared_lines(window, shared)) {
    SCARP_TRY(const auto& kept, simplify_border(field, line, threshold));
    steps_ += line.steps;
    for (const std::int32_t step : kept)
      border_.push_back(geom::tile_point(line.col - window.col + (line.is_vertical ? 0 : step),
                                         line.row - window.row + (line.is_vertical ? step : 0)));
  }
  return {};
}

}  // namespace scarp::pieces
