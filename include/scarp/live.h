// Keep the mesh of a height field that changes many times a second: a robot's elevation map, a terrain that is dug or
// painted, the surface of a simulation. An update makes only the cells anew that it touches.
//
// Example:
//     const std::vector<float> flat(500 * 500, 0.0f), bump(50 * 50, 0.3f);
//     scarp::HeightField map;
//     map.samples = flat.data();
//     map.cols = map.rows = 500;
//     SCARP_TRY(auto&& live, scarp::LiveField::create(map, {.max_error = 0.05}));
//     SCARP_RETURN_IF_ERROR(live.update({.col = 200, .row = 100, .cols = 50, .rows = 50}, bump));
//     for (const auto& cell : live.changes().cells)
//       std::printf("slot %u: %zu triangles\n", cell->slot, cell->triangle_count());
#pragma once

#include <cstddef>
#include <cstdint>
#include <memory>
#include <optional>
#include <span>
#include <vector>

#include "scarp/height_field.h"
#include "scarp/mesh.h"
#include "scarp/options.h"
#include "scarp/result.h"

#pragma GCC visibility push(default)

namespace scarp {

struct LiveOptions {
  /// Vertical, in z units, at least 0: |mesh − sample| <= max_error at every sample, unless a budget needs more.
  double max_error = 0;
  Effort effort = Effort::kFast;  ///< kFast, kNormal or kHigh
  /// Steps between samples along the side of a cell, 8 to 254. Small cells need less time and, above fast effort, more
  /// triangles (bench/performance.md, "Live fields"). DEFAULT: 0, which is 32 with kFast, else 64.
  int cell = 0;
  /// Threads of an update that touches several cells, as Run::threads. Never changes the result.
  int threads = 1;
  /// Place of the field's first sample on the lattice of cells; a lattice line of cells runs through sample (0, 0).
  /// A field that was scrolled equals a new field at its place.
  SampleAt place = {};
  /// Budget: the largest number of triangles after every change. The cells' bounds rise and fall for it, one cell after
  /// the other, in steps of 19 %; the bounds of any two cells differ by one step at most. LiveField::max_error() is the
  /// result. Fields of 50 cells or more mostly use at least 98 % of the budget, unless fewer triangles keep max_error
  /// or reproduce the samples; where one cell has many of the triangles, it may be less. Not with tolerances. DEFAULT:
  /// none.
  std::optional<std::uint64_t> max_triangles = std::nullopt;
  /// LiveField::level() of another field of this size: equal samples then give equal meshes. The first search for the
  /// budget is then omitted, unless the mesh exceeds it. DEFAULT: found from the heights.
  std::optional<std::int64_t> level = std::nullopt;
  /// The norm over heights and channels, as Goals::norm, for fields with channels.
  Norm norm = Norm::kSum;
};

/// A rectangle of samples. Columns and rows count from the field's first sample.
struct LiveWindow {
  int col = 0, row = 0, cols = 0, rows = 0;
};

/// The mesh of a cell: LiveOptions::cell + 1 samples a side, of which the last row and column are also those of the
/// next cells; fewer where the field ends. Immutable.
struct LiveCell {
  /// The cell's place in a renderer's buffer; at most one cell of the field has it. Slots count from 0 to
  /// LiveField::slot_count() − 1 and stay the same while the field moves.
  std::uint32_t slot = 0;
  std::uint64_t version = 0;  ///< the change that made it
  SampleAt place = {};        ///< the cell's first sample, on the lattice of LiveOptions::place
  /// Three for each vertex: columns east and rows north of the first sample (so y <= 0), and the height. Whole numbers,
  /// or with kHigh eighths. Vertices on the cell's border are samples, and the neighbours have the same.
  std::vector<float> positions;
  /// Three for each triangle, counter-clockwise from above in these coordinates, in an order good for a GPU. Empty: the
  /// cell has no surface.
  std::vector<std::uint16_t> triangles;
  std::vector<float> channels;  ///< one for each vertex and channel of the field, vertex by vertex
  double max_error = 0;         ///< measured; of the norm where the field has channels

  std::size_t vertex_count() const { return positions.size() / 3; }
  std::size_t triangle_count() const { return triangles.size() / 3; }
};

struct LiveChanges {
  std::uint64_t version = 0;                           ///< for the next call of changes()
  std::vector<std::shared_ptr<const LiveCell>> cells;  ///< by slot

  std::uint64_t triangle_count() const {
    std::uint64_t count = 0;
    for (const auto& cell : cells) count += cell->triangle_count();
    return count;
  }
};

/// A height field and its mesh.
///
/// Cells lie on a fixed lattice. A cell's mesh depends on its samples, on the validity of the samples around it, and on
/// the options only; its border is a locked border (Border) whose line depends on the border's samples and the validity
/// of those next to it. So, after any sequence of changes, the mesh has the same bytes as that of a new field with the
/// final samples at the same place, for any number of threads. With a budget it also depends on level(), which stays
/// while the count of triangles keeps within its range; the new field needs the same one.
///
/// Guarantee after each change: the guarantees of simplify() hold for every cell, hence for the field; the domain is
/// that of simplify() for the whole field. Neighbouring cells share the vertices of their border: no cracks.
///
/// Samples: NaN, infinities and HeightField::nodata are voids, also in updates. Tolerances, if the field has them, are
/// bounds of samples as in Tolerances::values. Frames: affine. Fields with a source fail with kUsage.
/// Channels, if the field has them, have a value at every sample with a height; then errors are norms, as HeightField
/// and LiveOptions::norm define them.
///
/// Threads: one thread at a time may change the field; a second one gets an error. Any number may call changes(),
/// mesh(), max_error() and triangle_count() meanwhile: they see the state before or after a change, and a lock is held
/// only while pointers are copied. heights() and a change wait for each other.
///
/// Errors: kUsage for windows outside the field, arrays of the wrong size and budgets that no bound keeps; kInput for
/// heights without a channel's value; those of simplify(). The field is then unchanged.
///
/// Cost of a change: that of simplify() with Border::is_locked for each cell that it touches (four for a window of a
/// cell's size); independent of the size of the field. Where the count of triangles leaves the range of a budget, other
/// cells are made anew: mostly a few, after a change of the whole field all of them several times. That of scroll():
/// the cells along the field's border. That of changes(): O(cells of the field).
/// Memory: 4 bytes a sample (8 with tolerances), 4 more for each channel, and the cells' meshes.
class LiveField {
 public:
  /// Copies the samples, and makes all cells. `tolerances`: one for each sample, or none.
  static Result<LiveField> create(const HeightField& field, const LiveOptions& options,
                                  std::span<const float> tolerances = {});
  LiveField(LiveField&&) noexcept;
  LiveField& operator=(LiveField&&) noexcept;
  ~LiveField();

  /// Replaces the samples of a window, row by row, and their tolerances and all channels, if the field has them (none:
  /// they stay). Equal samples make no cell anew.
  Result<void> update(const LiveWindow& window, std::span<const float> heights, std::span<const float> tolerances = {},
                      std::span<const std::span<const float>> channels = {});
  /// Replaces the height of one sample.
  Result<void> set(int col, int row, float height);
  /// Moves the field over the ground, so many columns east and rows down; the samples that it then still covers stay
  /// and are not copied. The others are voids until an update, without a tolerance of their own, with channels of 0.
  Result<void> scroll(int cols, int rows);

  /// The cells that changed after the version `since`, those that became empty included; after 0 all that have a
  /// surface. A cell replaces the one that its slot had.
  LiveChanges changes(std::uint64_t since = 0) const;
  /// The cells as one mesh, with double positions, in coordinates that stay while the field moves: those of the frame
  /// that it was made with. Vertices on borders of cells are shared. Judge it in frame().
  Mesh mesh() const;
  /// The largest error of a cell.
  double max_error() const;
  std::uint64_t triangle_count() const;
  /// The state of the budget's search; meaningless without one.
  std::int64_t level() const;
  std::uint32_t slot_count() const;

  /// A copy of the current samples, row by row.
  std::vector<float> heights() const;
  /// The place of the first sample now, on the lattice of LiveOptions::place.
  SampleAt place() const;
  /// The frame of the field where it lies now: sample (0, 0) is the first. Cell positions in it:
  /// apply_affine(cell.place − place() + (x, −y)).
  Frame frame() const;
  int cols() const;
  int rows() const;

 private:
  struct Impl;
  explicit LiveField(std::unique_ptr<Impl> impl);
  std::unique_ptr<Impl> impl_;
};

}  // namespace scarp

#pragma GCC visibility pop
