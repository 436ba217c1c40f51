// A change has three steps: it writes samples, makes cells from them, and only then replaces, all at once, the state
// that readers see. If a cell cannot be made, the samples are restored.
#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdint>
#include <limits>
#include <map>
#include <optional>
#include <tuple>
#include <utility>
#include <vector>

#include "base/caught.h"
#include "base/parallel.h"
#include "live/bound_ladder.h"
#include "live/cell_lattice.h"
#include "live/cell_mesh.h"
#include "live/checks.h"
#include "live/field_samples.h"
#include "live/whole_mesh.h"
#include "scarp/live.h"

namespace scarp {

namespace {

using live::Area;
using live::BoundLadder;
using live::CellBounds;
using live::CellLattice;
using live::CellRules;
using live::CellSamples;
using live::enough;
using live::FieldSamples;
using live::LevelSearch;
using live::Patch;

Area area_of(SampleAt place, int cols, int rows) {
  return {place.col, place.row, place.col + cols - 1, place.row + rows - 1};
}

/// See bench/performance.md, "Live fields".
int side_of(const LiveOptions& options) {
  if (options.cell != 0) return options.cell;
  return options.effort == Effort::kFast ? 32 : 64;
}

/// Start of the search for a budget: a coarse level, since a fine mesh costs more.
std::int64_t first_level(const HeightField& field, const BoundLadder& ladder, double max_error) {
  const HeightRange range = height_range(field);
  constexpr double kParts = 64;
  const double start = (range.max - range.min) / kParts;
  return ladder.level_of(start > max_error ? start : max_error > 0 ? max_error : 1);
}

CellRules rules_of(const HeightField& field, const LiveOptions& options) {
  CellRules rules{
      options.max_triangles.has_value(), options.effort, options.norm, field.sample_rounding, field.height_scale, {}};
  for (const Channel& channel : field.channels) rules.channel_scales.push_back(channel.scale);
  return rules;
}

/// The number of triangles added, modulo 2^64 if there are fewer than before.
std::uint64_t added_by(const LiveCell& cell, const LiveCell& before) {
  return std::uint64_t{cell.triangle_count()} - before.triangle_count();
}

float height_or_void(float height, const std::optional<float>& nodata) {
  return std::isfinite(height) && height != nodata ? height : std::numeric_limits<float>::quiet_NaN();
}

}  // namespace

struct LiveField::Impl {
  /// Numbers of cells that another bound can change: to more triangles, to fewer.
  struct Room {
    std::int64_t finer = 0, coarser = 0;

    void add(const Room& room, const Room& before) {
      finer += room.finer - before.finer;
      coarser += room.coarser - before.coarser;
    }
  };
  /// The state that readers see.
  struct Shown {
    Area area;
    std::int64_t level = 0;
    std::uint64_t version = 0, triangles = 0;
    std::uint64_t least = 0;  // a mesh with this many triangles needs no search for the budget
    Room room;
    std::vector<std::uint64_t> versions;  // by slot: version of its cell
    std::vector<std::shared_ptr<const LiveCell>> cells;
    std::vector<Room> rooms;  // by slot
  };
  struct Writer {
    bool is_busy = false;
  };
  /// Result of a change: cells by slot, and the level of their bounds.
  struct Made {
    struct Cell {
      std::shared_ptr<LiveCell> mesh;
      Room room;
    };
    std::int64_t level = 0;
    std::uint64_t least = 0;
    std::map<std::uint32_t, Cell> cells;
  };

  Impl(const HeightField& field, const LiveOptions& asked, bool has_tolerances)
      : options(asked),
        frame(field.frame),
        nodata(field.nodata),
        rules(rules_of(field, asked)),
        lattice(side_of(asked), field.cols, field.rows),
        ladder(lattice, asked.max_error, asked.max_triangles.has_value()),
        samples(area_of(asked.place, field.cols, field.rows), has_tolerances, field.channels.size()) {
    shown.with([&](Shown& now) {
      now.area = samples.area();
      const std::size_t slots = lattice.slot_count();
      now.versions.resize(slots);
      now.rooms.resize(slots);
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

  /// The frame of the field at the place `now`.
  Frame frame_of(const Area& now) const {
    Frame moved = frame;
    const auto [x, y] = frame.apply_affine(now.west - options.place.col, now.north - options.place.row);
    moved.affine[0] = x;
    moved.affine[3] = y;
    return moved;
  }

  /// Borrows the patch.
  CellSamples view(const Patch& patch, const Area& cell) const {
    CellSamples view{cell, patch.layers[FieldSamples::kHeights], {}, {}};
    if (samples.has_tolerances()) view.tolerances = patch.layers[samples.tolerances()];
    for (std::size_t k = 0; k < samples.channel_count(); ++k) view.channels.push_back(patch.layers[samples.channel(k)]);
    return view;
  }

  Result<Made::Cell> make_cell(SampleAt at, std::int64_t level) const {
    const Area whole = lattice.area_of(at), cell = whole.clipped(samples.area());
    const Patch around = samples.read(cell.grown(1));
    CellBounds bounds = ladder.bounds_of(at, level);
    Room room;
    if (options.max_triangles) {
      const double reach = live::find_reach(view(samples.read(cell), cell), rules),
                   finest = std::max({options.max_error, live::finest_bound(reach), 2 * rules.sample_rounding});
      bounds.inside = std::max(bounds.inside, finest);
      room = {bounds.inside > finest, bounds.inside < 2 * reach};
    }
    SCARP_TRY(LiveCell made, live::make_cell(view(around, cell), {whole.west, whole.north}, bounds, rules));
    made.slot = lattice.slot_of(at);
    if (made.max_error == 0) room.finer = 0;
    if (made.triangles.empty()) room = {};
    return Made::Cell{std::make_shared<LiveCell>(std::move(made)), room};
  }

  /// Makes cells at the level of `made` and stores them there.
  Result<void> make_cells(const std::vector<SampleAt>& dirty, Made& made) const {
    std::vector<Result<Made::Cell>> cells(dirty.size());
    parallel_for(dirty.size(), options.threads, [&](std::size_t k) { cells[k] = make_cell(dirty[k], made.level); });
    for (Result<Made::Cell>& cell : cells) {
      if (!cell) return tl::unexpected(std::move(cell.error()));
      made.cells[cell->mesh->slot] = std::move(*cell);
    }
    return {};
  }

  /// The number of triangles of the field with the new cells, and the room of all its cells.
  std::pair<std::uint64_t, Room> count(const Made& made) const {
    return shown.with([&](const Shown& now) {
      std::pair counts(now.triangles, now.room);
      for (const auto& [slot, cell] : made.cells) {
        counts.first += added_by(*cell.mesh, *now.cells[slot]);
        counts.second.add(cell.room, now.rooms[slot]);
      }
      return counts;
    });
  }

  /// Changes to a level within the budget, and makes the cells whose bounds this changes. `dirty`: cells whose samples
  /// changed; `made` already has them.
  Result<void> keep_budget(const std::vector<SampleAt>& dirty, Made& made) const {
    if (!options.max_triangles) return {};
    const std::int64_t before = made.level;
    const std::uint64_t budget = *options.max_triangles;
    LevelSearch search(ladder, budget, made.least);
    std::vector<SampleAt> all;
    Made found;
    std::uint64_t found_triangles = 0;
    bool can_be_finer = false;
    for (;;) {
      const auto [triangles, room] = count(made);
      const auto next = search.next(made.level, triangles, room.finer > 0, room.coarser > 0);
      if (search.found() == made.level) {
        found_triangles = triangles;
        can_be_finer = room.finer > 0;
        if (next) found = made;
      }
      if (!next && !search.found())
        return fail(ErrorKind::kUsage,
                    fmt::format("the live field needs {} triangles with any bound, more than its budget of {}",
                                triangles, budget));
      if (!next) break;
      if (all.empty()) all = lattice.cells_of(samples.area());
      std::vector<SampleAt> moved;
      for (const SampleAt cell : all) {
        if (!ladder.is_same(cell, made.level, *next)) moved.push_back(cell);
      }
      made.level = *next;
      const Result<void> tried = make_cells(moved, made);
      if (!tried && !search.found()) return tried;
      if (!tried) break;  // the arithmetic cannot satisfy the bound
    }
    if (search.found() != made.level) made = std::move(found);
    made.least = enough(budget);
    // If the count skips the range from one level to the next, the next change need not search there again.
    if (found_triangles < made.least && can_be_finer)
      made.least = found_triangles - std::min(found_triangles, budget / 50);
    if (made.level == before) return {};
    std::vector<bool> is_dirty(lattice.slot_count());
    for (const SampleAt cell : dirty) is_dirty[lattice.slot_of(cell)] = true;
    for (const SampleAt cell : all) {
      const std::uint32_t slot = lattice.slot_of(cell);
      if (!is_dirty[slot] && ladder.is_same(cell, before, made.level)) made.cells.erase(slot);
    }
    return {};
  }

  /// Empties the slots that no longer have a cell.
  void add_emptied(Made& made) const {
    std::vector<bool> is_used(lattice.slot_count());
    for (const SampleAt cell : lattice.cells_of(samples.area())) is_used[lattice.slot_of(cell)] = true;
    shown.with([&](const Shown& now) {
      for (std::uint32_t slot = 0; slot < is_used.size(); ++slot) {
        if (is_used[slot] || now.cells[slot]->triangles.empty()) continue;
        LiveCell empty;
        empty.slot = slot;
        empty.place = now.cells[slot]->place;
        made.cells[slot] = {std::make_shared<LiveCell>(std::move(empty)), {}};
      }
    });
  }

  void show(Made made) {
    shown.with([&](Shown& now) {
      now.area = samples.area();
      now.level = made.level;
      now.least = made.least;
      ++now.version;
      for (auto& [slot, cell] : made.cells) {
        now.triangles += added_by(*cell.mesh, *now.cells[slot]);
        now.room.add(cell.room, now.rooms[slot]);
        now.rooms[slot] = cell.room;
        cell.mesh->version = now.versions[slot] = now.version;
        now.cells[slot] = std::move(cell.mesh);
      }
    });
  }

  /// Makes the cells of a change and shows them. If one cannot be made, `undo` restores the samples.
  template <class Undo>
  Result<void> finish(const std::vector<SampleAt>& dirty, bool is_moved, const Undo& undo) {
    Made made;
    Result<void> done;
    try {
      std::tie(made.level, made.least) = shown.with([](const Shown& now) { return std::pair(now.level, now.least); });
      done = make_cells(dirty, made);
      if (done && is_moved) add_emptied(made);
      if (done) done = keep_budget(dirty, made);
    } catch (...) {
      undo();
      throw;
    }
    if (!done) {
      undo();
      return done;
    }
    show(std::move(made));
    return {};
  }

  Patch patch_of(const LiveWindow& window, std::span<const float> heights, std::span<const float> tolerances,
                 std::span<const std::span<const float>> channels) const {
    const Area& field = samples.area();
    Patch patch{area_of({field.west + window.col, field.north + window.row}, window.cols, window.rows), {}};
    patch.layers.resize(samples.layer_count());
    for (const float height : heights) patch.layers[FieldSamples::kHeights].push_back(height_or_void(height, nodata));
    if (!tolerances.empty()) patch.layers[samples.tolerances()].assign(tolerances.begin(), tolerances.end());
    for (std::size_t k = 0; k < channels.size(); ++k)
      patch.layers[samples.channel(k)].assign(channels[k].begin(), channels[k].end());
    return patch;
  }

  Result<void> update(Patch patch) {
    SCARP_RETURN_IF_ERROR(samples.check(patch));
    const Area changed = samples.find_changes(patch);
    if (changed.is_empty()) return {};
    samples.swap(patch);
    return finish(lattice.cells_with(changed, samples.area()), false, [&] { samples.swap(patch); });
  }

  /// Cells for which the field now clips the area, or the samples that borders read around it, differently.
  std::vector<SampleAt> list_recut(const Area& before) const {
    std::vector<SampleAt> recut;
    for (const SampleAt cell : lattice.cells_of(samples.area())) {
      const Area reads = lattice.area_of(cell).grown(1), now = reads.clipped(samples.area()),
                 then = reads.clipped(before);
      if (now != then) recut.push_back(cell);
    }
    return recut;
  }

  Result<void> scroll(std::int32_t by_cols, std::int32_t by_rows) {
    const Area before = samples.area();
    const auto left = samples.move(before.moved(by_cols, by_rows));
    return finish(list_recut(before), true, [&] { samples.move_back(before, left); });
  }

  const LiveOptions options;
  const Frame frame;  // the field's frame when it was made
  const std::optional<float> nodata;
  const CellRules rules;
  const CellLattice lattice;
  const BoundLadder ladder;
  FieldSamples samples;
  Shared<Writer> writer;
  mutable Mutex sampling;  // held by a change, and while samples are copied
  mutable Shared<Shown> shown;
};

LiveField::LiveField(std::unique_ptr<Impl> impl) : impl_(std::move(impl)) {}
LiveField::LiveField(LiveField&&) noexcept = default;
LiveField& LiveField::operator=(LiveField&&) noexcept = default;
LiveField::~LiveField() = default;

Result<LiveField> LiveField::create(const HeightField& field, const LiveOptions& options,
                                    std::span<const float> tolerances) try {
  SCARP_RETURN_IF_ERROR(live::check_field(field, options, tolerances));
  auto impl = std::make_unique<Impl>(field, options, !tolerances.empty());
  for (int row = 0; row < field.rows; ++row) {
    const auto row_of = [&](const float* values) {
      return std::span(values + std::ptrdiff_t{row} * field.cols, std::size_t(field.cols));
    };
    std::vector<std::span<const float>> channels;
    for (const Channel& channel : field.channels) channels.push_back(row_of(channel.samples));
    Patch patch = impl->patch_of({0, row, field.cols, 1}, row_of(field.samples),
                                 tolerances.empty() ? tolerances : row_of(tolerances.data()), channels);
    SCARP_RETURN_IF_ERROR(impl->samples.check(patch));
    impl->samples.swap(patch);
  }
  const BoundLadder& ladder = impl->ladder;
  if (options.level && (*options.level < ladder.lowest() || *options.level > ladder.highest()))
    return fail(ErrorKind::kUsage,
                fmt::format("a live field has no level {}: give the level of one of the same size", *options.level));
  Impl::Made made;
  made.level = options.level ? *options.level : first_level(field, ladder, options.max_error);
  made.least = options.level ? 0 : enough(options.max_triangles.value_or(0));
  const std::vector<SampleAt> all = impl->lattice.cells_of(impl->samples.area());
  SCARP_RETURN_IF_ERROR(impl->make_cells(all, made));
  SCARP_RETURN_IF_ERROR(impl->keep_budget(all, made));
  if (options.level) made.least = enough(options.max_triangles.value_or(0));
  impl->show(std::move(made));
  return LiveField(std::move(impl));
} catch (...) {
  return caught(ErrorKind::kMemory, "make a live field");
}

Result<void> LiveField::update(const LiveWindow& window, std::span<const float> heights,
                               std::span<const float> tolerances,
                               std::span<const std::span<const float>> channels) try {
  const Impl::Claim claim(*impl_);
  SCARP_RETURN_IF_ERROR(claim.check());
  SCARP_RETURN_IF_ERROR(live::check_window(window, impl_->samples, heights.size(), tolerances, channels));
  const std::lock_guard<Mutex> lock(impl_->sampling);
  return impl_->update(impl_->patch_of(window, heights, tolerances, channels));
} catch (...) {
  return caught(ErrorKind::kMemory, "update a live field");
}

Result<void> LiveField::set(int col, int row, float height) { return update({col, row, 1, 1}, std::span(&height, 1)); }

Result<void> LiveField::scroll(int cols, int rows) try {
  const Impl::Claim claim(*impl_);
  SCARP_RETURN_IF_ERROR(claim.check());
  SCARP_RETURN_IF_ERROR(live::check_scroll(impl_->samples.area(), cols, rows));
  if (cols == 0 && rows == 0) return {};
  const std::lock_guard<Mutex> lock(impl_->sampling);
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
  return live::join_cells(cells, impl_->lattice.side(), static_cast<int>(impl_->samples.channel_count()), area,
                          impl_->frame_of(area));
}

double LiveField::max_error() const {
  return impl_->shown.with([](const Impl::Shown& now) {
    double error = 0;
    for (const auto& cell : now.cells) error = std::max(error, cell->max_error);
    return error;
  });
}

std::uint64_t LiveField::triangle_count() const {
  return impl_->shown.with([](const Impl::Shown& now) { return now.triangles; });
}

std::int64_t LiveField::level() const {
  return impl_->shown.with([](const Impl::Shown& now) { return now.level; });
}

std::uint32_t LiveField::slot_count() const { return impl_->lattice.slot_count(); }

std::vector<float> LiveField::heights() const {
  const std::lock_guard<Mutex> lock(impl_->sampling);
  Patch whole = impl_->samples.read(impl_->samples.area());
  return std::move(whole.layers[FieldSamples::kHeights]);
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
