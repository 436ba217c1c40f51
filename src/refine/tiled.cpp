#include "refine/tiled.h"

#include <algorithm>
#include <utility>

#include "base/parallel.h"
#include "grid/window.h"
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

/// Below, a tile would hold a few dozen vertices, many of them on its borders.
constexpr double kLeastDensity = 1e-5;

/// Tiles of a coarse mesh are large, so that borders are few; those of a fine one fit the caches.
std::int32_t side_for(double density) {
  if (density < 0.001) return 2048;
  if (density < 0.003) return 1024;
  return density < 0.04 ? 512 : 256;
}

/// From the borders that tiles of 256 samples would have; from the raster's own where there would be none.
Result<double> estimate_density(const HeightField& field, double threshold, int threads) {
  const TilePlan plan(field.cols, field.rows, 256);
  const bool is_alone = plan.count() == 1;
  struct Border {
    Result<void> status;
    std::size_t kept = 0;
    std::int64_t steps = 0;
  };
  std::vector<Border> borders(plan.count());
  parallel_for(plan.count(), threads, [&](std::size_t i) {
    Border& border = borders[i];
    const SharedSides shared = plan.shared(i);
    for (const BorderLine& line :
         shared_lines(plan.window(i), {shared.left || is_alone, shared.top || is_alone, is_alone, is_alone})) {
      const auto chain = simplify_border(field, line, threshold);
      if (!chain) {
        border.status = tl::unexpected(chain.error());
        return;
      }
      border.kept += chain->size();
      border.steps += line.steps;
    }
  });
  std::size_t kept = 0;
  std::int64_t steps = 0;
  for (const Border& border : borders) {
    if (!border.status) return tl::unexpected(border.status.error());
    kept += border.kept;
    steps += border.steps;
  }
  return expected_density(kept, steps);
}

void add(Effort& sum, const Effort& effort) {
  sum.samples_scanned += effort.samples_scanned;
  sum.triangles_scanned += effort.triangles_scanned;
  sum.queue_moves += effort.queue_moves;
  sum.passes += effort.passes;
}

/// What a finished tile hands over.
struct Outcome {
  Result<void> status;
  TilePiece piece;
  std::vector<float> heights;  // of the piece's points
  Effort effort;
  bool is_unsuited = false;
};

/// One thread's memory, kept from tile to tile.
class Worker {
 public:
  /// `density`: of the whole mesh, as expected; 0 if unknown.
  Outcome refine(const HeightField& field, const TileWindow& window, const SharedSides& shared, double threshold,
                 double density) {
    Outcome outcome;
    if (outcome.status = tile_.load(field, window); !outcome.status) return outcome;
    if (!(tile_.largest_height() <= kMaxScanHeight)) {
      outcome.is_unsuited = true;
      return outcome;
    }
    if (outcome.status = find_border(field, window, shared, threshold); !outcome.status) return outcome;
    if (outcome.status = start_tile(tile_, border_, mesh_); !outcome.status) return outcome;
    coarse_.insert(tile_, shared, threshold, steps_ > 0 ? expected_density(border_.size(), steps_) : density, mesh_);
    TileScanner scanner(tile_.view(), threshold);
    scanner.set_shared(shared);
    const DominantRun run = refine_dominant(mesh_, scanner);
    outcome.is_unsuited = scanner.has_given_up();
    outcome.effort = {scanner.samples_scanned(), scanner.triangles_scanned(), run.moves, run.insertions};
    add(outcome.effort, coarse_.effort());
    outcome.piece = pieces_.make(mesh_, {window.col, window.row}, window.cols, window.rows);
    if (field.samples == nullptr) {
      for (const Place p : outcome.piece.points) outcome.heights.push_back(tile_.view().at(p));
    }
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

/// Rows of a field whose source is slow, read once for all the tiles that want them.
class RowBand final : public SampleSource {
 public:
  explicit RowBand(const HeightField& field) : field_(field) {}

  Result<void> load(std::int32_t first, std::int32_t rows) {
    first_ = first;
    samples_.resize(static_cast<std::size_t>(field_.cols) * static_cast<std::size_t>(rows));
    return read_window(field_, 0, first, field_.cols, rows, samples_.data(), field_.cols);
  }
  Result<void> read(int col, int row, int cols, int rows, float* out, std::ptrdiff_t stride) const override {
    for (int y = 0; y < rows; ++y)
      std::copy_n(samples_.data() + static_cast<std::ptrdiff_t>(row + y - first_) * field_.cols + col, cols,
                  out + y * stride);
    return {};
  }
  bool is_in_memory() const override { return true; }
  HeightField view() const {
    HeightField field = field_;
    field.source = this;
    return field;
  }

 private:
  const HeightField& field_;
  std::int32_t first_ = 0;
  std::vector<float> samples_;
};

/// One run over all tiles.
class TiledRun {
 public:
  TiledRun(const HeightField& field, const TiledOptions& options, const TilePlan& plan, double density)
      : options_(options),
        plan_(plan),
        density_(density),
        is_streamed_(field.samples == nullptr && !field.source->is_in_memory()),
        band_(field),
        field_(is_streamed_ ? band_.view() : field),
        workers_(static_cast<std::size_t>(thread_count(options.threads))),
        outcomes_(plan.count()),
        assembly_(plan.per_row()) {}

  Result<std::optional<Tiled>> execute() {
    const std::size_t step = is_streamed_ ? plan_.per_row() : plan_.count();
    for (std::size_t first = 0; first < plan_.count() && status_ && !is_unsuited_; first += step) {
      if (is_streamed_) status_ = load_rows(first);
      if (status_) refine(first, step);
    }
    if (!status_) return tl::unexpected(status_.error());
    if (is_unsuited_) return std::optional<Tiled>();
    const bool is_whole = assembly_.is_whole();
    std::vector<HalfEdge> seams;
    Domain domain{assembly_.finish(seams), is_whole};
    if (!is_whole) domain.unused = count_unused(domain.tin);
    if (domain.unused == domain.tin.vertex_count())
      return fail(
          ErrorKind::kInput,
          "the raster has no grid cell with three valid corners, so there is no surface to simplify; check nodata");
    return std::optional<Tiled>(Tiled{std::move(domain), std::move(seams), std::move(heights_), effort_});
  }

 private:
  /// With the row above and the row below: borders look at the cells on both sides.
  Result<void> load_rows(std::size_t tile) {
    const TileWindow window = plan_.window(tile);
    const std::int32_t first = std::max(window.row - 1, 0);
    return band_.load(first, std::min(window.row + window.rows + 1, field_.rows) - first);
  }

  void refine(std::size_t first, std::size_t count) {
    parallel_in_order(
        count, options_.threads,
        [&](std::size_t i, std::size_t worker) {
          const std::size_t tile = first + i;
          outcomes_[tile] =
              workers_[worker].refine(field_, plan_.window(tile), plan_.shared(tile), options_.threshold, density_);
        },
        [&](std::size_t i) { return commit(first + i); });
  }

  bool commit(std::size_t tile) {
    const Outcome outcome = *std::exchange(outcomes_[tile], std::nullopt);
    status_ = outcome.status;
    is_unsuited_ = outcome.is_unsuited;
    if (!status_ || is_unsuited_) return false;
    if (assembly_.triangle_count() + outcome.piece.outside.size() > kNone / 3 - 2) {
      status_ = fail(ErrorKind::kInput, "the mesh would have more than 1,431 million triangles: allow a larger error");
      return false;
    }
    assembly_.append(outcome.piece);
    add(effort_, outcome.effort);
    keep_heights(outcome.heights);
    const double share = static_cast<double>(tile + 1) / static_cast<double>(plan_.count());
    if (options_.progress && !options_.progress(share, assembly_.vertex_count()))
      status_ = fail(ErrorKind::kCancelled, "cancelled while refining");
    return status_.has_value();
  }

  void keep_heights(const std::vector<float>& heights) {
    if (heights.empty()) return;
    heights_.resize(assembly_.vertex_count());
    for (std::size_t k = 0; k < heights.size(); ++k) heights_[assembly_.last_vertices()[k]] = heights[k];
  }

  const TiledOptions& options_;
  TilePlan plan_;
  double density_;
  bool is_streamed_;
  RowBand band_;
  HeightField field_;
  std::vector<Worker> workers_;
  std::vector<std::optional<Outcome>> outcomes_;
  Assembly assembly_;
  std::vector<float> heights_;
  Effort effort_;
  Result<void> status_;
  bool is_unsuited_ = false;
};

/// Where the samples come from a file: tiles whose rows fit the memory.
std::int32_t streamed_side(const HeightField& field, std::uint64_t memory) {
  std::int32_t side = 512;
  const auto bytes = [&] { return 4ull * static_cast<std::uint64_t>(field.cols) * static_cast<unsigned>(side); };
  while (memory > 0 && side > 64 && bytes() > memory) side /= 2;
  return side;
}

}  // namespace

Result<std::optional<Tiled>> refine_tiled(const HeightField& field, const TiledOptions& options) {
  const bool is_streamed = field.samples == nullptr && !field.source->is_in_memory();
  double density = 0;
  if (!is_streamed) {
    const auto estimate = estimate_density(field, options.threshold, options.threads);
    if (!estimate) return tl::unexpected(estimate.error());
    density = *estimate;
  }
  std::int32_t side = options.tile_side;
  if (options.may_decline && !is_streamed && density < kLeastDensity) return std::optional<Tiled>();
  if (side == 0) side = is_streamed ? streamed_side(field, options.memory) : side_for(density);
  return TiledRun(field, options, TilePlan(field.cols, field.rows, side), density).execute();
}

}  // namespace scarp
