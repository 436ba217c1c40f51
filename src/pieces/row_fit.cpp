#include "pieces/row_fit.h"

#include <algorithm>
#include <memory>
#include <utility>

#include "base/parallel.h"
#include "fit/fit.h"
#include "pieces/effort.h"
#include "pieces/goals.h"
#include "pieces/row_bounds.h"
#include "pieces/row_lines.h"
#include "pieces/row_refinement.h"

namespace scarp {

namespace {

/// Every row's vertices on the same lattice, whatever the row's own extent.
bool has_room(const HeightField& field) { return std::max(field.cols, field.rows) <= kMaxCoordinate / kLatticeSteps; }

/// Goals of shapes want rows rid of what the lines between tiles cost, whatever the effort.
bool is_more_than_refined(const SimplifyOptions& options) {
  return options.effort != Effort::kFast || options.shape.any();
}

}  // namespace

bool fits_rows(const HeightField& field, const SimplifyOptions& options) {
  return field.samples == nullptr && is_more_than_refined(options);
}

bool finishes_rows(const HeightField& field, const SimplifyOptions& options) {
  const bool is_refined = has_lines(options) || options.tolerance_source != nullptr;
  return fits_rows(field, options) || (field.samples == nullptr && is_refined);
}

void finish_rows(const HeightField& field, const SimplifyOptions& options, const ConstraintGraph* lines,
                 double threshold, RowFits& fits, TiledOptions& tiles, const SourceBounds* bounds) {
  FitOptions whole = fit_options(field, options, threshold);
  whole.threads = options.threads;
  whole.vertices_are_free = whole.vertices_are_free && has_room(field);
  whole.goes_on = false;
  if (options.shape.any()) {
    whole.depth = {};
    whole.vertices_are_free = false;
  }
  const bool is_fitted = is_more_than_refined(options);
  const auto threads = static_cast<std::uint64_t>(thread_count(options.threads));
  if (is_fitted) tiles.finish_bytes_per_vertex = kFitBytesPerVertex + kFitBytesPerVertexAndThread * threads;
  std::shared_ptr<RowBounds> bounding;
  if (bounds != nullptr) {
    bounding = std::make_shared<RowBounds>(*bounds);
    tiles.finish_bytes_per_sample = kRowBoundBytesPerSample;
    tiles.finish_bytes_per_vertex = std::max(tiles.finish_bytes_per_vertex, kRowRefinementBytesPerVertex);
    if (bounding->makes_whole()) tiles.is_made_whole = [](std::int32_t, std::int32_t) { return true; };
  }
  std::shared_ptr<RowLines> laying;
  if (lines != nullptr) {
    if (tiles.tile_side == 0) tiles.tile_side = side_of_rows(field, options);
    const bool may_move = options.effort == Effort::kNormal || vertices_are_free(field, options);
    laying = std::make_shared<RowLines>(*lines, tiles.tile_side, is_fitted && may_move);
    if (lines->is_laid_first)
      tiles.is_made_whole = [laying](std::int32_t first, std::int32_t rows) {
        return laying->makes_whole(first, rows);
      };
    tiles.finish_bytes_per_vertex = std::max(tiles.finish_bytes_per_vertex, kRowRefinementBytesPerVertex);
  }
  tiles.finish_row = [whole, is_fitted, laying, bounding, threshold, &fits,
                      on = tiles.progress](TileRow row) -> Result<FinishedRow> {
    const Raster samples = row.samples;
    FitOptions here = whole;
    here.free_sides.top = here.free_sides.top && !row.has_above;
    here.free_sides.bottom = here.free_sides.bottom && !row.has_below;
    std::span<float> aims;
    if (bounding) {
      if (auto loaded = bounding->load(row); !loaded) return tl::unexpected(loaded.error());
      here.bounds = aims = bounding->aims();
    }
    const auto begun = Clock::now();
    Result<FinishedRow> finished = laying     ? laying->lay(std::move(row), threshold, aims)
                                   : bounding ? bounding->refine(std::move(row))
                                              : Result<FinishedRow>(FinishedRow{std::move(row.tin), {}});
    if (!finished) return finished;
    if (laying) {
      fits.seconds_of_lines += seconds_since(begun);
      fits.lines = laying->work();
    } else if (bounding) {
      fits.seconds_of_bounds += seconds_since(begun);
      fits.bounds = bounding->work();
    }
    if (!is_fitted) return finished;
    const auto start = Clock::now();
    if (on) here.progress = [&on](double, std::uint64_t vertices) { return on(0, vertices); };
    auto fitted = fit(samples, std::move(finished->tin), std::move(finished->places), here);
    if (!fitted) return tl::unexpected(fitted.error());
    fits.seconds += seconds_since(start);
    fits.removed += fitted->counts.removed;
    fits.is_cut_short = fits.is_cut_short || fitted->is_cut_short;
    return FinishedRow{std::move(fitted->tin), std::move(fitted->places)};
  };
}

std::int32_t side_of_rows(const HeightField& field, const SimplifyOptions& options) {
  TiledOptions tiles;
  tiles.memory = memory_budget(field, options);
  if (options.tolerance_source != nullptr) tiles.finish_bytes_per_sample = kRowBoundBytesPerSample;
  tiles.finish_row = [](TileRow) -> Result<FinishedRow> { return fail(ErrorKind::kInternal, "no row is there yet"); };
  return streamed_side(field, tiles);
}

}  // namespace scarp
