#include "row_fit.h"

#include <algorithm>
#include <utility>

#include "base/parallel.h"
#include "effort.h"
#include "fit/fit.h"
#include "goals.h"

namespace scarp {

namespace {

/// Every row's vertices on the same lattice, whatever the row's own extent.
bool has_room(const HeightField& field) { return std::max(field.cols, field.rows) <= kMaxCoordinate / kLatticeSteps; }

}  // namespace

bool fits_rows(const HeightField& field, const SimplifyOptions& options) {
  return field.samples == nullptr && options.effort != Effort::kFast;
}

void fit_rows(const HeightField& field, const SimplifyOptions& options, double threshold, RowFits& fits,
              TiledOptions& tiles) {
  FitOptions whole = fit_options(field, options, threshold);
  whole.threads = options.threads;
  whole.vertices_are_free = whole.vertices_are_free && has_room(field);
  whole.goes_on = false;
  const auto threads = static_cast<std::uint64_t>(thread_count(options.threads));
  tiles.finish_bytes_per_vertex = kFitBytesPerVertex + kFitBytesPerVertexAndThread * threads;
  tiles.finish_row = [whole, &fits, on = tiles.progress](TileRow row) -> Result<FinishedRow> {
    const auto start = Clock::now();
    FitOptions here = whole;
    here.free_sides.top = here.free_sides.top && !row.has_above;
    here.free_sides.bottom = here.free_sides.bottom && !row.has_below;
    if (on) here.progress = [&on](double, std::uint64_t vertices) { return on(0, vertices); };
    auto fitted = fit(row.samples, std::move(row.tin), here);
    if (!fitted) return tl::unexpected(fitted.error());
    fits.seconds += seconds_since(start);
    fits.removed += fitted->counts.removed;
    fits.is_cut_short = fits.is_cut_short || fitted->is_cut_short;
    return FinishedRow{std::move(fitted->tin), std::move(fitted->places)};
  };
}

}  // namespace scarp
