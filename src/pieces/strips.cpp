#include "pieces/strips.h"

#include <algorithm>
#include <memory>
#include <optional>
#include <utility>
#include <vector>

#include "base/clock.h"
#include "base/parallel.h"
#include "lines/cut_away.h"
#include "metric/sample_metric.h"
#include "pieces/passes.h"
#include "pieces/shared_rows.h"
#include "pieces/strip_lines.h"

namespace scarp::pieces {

namespace {

/// Bytes of bounds per sample of a strip.
constexpr std::uint64_t kAimBytesPerSample = sizeof(float);

/// True if the raster fits the lattice, which all strips share.
bool has_room(const HeightField& field) {
  return std::max(field.cols, field.rows) <= kMaxCoordinate / grid::kLatticeSteps;
}

fit::FitOptions strip_fit(const Recipe& recipe, double threshold) {
  fit::FitOptions fit = recipe.fit;
  fit.threshold = threshold;
  fit.threads = recipe.options.run.threads;
  fit.vertices_are_free = fit.vertices_are_free && has_room(recipe.field);
  fit.goes_on = false;
  if (recipe.options.quality.shape.any()) {
    fit.depth = {};
    fit.vertices_are_free = false;
  }
  return fit;
}

/// Runs the passes strip by strip.
class StripWork {
 public:
  StripWork(const Recipe& recipe, const lines::ConstraintGraph* lines, const metric::SourceBounds* bounds,
            double threshold, std::int32_t side, StripTotals& totals)
      : bounds_(bounds),
        goals_{threshold, recipe.fits_pieces && recipe.releases_starts, recipe.options.run.threads},
        side_(side),
        fit_(recipe.fits_pieces ? std::optional(strip_fit(recipe, threshold)) : std::nullopt),
        totals_(totals) {
    if (lines != nullptr) lines_.emplace(*lines);
  }

  /// Tiles are useless if lines are inserted first, or if samples need not satisfy the max error.
  bool makes_whole(std::int32_t first, std::int32_t rows) const {
    return (bounds_ != nullptr && !bounds_->has_most()) || (lines_ && lines_->makes_whole(first, rows));
  }

  Result<void> work_on(Piece& strip, const std::function<bool(double, std::uint64_t)>& progress) {
    const bool is_whole = makes_whole(strip.first, strip.samples.rows);
    SCARP_RETURN_IF_ERROR(load_aims(strip));
    strip.is_refined = !is_whole && strip.aims.empty();
    const auto start = Clock::now();
    if (is_whole) {
      SCARP_RETURN_IF_ERROR(seed(strip));
    }
    if (lines_) {
      SCARP_RETURN_IF_ERROR(insert_lines(strip, is_whole));
      totals_.seconds_of_lines += seconds_since(start);
    } else if (bounds_ != nullptr) {
      SCARP_RETURN_IF_ERROR(refine_to_bounds(strip, is_whole));
      totals_.seconds_of_refinement += seconds_since(start);
    }
    return fit_ ? fit(strip, progress) : Result<void>();
  }

 private:
  Result<void> load_aims(Piece& strip) {
    if (bounds_ == nullptr) return {};
    aims_.resize(static_cast<std::size_t>(strip.samples.cols) * static_cast<std::size_t>(strip.samples.rows));
    strip.aims = aims_;
    return bounds_->read_aims(strip.first, strip.samples, aims_.data());
  }

  Result<void> insert_lines(Piece& strip, bool is_whole) {
    lines::ConstraintGraph part = lines_->part_of(strip);
    for (const bool is_top : {true, false}) {
      if (!(is_top ? strip.has_above : strip.has_below)) continue;
      if (!is_whole) {
        split_shared_row(strip, is_top, goals_.threshold, part);
      } else {
        SCARP_RETURN_IF_ERROR(start_shared_row(strip, is_top, goals_.threshold, side_, part));
      }
    }
    settle_shared_rows(strip, aims_);
    SCARP_RETURN_IF_ERROR(insert_constraints(strip, part, goals_, totals_.lines));
    has_surface_ = has_surface_ || strip.has_surface;
    if (!has_surface_ && !strip.has_below) return fail(ErrorKind::kInput, lines::kNothingInCutline);
    return {};
  }

  /// The metric of triangles skips samples on shared rows, for which the row's metric has decided.
  Result<void> refine_to_bounds(Piece& strip, bool is_whole) {
    for (const bool is_top : {true, false}) {
      if (!(is_top ? strip.has_above : strip.has_below)) continue;
      SCARP_RETURN_IF_ERROR(insert_shared_row(strip, is_top, is_whole));
    }
    settle_shared_rows(strip, aims_);
    return refine(strip, metric::SampleMetric(metric::settings_by_bounds(strip.samples, strip.aims)),
                  totals_.refinement);
  }

  Result<void> fit(Piece& strip, const std::function<bool(double, std::uint64_t)>& progress) {
    const auto start = Clock::now();
    fit::FitOptions options = *fit_;
    if (progress) options.progress = [&](double, std::uint64_t vertices) { return progress(0, vertices); };
    SCARP_TRY(const auto& fitted, fit_piece(strip, std::move(options)));
    totals_.seconds_of_fit += seconds_since(start);
    totals_.removed += fitted.removed;
    totals_.is_cut_short = totals_.is_cut_short || fitted.is_cut_short;
    return {};
  }

  const metric::SourceBounds* bounds_;
  ConstraintGoals goals_;
  std::int32_t side_;
  std::optional<fit::FitOptions> fit_;
  std::optional<StripLines> lines_;
  std::vector<float> aims_;   // aims of the current strip
  bool has_surface_ = false;  // true if any strip so far has a surface within the cutline
  StripTotals& totals_;
};

}  // namespace

void work_by_strips(const Recipe& recipe, const lines::ConstraintGraph* lines, const metric::SourceBounds* bounds,
                    double threshold, StripTotals& totals, TiledOptions& tiles) {
  const auto threads = static_cast<std::uint64_t>(thread_count(recipe.options.run.threads));
  if (recipe.fits_pieces)
    tiles.finish_bytes_per_vertex = fit::kFitBytesPerVertex + fit::kFitBytesPerVertexAndThread * threads;
  if (bounds != nullptr) tiles.finish_bytes_per_sample = kAimBytesPerSample;
  if (bounds != nullptr || lines != nullptr)
    tiles.finish_bytes_per_vertex = std::max(tiles.finish_bytes_per_vertex, kRefinementBytesPerVertex);
  if (lines != nullptr && tiles.tile_side == 0) tiles.tile_side = strip_side(recipe);
  const auto work = std::make_shared<StripWork>(recipe, lines, bounds, threshold, tiles.tile_side, totals);
  tiles.is_made_whole = [work](std::int32_t first, std::int32_t rows) { return work->makes_whole(first, rows); };
  tiles.finish_strip = [work, progress = tiles.progress](Piece& strip) { return work->work_on(strip, progress); };
}

std::int32_t strip_side(const Recipe& recipe) {
  TiledOptions tiles;
  tiles.memory = recipe.memory;
  if (recipe.has_source_bounds) tiles.finish_bytes_per_sample = kAimBytesPerSample;
  tiles.finish_strip = [](Piece&) -> Result<void> { return fail(ErrorKind::kInternal, "no strip is there yet"); };
  return streamed_side(recipe.field, tiles);
}

}  // namespace scarp::pieces
