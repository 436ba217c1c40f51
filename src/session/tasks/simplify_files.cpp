#include "session/tasks/simplify_files.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <functional>
#include <iterator>
#include <memory>
#include <utility>

#include "scarp/picture.h"
#include "session/inputs/memory.h"
#include "session/inputs/zones.h"
#include "session/reports/pictures.h"
#include "session/tasks/mesh_output.h"
#include "session/tasks/run_files.h"
#include "session/tasks/simplify_work.h"
#include "session/text/json_text.h"

namespace scarp::cli {
namespace {

using enum OptionId;

/// The --crs that measure needs.
std::string crs_option(const SimplifyPlan& plan, const Frame& frame) {
  if (!plan.read.crs.empty()) return plan.read.crs;
  if (frame.kind == Frame::Kind::kGrid) return "grid";
  return frame.kind == Frame::Kind::kLocal ? "local" : "source";
}

void add_metadata(const SimplifyPlan& plan, Outcome& outcome) {
  const Measurement& measured = outcome.simplified.measurement;
  const Frame& frame = outcome.field.frame;
  add_origin(plan.canonical_command, frame.description, frame.crs, crs_option(plan, frame), outcome.simplified.mesh);
  std::map<std::string, std::string>& metadata = outcome.simplified.mesh.metadata;
  if (const auto place = place_in_source(frame, outcome.as_read, outcome.field.rows)) {
    metadata["origin"] = Json(place->origin()).dump();
    if (!place->crs.empty()) metadata["origin_crs"] = place->crs;
    metadata["to_source"] = Json(place->to_source).dump();
  }
  if (frame.space) metadata["to_earth"] = Json(frame.space->to_earth()).dump();
  if (outcome.as_read.z_scale != 1) metadata["z_scale"] = Json(outcome.as_read.z_scale).dump();
  if (plan.read.z_offset != 0) metadata["z_offset"] = Json(plan.read.z_offset).dump();
  if (plan.read.cell_size) metadata["cell_size"] = Json(*plan.read.cell_size).dump();
  if (!outcome.as_read.unit.empty()) metadata["unit"] = outcome.as_read.unit;
  Json error;
  error["asked"] = outcome.asked ? Json(*outcome.asked) : Json(nullptr);
  if (!plan.channels.image) error["max_error"] = measured.max_error;
  if (outcome.print) error["max_error"] = outcome.print->max_error;
  if (outcome.field.sample_rounding > 0) error["sample_rounding"] = outcome.field.sample_rounding;
  if (!plan.channels.image) error["rmse"] = measured.rmse;
  error["samples"] = measured.samples;
  if (!outcome.channels.empty()) error["combined_max_error"] = outcome.simplified.combined_max_error;
  if (outcome.companions.has_weights()) {
    error["weighted_max_error"] = outcome.simplified.weighted_max_error;
  }
  if (outcome.simplified.ignored > 0) error["ignored"] = outcome.simplified.ignored;
  if (outcome.bounded) error["bounded_max_error"] = outcome.bounded->value;
  metadata["error"] = error.dump();
}

/// Draws the approximation in its colours, which are compared with the image, or as a hillshade.
Result<void> add_render(const SimplifyPlan& plan, Outcome& outcome, std::vector<ReadyFile>& files) {
  const Picture rendered = draw_gouraud(outcome.field, outcome.simplified.mesh);
  if (!outcome.channels.empty()) outcome.psnr = find_psnr(rendered, draw_channels(outcome.channels.bands));
  return add_picture(*plan.render, rendered, files);
}

Result<void> add_preview(const SimplifyPlan& plan, const Outcome& outcome, std::vector<ReadyFile>& files) {
  const Mesh& mesh = outcome.simplified.mesh;
  const int side = picture_side(outcome.field, memory_of(plan, outcome), mesh.vertex_count());
  SCARP_TRY(const Picture& picture, draw_preview(outcome.field, mesh, preview_options(outcome, side)));
  return add_picture(*plan.preview, picture, files);
}

/// A file whose rows are written as `make` delivers them.
Result<std::shared_ptr<RasterFile>> write_rows(
    const SimplifyPlan& plan, const std::string& path, const Outcome& outcome,
    const std::function<Result<void>(const std::function<void(int row, std::span<const float> values)>& on_row)>&
        make) {
  SCARP_TRY(auto&& raster,
            RasterFile::create(path, outcome.field.cols, outcome.field.rows, &outcome.as_read, plan.overwrite));
  Result<void> written;
  const auto made = make([&](int, std::span<const float> values) {
    if (written) written = raster.add(values);
  });
  SCARP_RETURN_IF_ERROR(made);
  if (written) written = raster.finish();
  SCARP_RETURN_IF_ERROR(written);
  return std::make_shared<RasterFile>(std::move(raster));
}

/// Judges the heights again and writes each row immediately.
Result<void> add_streamed_errors(const SimplifyPlan& plan, judge::JudgeOptions options, const Outcome& outcome,
                                 std::vector<ReadyFile>& files) {
  auto raster = write_rows(plan, *plan.error_raster, outcome, [&](const auto& on_row) -> Result<void> {
    options.on_row = on_row;
    const auto judged = judge::judge_mesh(outcome.field.view(), outcome.simplified.mesh, options);
    return judged ? Result<void>() : tl::unexpected(judged.error());
  });
  SCARP_RETURN_IF_ERROR(raster);
  files.push_back({*plan.error_raster, "tif", {}, std::move(*raster)});
  return {};
}

/// Writes signed errors of heights, or for an image the norms over its bands.
Result<void> add_error_raster(const SimplifyPlan& plan, const ProgressCallback& progress, const Outcome& outcome,
                              std::vector<ReadyFile>& files) {
  judge::JudgeOptions options;
  options.norm = plan.channels.norm;
  options.weigh = false;
  options.topology = false;
  options.cutline = outcome.cut.judged();
  options.run.threads = plan.simplify.run.threads;
  options.run.progress = progress;
  if (outcome.field.source) return add_streamed_errors(plan, options, outcome, files);
  options.keep_errors = true;
  SCARP_TRY(judge::Judgement judged, judge::judge_mesh(plan.channels.image ? outcome.view() : outcome.field.view(),
                                                       outcome.simplified.mesh, options));
  const std::vector<float> errors = judge::take_error_raster(
      std::move(judged), plan.channels.image ? judge::ErrorsOf::kNorms : judge::ErrorsOf::kHeights);
  SCARP_TRY(std::vector<std::uint8_t> tiff,
            encode_raster({errors, outcome.field.cols, outcome.field.rows, &outcome.as_read}, RasterFormat::kGeoTiff));
  files.push_back({*plan.error_raster, "tif", std::move(tiff)});
  return {};
}

/// Encodes the approximation on the raster's grid.
Result<std::vector<std::uint8_t>> encode_dem(const SimplifyPlan& plan, const Outcome& outcome) {
  const Mesh& mesh = outcome.simplified.mesh;
  SCARP_TRY(const std::vector<float>& heights, resample(outcome.field, mesh, plan.simplify.run.threads));
  return encode_raster({heights, outcome.field.cols, outcome.field.rows, &outcome.as_read}, plan.format.raster);
}

/// True if OUTPUT needs samples in addition to the mesh.
bool reads_samples(const SimplifyPlan& plan) {
  return plan.format.kind == OutputKind::kDem || plan.images.normal_map.has_value() || plan.html.has_value();
}

Result<void> encode_output(const SimplifyPlan& plan, const Outcome& outcome, ReadyFile& file) {
  const Mesh& mesh = outcome.simplified.mesh;
  const bool is_dem = plan.format.kind == OutputKind::kDem;
  if (is_dem && outcome.field.source) {
    auto raster = write_rows(plan, plan.output, outcome, [&](const auto& on_row) {
      return resample_rows(outcome.field, mesh, on_row, plan.simplify.run.threads);
    });
    SCARP_RETURN_IF_ERROR(raster);
    file.raster = std::move(*raster);
    return {};
  }
  SCARP_TRY(const auto& glb, glb_options(plan, outcome));
  EncodeOptions options{.double_positions = plan.doubles};
  if (plan.given.first_of({kMaterials, kNodeStrings})) options.zones = &outcome.zones;
  SCARP_TRY(file.bytes, outcome.print ? encode_3mf(named_solids(plan, outcome))
                        : is_dem      ? encode_dem(plan, outcome)
                                      : encode_as(plan.format, mesh, glb, options));
  return {};
}

}  // namespace

Result<GlbOptions> glb_options(const SimplifyPlan& plan, const Outcome& outcome) {
  const std::array<double, 6>& affine = outcome.field.frame.affine;
  GlbOptions glb{.compress = plan.compress, .cell = {affine[1], affine[5]}, .threads = plan.simplify.run.threads};
  SCARP_RETURN_IF_ERROR(add_drape(plan, outcome.drape, glb));
  if (plan.images.normal_map) {
    SCARP_TRY(const auto& normals, draw_normal_map(outcome.field, *plan.images.normal_map));
    SCARP_TRY(auto&& bytes, encode_png(normals));
    glb.normal_map = {std::move(bytes), "image/png"};
  }
  return glb;
}

Result<void> complete_mesh(const SimplifyPlan& plan, Outcome& outcome) {
  SCARP_RETURN_IF_ERROR(finish_mesh(plan, outcome));
  add_metadata(plan, outcome);
  return {};
}

Result<std::vector<ReadyFile>> encode_files(const SimplifyPlan& plan, const ProgressCallback& progress,
                                            Outcome& outcome) {
  std::vector<ReadyFile> files{{plan.output, plan.format.name(), {}}};
  // Pictures and errors show the terrain, before it is closed into a solid.
  Mesh& mesh = outcome.simplified.mesh;
  if (!outcome.channels.empty()) color_by_channels(mesh, outcome.channels.bands);
  Result<void> added;
  if (plan.preview) added = add_preview(plan, outcome, files);
  if (added && plan.render) added = add_render(plan, outcome, files);
  if (added && plan.error_raster) added = add_error_raster(plan, progress, outcome, files);
  if (added && plan.given.has(kContoursOut)) added = add_contours(plan, outcome, outcome.field.frame.crs, files);
  if (added) added = complete_mesh(plan, outcome);
  SCARP_RETURN_IF_ERROR(added);
  if (outcome.print && plan.format.mesh != MeshFormat::k3mf) {
    SCARP_RETURN_IF_ERROR(encode_print_tiles(plan, outcome, files));
    return files;
  }
  if (plan.given.first_of({kMaterials, kNodeStrings}))
    outcome.zones = find_zones(outcome.zone_plan, outcome.field.frame, mesh);
  turn_as_planned(plan, mesh);
  // Samples may need more memory than the mesh and its file.
  if (!reads_samples(plan)) std::vector<float>().swap(outcome.field.samples);
  SCARP_RETURN_IF_ERROR(encode_output(plan, outcome, files.front()));
  const auto encode = [&](ReadyFile& file) -> Result<void> {
    add_metadata(plan, outcome);
    turn_as_planned(plan, outcome.simplified.mesh);
    return encode_output(plan, outcome, file);
  };
  SCARP_RETURN_IF_ERROR(finish_files(plan, encode, &outcome.field, outcome, files));
  return files;
}

}  // namespace scarp::cli
