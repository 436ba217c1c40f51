#include "scarp/live.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstring>
#include <memory>
#include <span>
#include <utility>

#include "door.h"
#include "inputs.h"
#include "mesh.h"
#include "session/tasks/mesh_output.h"

struct scarp_live {
  scarp::LiveField field;
  scarp::Frame made_in;
};

struct scarp_changes {
  scarp::LiveChanges changes;
};

namespace scarp::door {
namespace {

scarp_status refuse(const char* what) { return report(ErrorKind::kUsage, std::string(what) + " is a null pointer"); }

scarp_status refuse_index(uint64_t index, const scarp_changes& changes) {
  return report(ErrorKind::kUsage,
                "there is no cell " + std::to_string(index) + " among " + std::to_string(changes.changes.cells.size()));
}

scarp_status report_if_failed(const Result<void>& done) { return done ? SCARP_OK : report(done.error()); }

Result<LiveOptions> read_options(const scarp_live_options& asked) {
  constexpr Effort kEfforts[] = {Effort::kFast, Effort::kNormal, Effort::kHigh};
  if (asked.effort < 0 || asked.effort > 2)
    return fail(ErrorKind::kUsage,
                "the effort of a live field is 0 (fast), 1 (normal) or 2 (high), not " + std::to_string(asked.effort));
  LiveOptions options{asked.max_error, kEfforts[asked.effort], asked.cell, asked.threads, {asked.col, asked.row}};
  if (asked.max_triangles > 0) options.max_triangles = asked.max_triangles;
  if (asked.level != nullptr) options.level = *asked.level;
  return options;
}

std::span<const float> samples_of(const float* values, std::int64_t cols, std::int64_t rows) {
  const bool is_window = values != nullptr && cols > 0 && rows > 0;
  return {values, is_window ? static_cast<std::size_t>(cols * rows) : 0};
}

}  // namespace
}  // namespace scarp::door

using namespace scarp::door;

extern "C" {

void scarp_live_options_init(scarp_live_options* options, uint32_t struct_size) {
  if (options == nullptr || !is_struct_size(struct_size)) return;
  scarp_live_options all{};
  all.struct_size = struct_size;
  all.threads = 1;
  std::memcpy(options, &all, std::min<std::size_t>(struct_size, sizeof all));
}

scarp_status scarp_live_create(const scarp_field* given, const scarp_live_options* options, scarp_live** out) {
  return guarded([&]() -> scarp_status {
    if (out == nullptr) return refuse("the place for the live field");
    *out = nullptr;
    if (options == nullptr) return refuse("the pointer to the options");
    const scarp_live_options asked = known(options, scarp_live_options_init);
    const auto settings = read_options(asked);
    if (!settings) return report(settings.error());
    const LentInputs inputs(given, known<scarp_options>(nullptr, scarp_options_init));
    if (auto checked = inputs.check(); !checked) return report(checked.error());
    // Values may all be missing: a map may have no height yet.
    const auto field =
        scarp::read_height_field(inputs.name(), {.default_frame = scarp::DefaultFrame::kMetric, .as_values = true});
    if (!field) return report(field.error());
    scarp::HeightField view = field->view();
    if (!std::isnan(given->nodata)) view.nodata = static_cast<float>(given->nodata);
    auto live = scarp::LiveField::create(view, *settings, samples_of(asked.tolerance, field->cols, field->rows));
    if (!live) return report(live.error());
    *out = new scarp_live{std::move(*live), field->frame};
    return SCARP_OK;
  });
}

scarp_status scarp_live_update(scarp_live* live, int32_t col, int32_t row, int32_t cols, int32_t rows,
                               const float* heights, const float* tolerance) {
  return guarded([&]() -> scarp_status {
    if (live == nullptr) return refuse("the live field");
    if (heights == nullptr) return refuse("the pointer to the heights");
    return report_if_failed(
        live->field.update({col, row, cols, rows}, samples_of(heights, cols, rows), samples_of(tolerance, cols, rows)));
  });
}

scarp_status scarp_live_scroll(scarp_live* live, int32_t cols, int32_t rows) {
  return guarded([&]() -> scarp_status {
    if (live == nullptr) return refuse("the live field");
    return report_if_failed(live->field.scroll(cols, rows));
  });
}

scarp_status scarp_live_changes(const scarp_live* live, uint64_t since, scarp_changes** out) {
  return guarded([&]() -> scarp_status {
    if (out == nullptr) return refuse("the place for the changes");
    *out = nullptr;
    if (live == nullptr) return refuse("the live field");
    *out = new scarp_changes{live->field.changes(since)};
    return SCARP_OK;
  });
}

uint64_t scarp_changes_version(const scarp_changes* changes) { return changes->changes.version; }
uint64_t scarp_changes_count(const scarp_changes* changes) { return changes->changes.cells.size(); }

scarp_status scarp_changes_cell(const scarp_changes* changes, uint64_t index, scarp_live_cell* out) {
  return guarded([&]() -> scarp_status {
    if (changes == nullptr || out == nullptr) return refuse("the changes, or the place for a cell,");
    if (index >= changes->changes.cells.size()) return refuse_index(index, *changes);
    const scarp::LiveCell& cell = *changes->changes.cells[index];
    scarp_live_cell all{};
    all.slot = cell.slot;
    all.version = cell.version;
    all.col = cell.place.col;
    all.row = cell.place.row;
    all.vertices = static_cast<uint32_t>(cell.vertex_count());
    all.triangles = static_cast<uint32_t>(cell.triangle_count());
    all.positions = cell.positions.data();
    all.indices = cell.triangles.data();
    all.max_error = cell.max_error;
    hand_out(all, out);
    return SCARP_OK;
  });
}

scarp_status scarp_changes_cut(const scarp_changes* changes, uint64_t index, scarp_changes** out) {
  return guarded([&]() -> scarp_status {
    if (changes == nullptr || out == nullptr) return refuse("the changes, or the place for a part of them,");
    *out = nullptr;
    if (index >= changes->changes.cells.size()) return refuse_index(index, *changes);
    *out = new scarp_changes{{changes->changes.version, {changes->changes.cells[index]}}};
    return SCARP_OK;
  });
}

void scarp_changes_free(scarp_changes* changes) { delete changes; }

scarp_status scarp_live_mesh(const scarp_live* live, scarp_mesh** out) {
  return guarded([&]() -> scarp_status {
    if (out == nullptr) return refuse("the place for the mesh");
    *out = nullptr;
    if (live == nullptr) return refuse("the live field");
    const scarp::Frame& frame = live->made_in;
    auto mesh = std::make_unique<scarp_mesh>();
    mesh->mesh = live->field.mesh();
    // A field that moved is judged at its current place, by its geotransform.
    const bool has_moved = live->field.frame().affine != frame.affine;
    const bool is_local = frame.kind == scarp::Frame::Kind::kLocal;
    const char* crs = has_moved                                 ? "source"
                      : frame.kind == scarp::Frame::Kind::kGrid ? "grid"
                      : is_local                                ? "local"
                                                                : "source";
    scarp::cli::add_origin("scarp live", frame.description, frame.crs, crs, mesh->mesh);
    *out = mesh.release();
    return SCARP_OK;
  });
}

scarp_status scarp_live_heights(const scarp_live* live, float* out) {
  return guarded([&]() -> scarp_status {
    if (live == nullptr || out == nullptr) return refuse("the live field, or the place for its heights,");
    const std::vector<float> heights = live->field.heights();
    std::copy(heights.begin(), heights.end(), out);
    return SCARP_OK;
  });
}

void scarp_live_place(const scarp_live* live, int32_t* col, int32_t* row) {
  const scarp::SampleAt place = live->field.place();
  *col = place.col;
  *row = place.row;
}

void scarp_live_geotransform(const scarp_live* live, double out[6]) {
  const std::array<double, 6> to = live->field.frame().affine;  // for centres
  std::copy(to.begin(), to.end(), out);
  out[0] -= (to[1] + to[2]) / 2;
  out[3] -= (to[4] + to[5]) / 2;
}

double scarp_live_max_error(const scarp_live* live) { return live->field.max_error(); }
uint64_t scarp_live_triangle_count(const scarp_live* live) { return live->field.triangle_count(); }
int64_t scarp_live_level(const scarp_live* live) { return live->field.level(); }
uint32_t scarp_live_slot_count(const scarp_live* live) { return live->field.slot_count(); }
void scarp_live_free(scarp_live* live) { delete live; }

}  // extern "C"
