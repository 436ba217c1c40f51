#include "pieces/tiled.h"

#include <algorithm>
#include <cassert>
#include <utility>

#include "base/parallel.h"
#include "grid/bands.h"
#include "pieces/border_chain.h"
#include "pieces/tile_room.h"
#include "pieces/tile_worker.h"
#include "pieces/tiling.h"
#include "tin/assembly.h"

namespace scarp::pieces {

namespace {

/// Below this, a tile would have a few dozen vertices, many of them on its borders.
constexpr double kLeastDensity = 1e-5;

/// Large tiles for a coarse mesh, so that borders are few; for a fine mesh, tiles that fit the caches.
std::int32_t side_for(double density) {
  if (density < 0.001) return 2048;
  if (density < 0.003) return 1024;
  return density < 0.04 ? 512 : 256;
}

/// Estimates the density from the borders of tiles of 256 samples; without such borders, from the raster's edges.
Result<double> estimate_density(const HeightField& field, double threshold, int threads) {
  const Tiling tiling(field.cols, field.rows, 256);
  const bool is_alone = tiling.count() == 1;
  struct Border {
    Result<void> status;
    std::size_t kept = 0;
    std::int64_t steps = 0;
  };
  std::vector<Border> borders(tiling.count());
  parallel_for(tiling.count(), threads, [&](std::size_t i) {
    Border& border = borders[i];
    const refine::SharedSides shared = tiling.shared(i);
    for (const BorderLine& line :
         shared_lines(tiling.window(i), {shared.left || is_alone, shared.top || is_alone, is_alone, is_alone})) {
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
    SCARP_RETURN_IF_ERROR(border.status);
    kept += border.kept;
    steps += border.steps;
  }
  return expected_density(kept, steps);
}

/// Number of vertices in no triangle of the domain.
std::uint32_t count_unused(const tin::Triangulation& tin) {
  std::vector<bool> is_used(tin.vertex_count(), false);
  for (tin::HalfEdge h = 0; h < 3 * tin.triangle_count(); ++h) {
    if (!tin.is_outside(h / 3)) is_used[tin.origin(h)] = true;
  }
  return static_cast<std::uint32_t>(std::count(is_used.begin(), is_used.end(), false));
}

/// True if samples are neither in one array nor in a source that copies them.
bool is_in_file(const HeightField& field) { return field.samples == nullptr && !field.source->is_in_memory(); }

/// Rows of a field with a slow source, read once for all tiles that need them.
class StripSource final : public SampleSource {
 public:
  explicit StripSource(const HeightField& field) : field_(field), band_(field_, 0) {}

  Result<void> load(std::int32_t first, std::int32_t rows) {
    band_.clear();
    return band_.load(first, rows);
  }
  Result<void> read(int col, int row, int cols, int rows, float* out, std::ptrdiff_t stride) const override {
    for (int y = 0; y < rows; ++y) std::copy_n(band_.samples(col, row + y, cols), cols, out + y * stride);
    return {};
  }
  bool is_in_memory() const override { return true; }
  /// A view of loaded rows.
  grid::Raster raster(std::int32_t row, std::int32_t rows) const {
    return {band_.raster().row(row - band_.first()), field_.cols, rows};
  }
  HeightField view() const {
    HeightField field = field_;
    field.source = this;
    return field;
  }

 private:
  const HeightField& field_;
  grid::Band band_;
};

/// True if strips are read and finished sequentially.
bool goes_by_strips(const HeightField& field, const TiledOptions& options) {
  return is_in_file(field) || options.finish_strip != nullptr;
}

/// Bytes per sample of a strip: the sample; for finishing also a copy, and the memory that finishing needs.
std::uint64_t bytes_per_sample(const TiledOptions& options) {
  return options.finish_strip ? 2 * sizeof(float) + options.finish_bytes_per_sample : sizeof(float);
}

/// Bytes of the samples of the tallest strip, if read by rows.
std::uint64_t strip_bytes(const HeightField& field, const Tiling& tiling) {
  std::int32_t rows = 0;
  for (std::size_t i = 0; i < tiling.count(); i += tiling.per_row()) rows = std::max(rows, tiling.window(i).rows);
  return sizeof(float) * static_cast<std::uint64_t>(field.cols) * static_cast<std::uint64_t>(rows + 2);
}

/// Bytes of a thread's buffers and of waiting finished tiles, without vertices: about twice the samples of a tile.
std::uint64_t worker_bytes(const Tiling& tiling) {
  const refine::TileWindow window = tiling.window(0);
  return 2 * sizeof(float) * static_cast<std::uint64_t>(window.cols) * static_cast<std::uint64_t>(window.rows);
}

/// One run over all tiles.
class TiledRun {
 public:
  TiledRun(const HeightField& field, const TiledOptions& options, const Tiling& tiling, double density)
      : options_(options),
        tiling_(tiling),
        density_(density),
        is_streamed_(goes_by_strips(field, options)),
        band_(field),
        field_(is_streamed_ ? band_.view() : field),
        step_(is_streamed_ ? tiling.per_row() : tiling.count()),
        threads_(options.memory.threads_within(worker_bytes(tiling), thread_count(options.threads))),
        workers_(static_cast<std::size_t>(threads_)),
        outcomes_(tiling.count()),
        assembly_(options.finish_strip ? 1 : tiling.per_row()),
        strip_(tiling.per_row()) {
    // finish_strip may copy the samples of its strip.
    if (is_streamed_) base_bytes_ += strip_bytes(field, tiling) / sizeof(float) * bytes_per_sample(options);
    base_bytes_ += std::min<std::uint64_t>(workers_.size(), step_) * worker_bytes(tiling);
  }

  Result<std::optional<Tiled>> execute() {
    SCARP_RETURN_IF_ERROR(options_.memory.check_start(base_bytes_));
    for (std::size_t first = 0; first < tiling_.count() && status_ && !is_unsuited_; first += step_) {
      if (is_streamed_) status_ = load_rows(first);
      const refine::TileWindow window = tiling_.window(first);
      const bool is_made_whole = options_.is_made_whole && options_.is_made_whole(window.row, window.rows);
      if (status_ && !is_made_whole) refine(first, step_);
      if (status_ && !is_unsuited_ && options_.finish_strip)
        status_ = finish_strip(window, is_made_whole,
                               static_cast<double>(first + step_) / static_cast<double>(tiling_.count()));
    }
    SCARP_RETURN_IF_ERROR(status_);
    if (is_unsuited_) return std::optional<Tiled>();
    const bool is_whole = assembly_.is_whole();
    if (!fixed_.empty()) fixed_.resize(static_cast<std::size_t>(assembly_.vertex_count()), 0);
    std::vector<tin::HalfEdge> seams;
    refine::DomainMesh domain{assembly_.finish(seams), is_whole};
    if (!is_whole) domain.unused = count_unused(domain.tin);
    if (domain.unused == domain.tin.vertex_count())
      return fail(
          ErrorKind::kInput,
          "the raster has no grid cell with three valid corners, so there is no surface to simplify; check nodata");
    return std::optional<Tiled>(
        Tiled{std::move(domain), std::move(seams), std::move(heights_), steps_, std::move(fixed_), work_});
  }

 private:
  /// Includes the row above and the row below, since borders examine cells on both sides.
  Result<void> load_rows(std::size_t tile) {
    const refine::TileWindow window = tiling_.window(tile);
    const std::int32_t first = std::max(window.row - 1, 0);
    return band_.load(first, std::min(window.row + window.rows + 1, field_.rows) - first);
  }

  /// Continues with one tile at a time, beginning with the first tile that did not fit in addition to others. Thus each
  /// tile gets all available memory, for any number of threads.
  void refine(std::size_t first, std::size_t count) {
    const std::size_t end = first + count;
    const std::size_t refused = refine(first, end, threads_);
    if (refused == end || !status_ || is_unsuited_) return;
    workers_ = std::vector<TileWorker>(workers_.size());
    for (std::size_t tile = refused; tile < end; ++tile) outcomes_[tile].reset();
    const std::size_t too_large = refine(refused, end, 1);
    if (too_large != end && status_) status_ = refuse(too_large);
  }

  /// Returns the first tile that does not fit, or `end`.
  std::size_t refine(std::size_t first, std::size_t end, int threads) {
    std::size_t refused = end;
    TileRoom room(options_.memory, base_bytes_, assembly_.vertex_count() + strip_.vertex_count(), threads);
    parallel_in_order(
        end - first, threads,
        [&](std::size_t i, std::size_t worker) {
          const std::size_t tile = first + i, most = room.begin();
          outcomes_[tile] = workers_[worker].refine(field_, tiling_.window(tile), tiling_.shared(tile),
                                                    options_.threshold, density_, most);
          room.end(most, outcomes_[tile]->piece.points.size());
        },
        [&](std::size_t i) {
          TileOutcome outcome = *std::exchange(outcomes_[first + i], std::nullopt);
          if (outcome.is_broken_off) refused = first + i;
          if (outcome.is_broken_off) return false;
          room.commit(outcome.piece.points.size());
          return commit(std::move(outcome), first + i);
        });
    return refused;
  }

  /// The error for a tile that exceeds all memory. Estimates the tile's size as the densest possible, or four times the
  /// room.
  Result<void> refuse(std::size_t tile) const {
    const MemoryBudget& memory = options_.memory;
    const std::uint64_t before = assembly_.vertex_count() + strip_.vertex_count(),
                        each = TileRoom::bytes_per_vertex(memory);
    const std::uint64_t taken = std::min(memory.rest(), base_bytes_ + before * memory.per_vertex);
    const std::uint64_t most = (memory.rest() - taken) / each + 1;
    const refine::TileWindow window = tiling_.window(tile);
    const double samples = static_cast<double>(window.cols) * window.rows;
    const double expected = static_cast<double>(before) + std::min(samples, 4 * static_cast<double>(most));
    const double share = static_cast<double>(before + most) / expected * static_cast<double>(tile + 1) /
                         static_cast<double>(tiling_.count());
    return memory.check_mesh(base_bytes_ + (each - memory.per_vertex) * most, before + most, share);
  }

  bool commit(TileOutcome outcome, std::size_t tile) {
    status_ = outcome.status;
    is_unsuited_ = outcome.is_unsuited;
    if (!status_ || is_unsuited_) return false;
    if (assembly_.triangle_count() + strip_.triangle_count() + outcome.piece.outside.size() > tin::kNone / 3 - 2) {
      status_ = fail(ErrorKind::kInput, "the mesh would have more than 1,431 million triangles: allow a larger error");
      return false;
    }
    add(work_, outcome.work);
    if (options_.finish_strip) {
      outcome.piece.first.y = 0;
      strip_.append(outcome.piece);
    } else {
      assembly_.append(outcome.piece);
      keep_heights(outcome.heights);
    }
    const double share = static_cast<double>(tile + 1) / static_cast<double>(tiling_.count());
    const std::uint64_t vertices = assembly_.vertex_count() + strip_.vertex_count();
    if (status_ = options_.memory.check_mesh(base_bytes_ + finish_bytes(strip_.vertex_count()), vertices, share);
        !status_)
      return false;
    if (options_.progress && !options_.progress(share, vertices))
      status_ = fail(ErrorKind::kCancelled, "cancelled while refining");
    return status_.has_value();
  }

  /// Bytes of finishing in addition to those of the strip's vertices.
  std::uint64_t finish_bytes(std::uint64_t vertices) const {
    const std::uint64_t whole = options_.finish_bytes_per_vertex, mesh = options_.memory.per_vertex;
    return (std::max(whole, mesh) - mesh) * vertices;
  }

  /// `share`: the finished share of all tiles after this strip.
  Result<void> finish_strip(const refine::TileWindow& window, bool is_made_whole, double share) {
    const grid::Raster samples = band_.raster(window.row, window.rows);
    const bool has_above = window.row > 0, has_below = window.row + window.rows < field_.rows;
    std::vector<tin::HalfEdge> seams;
    Piece strip{
        samples,   window.row, is_made_whole ? tin::Triangulation(samples.cols, samples.rows) : strip_.finish(seams),
        has_above, has_below,  band_.raster(window.row - has_above, window.rows + has_above + has_below)};
    strip.check = [this, share](std::uint64_t vertices, double, double) -> Result<void> {
      const std::uint64_t all = assembly_.vertex_count() + vertices;
      if (options_.progress && !options_.progress(share, all))
        return fail(ErrorKind::kCancelled, "cancelled while refining");
      return options_.memory.check_mesh(base_bytes_ + finish_bytes(vertices), all, share);
    };
    strip_ = tin::Assembly(tiling_.per_row());
    SCARP_RETURN_IF_ERROR(options_.finish_strip(strip));
    const tin::Triangulation& tin = strip.tin;
    const grid::VertexLattice& lattice = strip.lattice;
    assert(window.row == 0 || lattice.steps == steps_);
    steps_ = lattice.steps;
    assembly_.append(tin, {0, window.row * steps_}, (samples.cols - 1) * steps_ + 1, (samples.rows - 1) * steps_ + 1);
    std::vector<float> heights = lattice.heights;
    for (tin::Vertex v = 0; lattice.are_samples() && v < tin.vertex_count(); ++v)
      heights.push_back(samples.at(tin.point(v)));
    keep_heights(heights);
    keep_fixed(lattice.fixed);
    return {};
  }

  void keep_heights(const std::vector<float>& heights) {
    if (heights.empty()) return;
    heights_.resize(static_cast<std::size_t>(assembly_.vertex_count()));
    for (std::size_t k = 0; k < heights.size(); ++k) heights_[assembly_.last_vertices()[k]] = heights[k];
  }

  void keep_fixed(const std::vector<std::uint8_t>& fixed) {
    if (fixed.empty()) return;
    fixed_.resize(static_cast<std::size_t>(assembly_.vertex_count()), 0);
    for (std::size_t k = 0; k < fixed.size(); ++k) {
      if (fixed[k] != 0) fixed_[assembly_.last_vertices()[k]] = 1;
    }
  }

  const TiledOptions& options_;
  std::uint64_t base_bytes_ = 0;  // bytes independent of the mesh
  Tiling tiling_;
  double density_;
  bool is_streamed_;
  StripSource band_;
  HeightField field_;
  std::size_t step_;  // tiles refined per reading of rows
  int threads_;
  std::vector<TileWorker> workers_;
  std::vector<std::optional<TileOutcome>> outcomes_;
  tin::Assembly assembly_;  // assembly of tiles, or of finished strips
  tin::Assembly strip_;     // assembly of tiles of the current strip
  std::vector<float> heights_;
  std::vector<std::uint8_t> fixed_;
  std::int32_t steps_ = 1;
  Work work_;
  Result<void> status_;
  bool is_unsuited_ = false;
};

}  // namespace

/// Strips use a quarter of the memory, or half with post-processing, since each border between strips makes its result
/// worse.
std::int32_t streamed_side(const HeightField& field, const TiledOptions& options) {
  const MemoryBudget& memory = options.memory;
  std::int32_t side = options.finish_strip ? 1024 : 512;
  const std::uint64_t parts = options.finish_strip ? 2 : 4;
  const auto bytes = [&] {
    return bytes_per_sample(options) * static_cast<std::uint64_t>(field.cols) * static_cast<unsigned>(side);
  };
  while (memory.is_limited() && side > 64 && bytes() > memory.rest() / parts) side /= 2;
  return side;
}

std::vector<std::int32_t> shared_rows(const HeightField& field, std::int32_t side) {
  const Tiling tiling(field.cols, field.rows, side);
  std::vector<std::int32_t> rows;
  for (std::size_t tile = tiling.per_row(); tile < tiling.count(); tile += tiling.per_row())
    rows.push_back(tiling.window(tile).row);
  return rows;
}

Result<std::optional<Tiled>> refine_tiled(const HeightField& field, const TiledOptions& options) {
  const bool is_streamed = goes_by_strips(field, options);
  double density = 0;
  if (!is_streamed) {
    SCARP_TRY(density, estimate_density(field, options.threshold, options.threads));
  }
  std::int32_t side = options.tile_side;
  if (options.may_decline && !is_streamed && density < kLeastDensity) return std::optional<Tiled>();
  if (side == 0) side = is_streamed ? streamed_side(field, options) : side_for(density);
  return TiledRun(field, options, Tiling(field.cols, field.rows, side), density).execute();
}

Result<std::optional<Tiled>> refine_alone(const grid::Raster& raster, std::span<const Point> on_sides,
                                          std::span<const Point> inside, const TiledOptions& options) {
  if (std::max(raster.cols, raster.rows) > geom::kMaxTileSide) return std::optional<Tiled>();
  HeightField field;
  field.samples = raster.samples;
  field.cols = raster.cols;
  field.rows = raster.rows;
  const MemoryBudget& memory = options.memory;
  const std::uint64_t bytes = worker_bytes(Tiling(raster.cols, raster.rows, std::max(raster.cols, raster.rows)));
  SCARP_RETURN_IF_ERROR(memory.check_start(bytes));
  const std::uint64_t room = memory.rest() - std::min(memory.rest(), bytes);
  const std::size_t most =
      memory.is_limited() ? room / TileRoom::bytes_per_vertex(memory) : std::numeric_limits<std::size_t>::max();
  TileWorker worker;
  const TileOutcome outcome = worker.refine_alone(field, on_sides, inside, options.threshold, most);
  SCARP_RETURN_IF_ERROR(outcome.status);
  if (outcome.is_unsuited) return std::optional<Tiled>();
  const std::uint64_t vertices = outcome.is_broken_off ? most + 1 : outcome.piece.points.size();
  const std::uint64_t more = outcome.is_broken_off ? room : 0;
  SCARP_RETURN_IF_ERROR(memory.check_mesh(bytes + more, vertices, 1));
  tin::Assembly assembly(0);
  assembly.append(outcome.piece);
  std::vector<tin::HalfEdge> seams;
  refine::DomainMesh domain{assembly.finish(seams), true};
  return std::optional<Tiled>(Tiled{std::move(domain), {}, {}, 1, {}, outcome.work});
}

}  // namespace scarp::pieces
