// A change in three steps: samples, cells made of them, and only then, in one go, what readers see. If a cell cannot be
// made, the samples are put back.
#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdint>
#include <limits>
#include <optional>
#include <utility>
#include <vector>

#include "base/caught.h"
#include "base/parallel.h"
#include "live/cell_lattice.h"
#include "live/cell_mesh.h"
#include "live/sample_ring.h"
#include "live/whole_mesh.h"
#include "scarp/live.h"

namespace scarp {

using live::Area;
using live::CellLattice;
using live::CellSamples;
using live::SampleRing;

namespace {

constexpr std::int32_t kFarthest = 1 << 30;
constexpr float kNoBound = std::numeric_limits<float>::infinity();

bool is_far(std::int64_t place) { return place < -kFarthest || place > kFarthest; }

Area area_of(SampleAt place, int cols, int rows) {
  return {place.col, place.row, place.col + cols - 1, place.row + rows - 1};
}

Result<void> check(const HeightField& field, const LiveOptions& options, std::size_t tolerances) {
  const auto refuse = [](std::string why) { return fail(ErrorKind::kUsage, "a live field " + std::move(why)); };
  if (field.samples == nullptr || field.source != nullptr) return refuse("needs its samples in memory");
  if (!field.channels.empty()) return refuse("has heights only: omit the channels");
  if (!field.frame.is_affine()) return refuse("needs an affine frame");
  if (field.cols < 2 || field.rows < 2)
    return refuse(fmt::format("needs 2 × 2 samples at least, not {} × {}", field.cols, field.rows));
  if (!(options.max_error >= 0) || !std::isfinite(options.max_error))
    return refuse(fmt::format("needs a finite max error of at least 0, not {}", options.max_error));
  if (options.effort == Effort::kMax) return refuse("has efforts up to high: max takes seconds for a cell");
  constexpr int kLeast = 8, kMost = 254;
  if (options.cell != 0 && (options.cell < kLeast || options.cell > kMost))
    return refuse(fmt::format("has cells of {} to {} samples, not {}", kLeast, kMost, options.cell));
  const std::size_t samples = std::size_t(field.cols) * std::size_t(field.rows);
  if (tolerances != 0 && tolerances != samples)
    return refuse(fmt::format("of {} samples cannot have {} tolerances: give one for each", samples, tolerances));
  const auto reaches = [](std::int32_t place, int count) {
    return is_far(place) || is_far(std::int64_t{place} + count);
  };
  if (reaches(options.place.col, field.cols) || reaches(options.place.row, field.rows))
    return refuse("lies within 2^30 samples of the place 0, 0");
  const std::array<double, 6>& to = field.frame.affine;
  const double reach = std::abs(to[0]) + std::abs(to[3]) + (std::abs(to[1]) + std::abs(to[4])) * field.cols +
                       (std::abs(to[2]) + std::abs(to[5])) * field.rows;
  const double step = std::min(std::hypot(to[1], to[4]), std::hypot(to[2], to[5]));
  if (field.frame.determinant() == 0 || !(step > reach * std::numeric_limits<double>::epsilon()))
    return refuse("needs a frame whose samples lie apart in x and y: move it nearer to 0, or give larger cells");
  return {};
}

/// bench/performance.md, "Live fields".
int side_of(const LiveOptions& options) {
  if (options.cell != 0) return options.cell;
  return options.effort == Effort::kFast ? 32 : 64;
}

Result<void> check_tolerances(std::span<const float> tolerances) {
  const auto bad = std::find_if(tolerances.begin(), tolerances.end(), [](float bound) { return !(bound >= 0); });
  if (bad == tolerances.end()) return {};
  return fail(ErrorKind::kUsage,
              fmt::format("tolerance {} (counted from 0) is {}: give 0 or more", bad - tolerances.begin(), *bad));
}

float height_or_void(float height, const std::optional<float>& nodata) {
  return std::isfinite(height) && height != nodata ? height : std::numeric_limits<float>::quiet_NaN();
}

}  // namespace

struct LiveField::Impl {
  /// The state that readers see.
  struct Shown {
    Area area;
    std::uint64_t version = 0;
    std::vector<std::uint64_t> versions;  // by slot, of its cell
    std::vector<std::shared_ptr<const LiveCell>> cells;
  };
  struct Writer {
    bool is_busy = false;
  };
  using Made = std::vector<std::shared_ptr<LiveCell>>;

  Impl(const HeightField& field, const LiveOptions& asked, bool has_tolerances)
      : options(asked),
        frame(field.frame),
        sample_rounding(field.sample_rounding),
        nodata(field.nodata),
        area(area_of(asked.place, field.cols, field.rows)),
        lattice(side_of(asked), field.cols, field.rows),
        heights(field.cols, field.rows, std::numeric_limits<float>::quiet_NaN()) {
    if (has_tolerances) tolerances.emplace(field.cols, field.rows, kNoBound);
    shown.with([&](Shown& now) {
      now.area = area;
      const std::size_t slots = lattice.slot_count();
      now.versions.resize(slots);
      for (std::uint32_t slot = 0; slot < slots; ++slot) {
        LiveCell empty;
        empty.slot = slot;
        now.cells.push_back(std::make_shared<const LiveCell>(std::move(empty)));
      }
    });
  }

  /// One thread at a time changes the field.
  class Claim {
   public:
    explicit Claim(Impl& impl)
        : impl_(impl), is_mine_(impl.writer.with([](Writer& now) { return !std::exchange(now.is_busy, true); })) {}
    Claim(const Claim&) = delete;
    Claim& operator=(const Claim&) = delete;
    ~Claim() {
      if (is_mine_) impl_.writer.with([](Writer& now) { now.is_busy = false; });
    }
    Result<void> check() const {
      if (is_mine_) return {};
      return fail(ErrorKind::kUsage, "another thread changes the live field: wait until its call returns");
    }

   private:
    Impl& impl_;
    bool is_mine_;
  };

  /// The frame of the field where it lies at `now`.
  Frame frame_of(const Area& now) const {
    Frame moved = frame;
    const auto [x, y] = frame.apply_affine(now.west - options.place.col, now.north - options.place.row);
    moved.affine[0] = x;
    moved.affine[3] = y;
    return moved;
  }

  Result<LiveCell> make_cell(SampleAt at) const {
    const Area whole = lattice.area_of(at), cell = whole.clipped(area), grown = cell.grown(1);
    const std::size_t count = std::size_t(grown.cols()) * std::size_t(grown.rows());
    std::vector<float> samples(count), bounds(tolerances ? count : 0);
    heights.read(grown, area, samples.data());
    if (tolerances) tolerances->read(grown, area, bounds.data());
    SCARP_TRY(LiveCell made,
              live::make_cell({cell, samples, bounds}, {whole.west, whole.north}, options, sample_rounding));
    made.slot = lattice.slot_of(at);
    return made;
  }

  Result<Made> make_cells(const std::vector<SampleAt>& dirty) const {
    Made made(dirty.size());
    std::vector<std::optional<Error>> errors(dirty.size());
    const auto make = [&](std::size_t k) {
      Result<LiveCell> cell = make_cell(dirty[k]);
      if (cell)
        made[k] = std::make_shared<LiveCell>(std::move(*cell));
      else
        errors[k] = std::move(cell.error());
    };
    parallel_for(dirty.size(), options.threads, make);
    for (std::optional<Error>& error : errors) {
      if (error) return tl::unexpected(std::move(*error));
    }
    return made;
  }

  void show(Made made) {
    shown.with([&](Shown& now) {
      now.area = area;
      ++now.version;
      for (std::shared_ptr<LiveCell>& cell : made) {
        cell->version = now.versions[cell->slot] = now.version;
        now.cells[cell->slot] = std::move(cell);
      }
    });
  }

  /// Samples of a window, and with them the area whose cells change.
  struct Patch {
    Area area;
    std::vector<float> heights, tolerances;  // the new ones, then the old ones
    Area changed;                            // samples, and the neighbours of those that became valid or void
  };

  Patch plan(const LiveWindow& window, std::span<const float> new_heights, std::span<const float> new_bounds) const {
    Patch patch;
    patch.area = {area.west + window.col, area.north + window.row, area.west + window.col + window.cols - 1,
                  area.north + window.row + window.rows - 1};
    const std::size_t count = new_heights.size();
    std::vector<float> old_heights(count), old_bounds(new_bounds.size());
    heights.read(patch.area, area, old_heights.data());
    if (!new_bounds.empty()) tolerances->read(patch.area, area, old_bounds.data());
    patch.heights.reserve(count);
    for (const float height : new_heights) patch.heights.push_back(height_or_void(height, nodata));
    patch.tolerances.assign(new_bounds.begin(), new_bounds.end());
    Area turned;
    std::size_t k = 0;
    for (std::int32_t row = patch.area.north; row <= patch.area.south; ++row) {
      for (std::int32_t col = patch.area.west; col <= patch.area.east; ++col, ++k) {
        const float now = patch.heights[k], then = old_heights[k];
        const bool is_void = std::isnan(now), was_void = std::isnan(then);
        if (is_void != was_void) turned.include(col, row);
        const bool is_same = now == then || (is_void && was_void);
        if (!is_same || (!new_bounds.empty() && patch.tolerances[k] != old_bounds[k])) patch.changed.include(col, row);
      }
    }
    if (!turned.is_empty()) {
      const Area near = turned.grown(1).clipped(area);
      patch.changed.include(near.west, near.north);
      patch.changed.include(near.east, near.south);
    }
    return patch;
  }

  /// The patch then holds the samples of before.
  void swap(Patch& patch) {
    std::vector<float> old(patch.heights.size());
    heights.read(patch.area, area, old.data());
    heights.write(patch.area, patch.heights);
    patch.heights.swap(old);
    if (patch.tolerances.empty()) return;
    tolerances->read(patch.area, area, old.data());
    tolerances->write(patch.area, patch.tolerances);
    patch.tolerances.swap(old);
  }

  Result<void> update(const LiveWindow& window, std::span<const float> new_heights, std::span<const float> new_bounds) {
    Patch patch = plan(window, new_heights, new_bounds);
    if (patch.changed.is_empty()) return {};
    swap(patch);
    Result<Made> made;
    try {
      made = make_cells(lattice.cells_with(patch.changed, area));
    } catch (...) {
      swap(patch);
      throw;
    }
    if (!made) {
      swap(patch);
      return tl::unexpected(std::move(made.error()));
    }
    show(std::move(*made));
    return {};
  }

  /// Cells whose area, or what their borders read around it, is cut differently.
  std::vector<SampleAt> list_recut(const Area& before) const {
    std::vector<SampleAt> recut;
    for (const SampleAt cell : lattice.cells_of(area)) {
      const Area reads = lattice.area_of(cell).grown(1), now = reads.clipped(area), then = reads.clipped(before);
      if (now != then) recut.push_back(cell);
    }
    return recut;
  }

  /// Slots of no cell any more become empty.
  void add_emptied(Made& made) const {
    std::vector<bool> is_used(lattice.slot_count());
    for (const SampleAt cell : lattice.cells_of(area)) is_used[lattice.slot_of(cell)] = true;
    shown.with([&](const Shown& now) {
      for (std::uint32_t slot = 0; slot < is_used.size(); ++slot) {
        if (is_used[slot] || now.cells[slot]->triangles.empty()) continue;
        made.push_back(std::make_shared<LiveCell>());
        made.back()->slot = slot;
        made.back()->place = now.cells[slot]->place;
      }
    });
  }

  Result<void> scroll(std::int32_t by_cols, std::int32_t by_rows) {
    const Area before = area,
               after{area.west + by_cols, area.north + by_rows, area.east + by_cols, area.south + by_rows};
    struct Left {
      Area area;
      std::vector<float> heights, tolerances;
    };
    std::vector<Left> all_left;
    for (const Area& part : before.beyond(after)) {
      if (part.is_empty()) continue;
      Left left{part, std::vector<float>(std::size_t(part.cols()) * std::size_t(part.rows())), {}};
      heights.read(part, before, left.heights.data());
      left.tolerances.resize(tolerances ? left.heights.size() : 0);
      if (tolerances) tolerances->read(part, before, left.tolerances.data());
      all_left.push_back(std::move(left));
    }
    // Samples that enter are stored where those that leave were.
    for (const Left& left : all_left) {
      heights.clear(left.area);
      if (tolerances) tolerances->clear(left.area);
    }
    area = after;
    const auto put_back = [&] {
      area = before;
      for (const Left& left : all_left) {
        heights.write(left.area, left.heights);
        if (tolerances) tolerances->write(left.area, left.tolerances);
      }
    };
    Result<Made> made;
    try {
      made = make_cells(list_recut(before));
      if (made) add_emptied(*made);
    } catch (...) {
      put_back();
      throw;
    }
    if (!made) {
      put_back();
      return tl::unexpected(std::move(made.error()));
    }
    show(std::move(*made));
    return {};
  }

  const LiveOptions options;
  const Frame frame;  // the field's when it was made
  const double sample_rounding;
  const std::optional<float> nodata;
  Area area;
  const CellLattice lattice;
  SampleRing heights;
  std::optional<SampleRing> tolerances;
  Shared<Writer> writer;
  mutable Mutex samples;  // held by a change, and while they are copied
  mutable Shared<Shown> shown;
};

namespace {

Result<void> check_window(const LiveWindow& window, const Area& field, std::size_t heights, std::size_t tolerances,
                          bool has_tolerances) {
  const auto ends = [](int first, int count, int of) {
    return first >= 0 && count > 0 && std::int64_t{first} + count <= of;
  };
  if (!ends(window.col, window.cols, field.cols()) || !ends(window.row, window.rows, field.rows()))
    return fail(ErrorKind::kUsage,
                fmt::format("the window of {} columns and {} rows at column {}, row {} is not within the live field of "
                            "{} columns and {} rows",
                            window.cols, window.rows, window.col, window.row, field.cols(), field.rows()));
  const std::size_t count = std::size_t(window.cols) * std::size_t(window.rows);
  if (heights != count)
    return fail(ErrorKind::kUsage, fmt::format("the window of {} columns and {} rows needs {} heights, not {}",
                                               window.cols, window.rows, count, heights));
  if (tolerances == 0) return {};
  if (!has_tolerances)
    return fail(ErrorKind::kUsage, "the live field was made without tolerances: give some when it is made");
  if (tolerances == count) return {};
  return fail(ErrorKind::kUsage,
              fmt::format("the window of {} columns and {} rows needs {} tolerances, or none, not {}", window.cols,
                          window.rows, count, tolerances));
}

}  // namespace

LiveField::LiveField(std::unique_ptr<Impl> impl) : impl_(std::move(impl)) {}
LiveField::LiveField(LiveField&&) noexcept = default;
LiveField& LiveField::operator=(LiveField&&) noexcept = default;
LiveField::~LiveField() = default;

Result<LiveField> LiveField::create(const HeightField& field, const LiveOptions& options,
                                    std::span<const float> tolerances) try {
  SCARP_RETURN_IF_ERROR(check(field, options, tolerances.size()));
  SCARP_RETURN_IF_ERROR(check_tolerances(tolerances));
  auto impl = std::make_unique<Impl>(field, options, !tolerances.empty());
  std::vector<float> row;
  for (int at = 0; at < field.rows; ++at) {
    const float* const samples = field.samples + std::ptrdiff_t{at} * field.cols;
    row.clear();
    for (int col = 0; col < field.cols; ++col) row.push_back(height_or_void(samples[col], field.nodata));
    const std::int32_t place = impl->area.north + at;
    const Area area{impl->area.west, place, impl->area.east, place};
    impl->heights.write(area, row);
    if (impl->tolerances)
      impl->tolerances->write(area, tolerances.subspan(std::size_t(at) * std::size_t(field.cols), row.size()));
  }
  SCARP_TRY(auto&& made, impl->make_cells(impl->lattice.cells_of(impl->area)));
  impl->show(std::move(made));
  return LiveField(std::move(impl));
} catch (...) {
  return caught(ErrorKind::kMemory, "make a live field");
}

Result<void> LiveField::update(const LiveWindow& window, std::span<const float> heights,
                               std::span<const float> tolerances) try {
  const Impl::Claim claim(*impl_);
  SCARP_RETURN_IF_ERROR(claim.check());
  SCARP_RETURN_IF_ERROR(
      check_window(window, impl_->area, heights.size(), tolerances.size(), impl_->tolerances.has_value()));
  SCARP_RETURN_IF_ERROR(check_tolerances(tolerances));
  const std::lock_guard<Mutex> lock(impl_->samples);
  return impl_->update(window, heights, tolerances);
} catch (...) {
  return caught(ErrorKind::kMemory, "update a live field");
}

Result<void> LiveField::set(int col, int row, float height) { return update({col, row, 1, 1}, std::span(&height, 1)); }

Result<void> LiveField::scroll(int cols, int rows) try {
  const Impl::Claim claim(*impl_);
  SCARP_RETURN_IF_ERROR(claim.check());
  const Area& area = impl_->area;
  for (const std::int64_t end : {std::int64_t{area.west} + cols, std::int64_t{area.east} + cols,
                                 std::int64_t{area.north} + rows, std::int64_t{area.south} + rows}) {
    if (is_far(end))
      return fail(ErrorKind::kUsage,
                  fmt::format("scrolled by {} columns and {} rows, the live field would lie beyond 2^30 samples from "
                              "the place 0, 0",
                              cols, rows));
  }
  if (cols == 0 && rows == 0) return {};
  const std::lock_guard<Mutex> lock(impl_->samples);
  return impl_->scroll(cols, rows);
} catch (...) {
  return caught(ErrorKind::kMemory, "scroll a live field");
}

LiveChanges LiveField::changes(std::uint64_t since) const {
  return impl_->shown.with([&](const Impl::Shown& now) {
    LiveChanges changes{now.version, {}};
    for (std::size_t slot = 0; slot < now.versions.size(); ++slot) {
      const bool is_wanted = now.versions[slot] > since && (since > 0 || !now.cells[slot]->triangles.empty());
      if (is_wanted) changes.cells.push_back(now.cells[slot]);
    }
    return changes;
  });
}

Mesh LiveField::mesh() const {
  auto [area, cells] = impl_->shown.with([](const Impl::Shown& now) { return std::pair(now.area, now.cells); });
  std::erase_if(cells, [](const auto& cell) { return cell->triangles.empty(); });
  std::sort(cells.begin(), cells.end(), [](const auto& a, const auto& b) {
    return std::pair(a->place.row, a->place.col) < std::pair(b->place.row, b->place.col);
  });
  return live::join_cells(cells, impl_->lattice.side(), area, impl_->frame_of(area));
}

double LiveField::max_error() const {
  return impl_->shown.with([](const Impl::Shown& now) {
    double error = 0;
    for (const auto& cell : now.cells) error = std::max(error, cell->max_error);
    return error;
  });
}

std::uint64_t LiveField::triangle_count() const {
  return impl_->shown.with([](const Impl::Shown& now) {
    std::uint64_t count = 0;
    for (const auto& cell : now.cells) count += cell->triangle_count();
    return count;
  });
}

std::uint32_t LiveField::slot_count() const { return impl_->lattice.slot_count(); }

std::vector<float> LiveField::heights() const {
  const std::lock_guard<Mutex> lock(impl_->samples);
  std::vector<float> samples(std::size_t(impl_->area.cols()) * std::size_t(impl_->area.rows()));
  impl_->heights.read(impl_->area, impl_->area, samples.data());
  return samples;
}

SampleAt LiveField::place() const {
  return impl_->shown.with([](const Impl::Shown& now) { return SampleAt{now.area.west, now.area.north}; });
}

Frame LiveField::frame() const {
  return impl_->shown.with([&](const Impl::Shown& now) { return impl_->frame_of(now.area); });
}

int LiveField::cols() const {
  return impl_->shown.with([](const Impl::Shown& now) { return now.area.cols(); });
}

int LiveField::rows() const {
  return impl_->shown.with([](const Impl::Shown& now) { return now.area.rows(); });
}

}  // namespace scarp
