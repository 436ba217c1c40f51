#include <fmt/format.h>

#include <algorithm>
#include <iterator>
#include <utility>

#include "reports/report.h"
#include "reports/simplify_outcome.h"
#include "scarp/picture.h"

namespace scarp::cli {
namespace {

void add_metadata(const SimplifyPlan& plan, Outcome& outcome) {
  const Measurement& measured = outcome.simplified.measurement;
  const Frame& frame = outcome.field.frame;
  const bool keeps_degrees = plan.read.keep_degrees && plan.read.crs.empty() && frame.kind == Frame::Kind::kSource;
  add_origin(plan.canonical_command, frame.description, frame.crs, keeps_degrees ? "source" : plan.read.crs,
             outcome.simplified.mesh);
  std::map<std::string, std::string>& metadata = outcome.simplified.mesh.metadata;
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

Result<void> add_picture(const std::string& path, const Picture& picture, std::vector<ReadyFile>& files) {
  Result<std::vector<std::uint8_t>> png = encode_png(picture);
  if (!png) return tl::unexpected(std::move(png.error()));
  files.push_back({path, "png", std::move(*png)});
  return {};
}

/// The approximation in its colours, which is then compared with the image; or as a hillshade.
Result<void> add_render(const SimplifyPlan& plan, Outcome& outcome, std::vector<ReadyFile>& files) {
  const Picture rendered = draw_gouraud(outcome.field, outcome.simplified.mesh);
  if (!outcome.channels.empty()) outcome.psnr = find_psnr(rendered, draw_channels(outcome.channels.bands));
  return add_picture(*plan.render, rendered, files);
}

/// Signed errors of the heights; of an image, the norms over its bands.
Result<void> add_error_raster(const SimplifyPlan& plan, const ProgressCallback& progress, const Outcome& outcome,
                              std::vector<ReadyFile>& files) {
  JudgeOptions options;
  options.norm = plan.channels.norm;
  options.keep_errors = true;
  options.weigh = false;
  options.topology = false;
  options.cutline = outcome.cut.judged();
  options.run.threads = plan.simplify.run.threads;
  options.run.progress = progress;
  Result<Judgement> judged =
      judge_mesh(plan.channels.image ? outcome.view() : outcome.field.view(), outcome.simplified.mesh, options);
  if (!judged) return tl::unexpected(std::move(judged.error()));
  const std::vector<float> errors =
      take_error_raster(std::move(*judged), plan.channels.image ? ErrorsOf::kNorms : ErrorsOf::kHeights);
  Result<std::vector<std::uint8_t>> tiff =
      encode_raster({errors, outcome.field.cols, outcome.field.rows, &outcome.as_read}, RasterFormat::kGeoTiff);
  if (!tiff) return tl::unexpected(std::move(tiff.error()));
  files.push_back({*plan.error_raster, "tif", std::move(*tiff)});
  return {};
}

/// The sheets of the print, with the terrain's metadata.
std::vector<Mesh> named_solids(const Outcome& outcome) {
  std::vector<Mesh> solids;
  const bool is_whole = outcome.print->sheets.size() == 1 && outcome.print->empty_sheets == 0;
  for (const Sheet& sheet : outcome.print->sheets) {
    solids.push_back(sheet.mesh);
    solids.back().metadata.insert(outcome.simplified.mesh.metadata.begin(), outcome.simplified.mesh.metadata.end());
    solids.back().metadata["name"] = is_whole ? "terrain" : fmt::format("r{}-c{}", sheet.row, sheet.column);
  }
  return solids;
}

/// A file for each sheet; the first file is OUTPUT's, whose place the first of them takes.
Result<void> encode_sheets(const SimplifyPlan& plan, const Outcome& outcome, std::vector<ReadyFile>& files) {
  const std::vector<std::string> paths = print_paths(plan, *outcome.print);
  const std::vector<Mesh> solids = named_solids(outcome);
  std::vector<ReadyFile> sheets;
  for (std::size_t k = 0; k < solids.size(); ++k) {
    Result<std::vector<std::uint8_t>> bytes = encode_mesh(solids[k], plan.format.mesh);
    if (!bytes) return tl::unexpected(std::move(bytes.error()));
    sheets.push_back({paths[k], plan.format.name(), std::move(*bytes)});
  }
  files.erase(files.begin());
  files.insert(files.begin(), std::make_move_iterator(sheets.begin()), std::make_move_iterator(sheets.end()));
  return {};
}

/// The bytes of OUTPUT.
Result<std::vector<std::uint8_t>> encode_output(const SimplifyPlan& plan, const Outcome& outcome) {
  const Mesh& mesh = outcome.simplified.mesh;
  if (outcome.print) return encode_3mf(named_solids(outcome));
  if (plan.format.kind != OutputKind::kDem) return encode_as(plan.format, mesh);
  const Result<std::vector<float>> heights = resample(outcome.field, mesh, plan.simplify.run.threads);
  if (!heights) return tl::unexpected(heights.error());
  return encode_raster({*heights, outcome.field.cols, outcome.field.rows, &outcome.as_read}, plan.format.raster);
}

}  // namespace

Result<std::vector<ReadyFile>> encode_files(const SimplifyPlan& plan, const ProgressCallback& progress,
                                            Outcome& outcome) {
  std::vector<ReadyFile> files{{plan.output, plan.format.name(), {}}};
  // Pictures and errors show the terrain, before it is closed into a solid.
  Mesh& mesh = outcome.simplified.mesh;
  if (!outcome.channels.empty()) color_by_channels(mesh, outcome.channels.bands);
  Result<void> added;
  if (plan.preview) added = add_picture(*plan.preview, draw_preview(outcome.field, mesh), files);
  if (added && plan.render) added = add_render(plan, outcome, files);
  if (added && plan.error_raster) added = add_error_raster(plan, progress, outcome, files);
  if (added) added = finish_mesh(plan, outcome);
  if (!added) return tl::unexpected(std::move(added.error()));
  add_metadata(plan, outcome);
  if (outcome.print && plan.format.mesh != MeshFormat::k3mf) {
    if (auto encoded = encode_sheets(plan, outcome, files); !encoded) return tl::unexpected(std::move(encoded.error()));
    return files;
  }
  Result<std::vector<std::uint8_t>> output = encode_output(plan, outcome);
  if (!output) return tl::unexpected(std::move(output.error()));
  files.front().bytes = std::move(*output);
  return files;
}

}  // namespace scarp::cli
