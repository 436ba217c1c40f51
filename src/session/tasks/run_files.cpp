#include "session/tasks/run_files.h"

#include <algorithm>
#include <cmath>
#include <iterator>
#include <string_view>
#include <utility>

#include "scarp/mesh.h"
#include "session/options/level_options.h"
#include "session/reports/view_page.h"
#include "session/tasks/with_level.h"
#include "session/text/json.h"

namespace scarp::cli {
namespace {

using enum OptionId;

/// 1, 2 or 5 times a power of ten, with at most 20 multiples in the relief.
double round_interval(const Mesh& mesh) {
  double low = 0, high = 0;
  for (std::size_t v = 0; v < mesh.vertex_count(); ++v) {
    const double z = mesh.vertex(v)[2];
    low = v == 0 ? z : std::min(low, z);
    high = v == 0 ? z : std::max(high, z);
  }
  const double least = high > low ? (high - low) / 20 : 1;
  const double power = std::pow(10, std::floor(std::log10(least)));
  for (const double factor : {1.0, 2.0, 5.0}) {
    if (factor * power >= least) return factor * power;
  }
  return 10 * power;
}

/// Adds a page with the GLB files of this run, or with its mesh as GLB.
Result<void> add_page(const SimplifyPlan& plan, const OwnedHeightField* field, SimplifyRun& run,
                      std::vector<ReadyFile>& files) {
  std::vector<PageMesh> meshes;
  for (const ReadyFile& file : files) {
    if (std::string_view(file.kind) == "glb") meshes.push_back({file.path, file.size(), file.bytes});
  }
  if (meshes.empty()) {
    Mesh mesh = run.simplified.mesh;
    if (is_y_up(mesh)) undo_y_up(mesh);
    SCARP_TRY(auto&& glb, encode_mesh(mesh, MeshFormat::kGlb));
    meshes.push_back({plan.output, files.front().size(), std::move(glb)});
  }
  SCARP_TRY(auto&& page, make_view_page(plan.page_template, meshes.front().path, meshes, field));
  if (page.left_out) run.warnings.push_back(*page.left_out);
  files.push_back({*plan.html, "html", std::move(page.html)});
  return {};
}

/// Replaces OUTPUT, the finest level, by all levels: separate files or one.
Result<void> encode_levels(const SimplifyPlan& plan, const std::function<Result<void>(ReadyFile& file)>& encode,
                           SimplifyRun& run, std::vector<ReadyFile>& files) {
  std::vector<ReadyFile> levels{std::move(files.front())};
  for (Level& level : run.coarser) {
    levels.push_back({plan.output, plan.format.name(), {}});
    const auto encoded = with_level(run, level, [&] { return encode(levels.back()); });
    SCARP_RETURN_IF_ERROR(encoded);
  }
  files.erase(files.begin());
  if (plan.levels_in_one) {
    std::vector<std::vector<std::uint8_t>> all;
    for (ReadyFile& level : levels) all.push_back(std::move(level.bytes));
    SCARP_TRY(auto&& joined, join_glb_levels(all, plan.levels->ratio));
    levels = {{plan.output, plan.format.name(), std::move(joined)}};
  } else {
    for (std::size_t k = 0; k < levels.size(); ++k) levels[k].path = level_path(plan.output, static_cast<int>(k));
  }
  files.insert(files.begin(), std::make_move_iterator(levels.begin()), std::make_move_iterator(levels.end()));
  return {};
}

}  // namespace

Result<void> add_picture(const std::string& path, const Picture& picture, std::vector<ReadyFile>& files) {
  SCARP_TRY(std::vector<std::uint8_t> png, encode_png(picture));
  files.push_back({path, "png", std::move(png)});
  return {};
}

Result<void> add_contours(const SimplifyPlan& plan, const SimplifyRun& run, const std::string& crs,
                          std::vector<ReadyFile>& files) {
  const Mesh& mesh = run.simplified.mesh;
  SCARP_TRY(const auto interval, plan.given.number(kContourInterval));
  SCARP_TRY(const std::vector<Contour>& contours, find_contours(mesh, interval.value_or(round_interval(mesh))));
  Json features = Json::array();
  for (const Contour& contour : contours) {
    Json line = contour.points;
    if (contour.is_closed) line.push_back(contour.points.front());
    features.push_back({{"type", "Feature"},
                        {"properties", {{"elev", contour.height}}},
                        {"geometry", {{"type", "LineString"}, {"coordinates", std::move(line)}}}});
  }
  Json collection{{"type", "FeatureCollection"}};
  if (crs.starts_with("EPSG:"))
    collection["crs"] = {{"type", "name"}, {"properties", {{"name", "urn:ogc:def:crs:EPSG::" + crs.substr(5)}}}};
  collection["features"] = std::move(features);
  const std::string text = collection.dump() + "\n";
  files.push_back({*plan.given[kContoursOut], "geojson", {text.begin(), text.end()}});
  return {};
}

Result<void> finish_files(const SimplifyPlan& plan, const std::function<Result<void>(ReadyFile& file)>& encode,
                          const OwnedHeightField* field, SimplifyRun& run, std::vector<ReadyFile>& files) {
  if (plan.levels) {
    SCARP_RETURN_IF_ERROR(encode_levels(plan, encode, run, files));
  }
  if (plan.html) {
    SCARP_RETURN_IF_ERROR(add_page(plan, field, run, files));
  }
  for (const ProjectionFile& projection : run.projections) files.push_back(ready(projection));
  return {};
}

}  // namespace scarp::cli
