#include "scarp/live.h"

#include <algorithm>
#include <utility>

#include "mesh.h"

namespace scarp::wasm {

struct LiveAsked {
  double max_error, effort, cell;
  double tolerances;  ///< address of cols · rows float32; 0: none
  double col, row;    ///< LiveOptions::place
  double triangles;   ///< a budget; 0: none
  double level;       ///< NaN: found
};

struct LiveState {
  double cols, rows, col, row, max_error, triangles, slots, level;
};

struct CellView {
  double slot, version, col, row, max_error;
  double vertices, positions, triangles, corners;  ///< positions, corners: addresses
};

}  // namespace scarp::wasm

using namespace scarp::wasm;
using scarp::LiveChanges;
using scarp::LiveField;
using scarp::Result;

namespace {

int whole(double number) { return static_cast<int>(number); }

std::span<const float> values(double address, double count) {
  return {at<const float>(address), address == 0 ? 0 : static_cast<std::size_t>(count)};
}

double done(const Result<void>& result) {
  if (result) return 1;
  keep(result.error());
  return 0;
}

}  // namespace

SCARP_EXPORT(scarp_live_create) LiveField* scarp_live_create(const Field* given_field, const LiveAsked* asked) {
  return give<LiveField>([&]() -> Result<std::unique_ptr<LiveField>> {
    SCARP_TRY(const auto& field, take_field(*given_field));
    scarp::LiveOptions options;
    options.max_error = asked->max_error;
    options.effort = static_cast<scarp::Effort>(asked->effort);
    options.cell = whole(asked->cell);
    options.place = {whole(asked->col), whole(asked->row)};
    if (asked->triangles > 0) options.max_triangles = static_cast<std::uint64_t>(asked->triangles);
    if (asked->level == asked->level) options.level = static_cast<std::int64_t>(asked->level);
    SCARP_TRY(auto&& live,
              LiveField::create(field, options, values(asked->tolerances, given_field->cols * given_field->rows)));
    return std::make_unique<LiveField>(std::move(live));
  });
}
/// This function and the next return 0 on failure.
SCARP_EXPORT(scarp_live_update)
double scarp_live_update(LiveField* live, double col, double row, double cols, double rows, double heights,
                         double tolerances) {
  return guarded<double>(0, [&]() -> Result<double> {
    return done(live->update({whole(col), whole(row), whole(cols), whole(rows)}, values(heights, cols * rows),
                             values(tolerances, cols * rows)));
  });
}
SCARP_EXPORT(scarp_live_scroll) double scarp_live_scroll(LiveField* live, double cols, double rows) {
  return guarded<double>(0, [&]() -> Result<double> { return done(live->scroll(whole(cols), whole(rows))); });
}
SCARP_EXPORT(scarp_live_state) void scarp_live_state(const LiveField* live, LiveState* state) {
  const scarp::SampleAt place = live->place();
  *state = {static_cast<double>(live->cols()),
            static_cast<double>(live->rows()),
            static_cast<double>(place.col),
            static_cast<double>(place.row),
            live->max_error(),
            static_cast<double>(live->triangle_count()),
            static_cast<double>(live->slot_count()),
            static_cast<double>(live->level())};
}
SCARP_EXPORT(scarp_live_heights) double scarp_live_heights(const LiveField* live, float* out) {
  return guarded<double>(0, [&]() -> Result<double> {
    const std::vector<float> heights = live->heights();
    std::copy(heights.begin(), heights.end(), out);
    return 1;
  });
}
SCARP_EXPORT(scarp_live_mesh) WholeMesh* scarp_live_mesh(const LiveField* live) {
  return give<WholeMesh>(
      [&]() -> Result<std::unique_ptr<WholeMesh>> { return whole_of(live->mesh(), live->max_error()); });
}
SCARP_EXPORT(scarp_live_free) void scarp_live_free(LiveField* live) { delete live; }

SCARP_EXPORT(scarp_live_changes) LiveChanges* scarp_live_changes(const LiveField* live, double since) {
  return give<LiveChanges>([&]() -> Result<std::unique_ptr<LiveChanges>> {
    return std::make_unique<LiveChanges>(live->changes(static_cast<std::uint64_t>(since)));
  });
}
SCARP_EXPORT(scarp_changes_version) double scarp_changes_version(const LiveChanges* changes) {
  return static_cast<double>(changes->version);
}
SCARP_EXPORT(scarp_changes_count) double scarp_changes_count(const LiveChanges* changes) {
  return static_cast<double>(changes->cells.size());
}
SCARP_EXPORT(scarp_changes_cell) void scarp_changes_cell(const LiveChanges* changes, double index, CellView* view) {
  const scarp::LiveCell& cell = *changes->cells[static_cast<std::size_t>(index)];
  *view = {static_cast<double>(cell.slot),
           static_cast<double>(cell.version),
           static_cast<double>(cell.place.col),
           static_cast<double>(cell.place.row),
           cell.max_error,
           static_cast<double>(cell.vertex_count()),
           address_of(cell.positions.data()),
           static_cast<double>(cell.triangle_count()),
           address_of(cell.triangles.data())};
}
SCARP_EXPORT(scarp_changes_free) void scarp_changes_free(LiveChanges* changes) { delete changes; }
