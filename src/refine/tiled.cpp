#include "refine/tiled.h"

#include <algorithm>
#include <utility>

#include "base/parallel.h"
#include "refine/border_chain.h"
#include "refine/coarse_start.h"
#include "refine/dominant.h"
#include "refine/tile_domain.h"
#include "refine/tile_plan.h"
#include "tin/assembly.h"

namespace scarp {

namespace {

/// Vertices a sample of the plane where so many were kept along lines: the square of the density along a line, times
/// what was found on terrain of all kinds (2 to 10).
double expected_density(std::size_t kept, std::int64_t steps) {
  const double along = static_cast<double>(kept) / static_cast<double>(std::max<std::int64_t>(1, steps));
  return 5 * along * along;
}

/// Tiles of a coarse mesh are large, so that borders are few; those of a fine one fit the caches.
std::int32_t side_for(double density) {
  if (density < 0.0005) return 2048;
  if (density < 0.003) return 1024;
  return density < 0.04 ? 512 : 256;
}

/// From the borders that tiles of 512 samples would have.
Result<double> estimate_density(const HeightField& field, double threshold) {
  const TilePlan plan(field.cols, field.rows, 512);
  std::size_t kept = 0;
  std::int64_t steps = 0;
  for (std::size_t i = 0; i < plan.count(); ++i) {
    const SharedSides shared = plan.shared(i);
    for (const BorderLine& line : shared_lines(plan.window(i), {shared.left, shared.top, false, false})) {
      const auto chain = simplify_border(field, line, threshold);
      if (!chain) return tl::unexpected(chain.error());
      kept += chain->size();
      steps += line.steps;
    }
  }
  return expected_density(kept, steps);
}

/// What a finished tile hands over.
struct Outcome {
  Result<void> status;
  TilePiece piece;
  Effort effort;
  bool is_unsuited = false;
};

/// One thread's memory, kept from tile to tile.
class Worker {
 public:
  Outcome refine(const HeightField& field, const TileWindow& window, const SharedSides& shared, double threshold) {
    Outcome outcome;
    if (outcome.status = tile_.load(field, window); !outcome.status) return outcome;
    if (!(tile_.largest_height() <= kMaxScanHeight)) {
      outcome.is_unsuited = true;
      return outcome;
    }
    if (outcome.status = find_border(field, window, shared, threshold); !outcome.status) return outcome;
    if (outcome.status = start_tile(tile_, border_, mesh_); !outcome.status) return outcome;
    if (tile_.is_whole()) coarse_.insert(tile_, shared, threshold, density(), mesh_);
    TileScanner scanner(tile_.view(), threshold);
    scanner.set_shared(shared);
    const DominantRun run = refine_dominant(mesh_, scanner);
    outcome.is_unsuited = scanner.has_given_up();
    outcome.effort = {scanner.samples_scanned(), scanner.triangles_scanned(), run.moves, run.insertions};
    outcome.piece = pieces_.make(mesh_, {window.col, window.row}, window.cols, window.rows);
    return outcome;
  }

 private:
  Result<void> find_border(const HeightField& field, const TileWindow& window, const SharedSides& shared,
                           double threshold) {
    border_.clear();
    steps_ = 0;
    for (const BorderLine& line : shared_lines(window, shared)) {
      const auto kept = simplify_border(field, line, threshold);
      if (!kept) return tl::unexpected(kept.error());
      steps_ += line.steps;
      for (const std::int32_t step : *kept)
        border_.push_back(place(line.col - window.col + (line.is_vertical ? 0 : step),
                                line.row - window.row + (line.is_vertical ? step : 0)));
    }
    return {};
  }

  /// Vertices a sample to be expected, from those on the shared sides. Where there are none, from the raster's border.
  double density() const { return expected_density(border_.size(), steps_); }

  Tile tile_;
  TileMesh mesh_;
  CoarseStart coarse_;
  PieceMaker pieces_;
  std::vector<Place> border_;
  std::int64_t steps_ = 0;  // along the shared sides
};

/// Vertices that no triangle of the domain uses.
std::uint32_t count_unused(const Triangulation& tin) {
  std::vector<bool> is_used(tin.vertex_count(), false);
  for (HalfEdge h = 0; h < 3 * tin.triangle_count(); ++h) {
    if (!tin.is_outside(h / 3)) is_used[tin.origin(h)] = true;
  }
  return static_cast<std::uint32_t>(std::count(is_used.begin(), is_used.end(), false));
}

void add(Effort& sum, const Effort& effort) {
  sum.samples_scanned += effort.samples_scanned;
  sum.triangles_scanned += effort.triangles_scanned;
  sum.queue_moves += effort.queue_moves;
  sum.passes += effort.passes;
}

}  // namespace

Result<std::optional<Tiled>> refine_tiled(const HeightField& field, const TiledOptions& options) {
  std::int32_t side = options.tile_side;
  if (side == 0) {
    const auto density = estimate_density(field, options.threshold);
    if (!density) return tl::unexpected(density.error());
    side = side_for(*density);
  }
  const TilePlan plan(field.cols, field.rows, side);
  std::vector<Worker> workers(
      std::min<std::size_t>(plan.count(), static_cast<std::size_t>(thread_count(options.threads))));
  std::vector<std::optional<Outcome>> outcomes(plan.count());
  Assembly assembly(plan.per_row());
  Effort effort;
  Result<void> status;
  bool is_unsuited = false;
  parallel_in_order(
      plan.count(), options.threads,
      [&](std::size_t i, std::size_t worker) {
        outcomes[i] = workers[worker].refine(field, plan.window(i), plan.shared(i), options.threshold);
      },
      [&](std::size_t i) {
        const Outcome outcome = *std::exchange(outcomes[i], std::nullopt);
        status = outcome.status;
        is_unsuited = outcome.is_unsuited;
        if (!status || is_unsuited) return false;
        if (assembly.triangle_count() + outcome.piece.outside.size() > kNone / 3 - 2) {
          status =
              fail(ErrorKind::kInput, "the mesh would have more than 1,431 million triangles: allow a larger error");
          return false;
        }
        assembly.append(outcome.piece);
        add(effort, outcome.effort);
        if (options.progress &&
            !options.progress(static_cast<double>(i + 1) / static_cast<double>(plan.count()), assembly.vertex_count()))
          status = fail(ErrorKind::kCancelled, "cancelled while refining");
        return status.has_value();
      });
  if (!status) return tl::unexpected(status.error());
  if (is_unsuited) return std::optional<Tiled>();
  std::vector<HalfEdge> seams;
  const bool is_whole = assembly.is_whole();
  Domain domain{assembly.finish(seams), is_whole};
  if (!is_whole) domain.unused = count_unused(domain.tin);
  if (domain.unused == domain.tin.vertex_count())
    return fail(
        ErrorKind::kInput,
        "the raster has no grid cell with three valid corners, so there is no surface to simplify; check nodata");
  return std::optional<Tiled>(Tiled{std::move(domain), std::move(seams), effort});
}

}  // namespace scarp
