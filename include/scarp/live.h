// Update the mesh of a height field that changes many times a second: a robot's elevation map, a terrain that is dug or
// painted, the surface of a simulation. An update remakes only the cells that it touches.
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
  /// Vertical error bound in z units, at least 0: |mesh − sample| <= max_error at every sample, unless a budget
  /// requires larger errors.
  double max_error = 0;
  Effort effort = Effort::kFast;  ///< kFast, kNormal or kHigh
  /// Steps between samples along the side of a cell, 8 to 254. Small cells need less time and, with efforts above
  /// kFast, more triangles (bench/performance.md, "Live fields"). DEFAULT: 0, which means 32 with kFast, else 64.
  int cell = 0;
  /// Threads of an update that touches several cells, as Run::threads. Never changes the result.
  int threads = 1;
  /// Place of the field's first sample on the lattice of cells, in samples; borders of cells run through (0, 0).
  /// A scrolled field equals a new field at the same place.
  SampleAt place = {};
  /// Budget: the max number of triangles after every change. The cells' error bounds follow the budget: they rise and
  /// fall in steps of 19 %, one cell after the other, and differ by at most one step. LiveField::max_error() returns
  /// the resulting error. Fields of 50 cells or more usually use at least 98 % of the budget, but less if one cell has
  /// many of the triangles. Fewer triangles are used if they satisfy max_error or reproduce the samples. Not allowed
  /// with tolerances. DEFAULT: none.
  std::optional<std::uint64_t> max_triangles = std::nullopt;
  /// LiveField::level() of another field of the same size. Equal samples then have equal meshes, and the first search
  /// for the budget is omitted, unless the mesh exceeds the budget. Needs a budget. DEFAULT: found from the heights.
  std::optional<std::int64_t> level = std::nullopt;
  /// The norm over heights and channels, as Goals::norm, for fields with channels.
  Norm norm = Norm::kSum;
};

/// A rectangle of samples. Columns and rows count from the field's first sample.
struct LiveWindow {
  int col = 0, row = 0, cols = 0, rows = 0;
};

/// The mesh of a cell. A cell has LiveOptions::cell + 1 samples a side, fewer where the field ends. Neighbouring cells
/// share the row or column of samples between them. Immutable.
struct LiveCell {
  /// The cell's index in a renderer's buffer, 0 … LiveField::slot_count() − 1: unique in the field, and unchanged while
  /// the field moves.
  std::uint32_t slot = 0;
  std::uint64_t version = 0;  ///< number of the change that made this mesh
  SampleAt place = {};        ///< the cell's first sample, on the lattice of LiveOptions::place
  /// Three numbers for each vertex: columns east and rows north of the first sample (so y <= 0), and the height.
  /// Columns and rows are whole numbers or, with kHigh, multiples of 1/8. Vertices on the cell's border are samples,
  /// and shared with the neighbours.
  std::vector<float> positions;
  /// Three indices for each triangle, counter-clockwise from above in these coordinates, ordered for a GPU. Empty: the
  /// cell has no surface.
  std::vector<std::uint16_t> triangles;
  std::vector<float> channels;  ///< one value for each vertex and channel of the field, vertex by vertex
  double max_error = 0;         ///< measured max error; with channels, that of the norm

  std::size_t vertex_count() const { return positions.size() / 3; }
  std::size_t triangle_count() const { return triangles.size() / 3; }
};

struct LiveChanges {
  std::uint64_t version = 0;                           ///< for the next call of changes()
  std::vector<std::shared_ptr<const LiveCell>> cells;  ///< sorted by slot

  std::uint64_t triangle_count() const {
    std::uint64_t count = 0;
    for (const auto& cell : cells) count += cell->triangle_count();
    return count;
  }
};

/// Cells lie on a fixed lattice. A cell's mesh depends only on its samples, the validity of the samples around the
/// cell, and the options. A cell's border is a locked border (Border): its line depends only on the border's samples
/// and the validity of adjacent samples. So, after any sequence of changes and for any number of threads, the mesh
/// equals, byte for byte, that of a new field with the final samples at the same place. With a budget, the new field
/// also needs the same level(). The level does not change while the number of triangles is within a certain range.
///
/// After each change, the guarantees of simplify() hold for every cell, and so for the field. The domain is that of
/// simplify() for the whole field. Neighbouring cells share the vertices of their common border, so there are no
/// cracks.
///
/// NaN, infinities and HeightField::nodata are voids, also in updates. Tolerances are bounds of samples, as in
/// Tolerances::values. The frame is affine. Fields with a source fail with kUsage.
/// Channels have a value at every sample with a height. With channels, errors are norms as defined by HeightField and
/// LiveOptions::norm.
///
/// Threads: one thread at a time may change the field; a second thread gets an error. Meanwhile, any number of threads
/// may call changes(), mesh(), max_error() and triangle_count(). These calls see the state before or after a change,
/// and hold a lock only while they copy pointers. heights() and a change wait for each other.
///
/// Errors: kUsage for windows outside the field, arrays of the wrong size, and budgets that no error bound satisfies;
/// kInput for heights without a channel's value; and the errors of simplify(). After an error, the field is unchanged.
///
/// Cost of a change: that of simplify() with Border::is_locked for each cell that the change touches (four for a window
/// of a cell's size), independent of the size of the field. If the number of triangles leaves its range for the budget,
/// other cells are also remade: usually a few, but after a change of the whole field, all cells several times. scroll()
/// remakes the cells along the field's border. changes() costs O(cells of the field).
/// Memory: 4 bytes a sample (8 with tolerances), 4 more for each channel, and the cells' meshes.
class LiveField {
 public:
  /// Copies the samples, and makes all cells. `tolerances`: one for each sample, or none.
  static Result<LiveField> create(const HeightField& field, const LiveOptions& options,
                                  std::span<const float> tolerances = {});
  LiveField(LiveField&&) noexcept;
  LiveField& operator=(LiveField&&) noexcept;
  ~LiveField();

  /// Replaces the samples of a window, row by row. Also replaces their tolerances and all channels, unless these
  /// arguments are empty. Unchanged samples remake no cell.
  Result<void> update(const LiveWindow& window, std::span<const float> heights, std::span<const float> tolerances = {},
                      std::span<const std::span<const float>> channels = {});
  /// Replaces the height of one sample.
  Result<void> set(int col, int row, float height);
  /// Moves the field over the ground by `cols` columns east and `rows` rows down. Samples that the field still covers
  /// do not change and are not copied. Until an update, new samples are voids without tolerances, and their channels
  /// are 0.
  Result<void> scroll(int cols, int rows);

  /// Returns the cells that changed after the version `since`, including those that became empty; for 0, all cells with
  /// a surface. A cell replaces the previous cell of its slot.
  LiveChanges changes(std::uint64_t since = 0) const;
  /// All cells as one mesh with double positions, in the frame with which the field was created, even after scroll().
  /// Vertices on borders of cells are shared. Use frame() to measure this mesh.
  Mesh mesh() const;
  /// The largest error of all cells.
  double max_error() const;
  std::uint64_t triangle_count() const;
  /// The state of the search for the budget; meaningless without a budget.
  std::int64_t level() const;
  std::uint32_t slot_count() const;

  /// A copy of the current samples, row by row.
  std::vector<float> heights() const;
  /// The current place of the first sample, on the lattice of LiveOptions::place.
  SampleAt place() const;
  /// The frame of the field at its current place, where (0, 0) is the field's first sample. Positions of a cell in this
  /// frame: apply_affine(cell.place − place() + (x, −y)).
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
