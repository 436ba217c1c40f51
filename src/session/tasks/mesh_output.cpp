#include "session/tasks/mesh_output.h"

#include <fmt/format.h>

#include <algorithm>
#include <cstddef>
#include <iterator>
#include <string_view>
#include <utility>

#include "scarp/picture.h"
#include "scarp/version.h"

namespace scarp::cli {

Result<void> check_unit_of_frame(const OutputFormat& format, double metres) {
  if (format.heights_in() != HeightsIn::kMetres || metres == 0 || metres == 1) return {};
  return fail(
      ErrorKind::kUsage,
      fmt::format("{} is in metres by its specification, and x and y in the CRS of --crs are in units of {:.10g} m: "
                  "leave --crs out, for metres around the raster's centre, or choose a CRS in metres",
                  format.title(), metres));
}

Result<void> check_crs_of(const OutputFormat& format, const std::string& crs, const std::string& unit) {
  if (!format.is_mesh() || format.holds_solids_only()) return {};
  Mesh sample;
  sample.positions = {0, 0, 0, 1, 0, 0, 0, 1, 0};
  sample.triangles = {0, 1, 2};
  if (!crs.empty()) sample.metadata["crs"] = crs;
  if (!unit.empty()) sample.metadata["unit"] = unit;
  auto bytes = encode_mesh(sample, format.mesh);
  if (!bytes) return fail(ErrorKind::kUsage, std::move(bytes.error().message));
  return {};
}

Result<void> close_with_base(Mesh& mesh, double base) {
  if (add_base(mesh, base)) return {};
  double lowest = mesh.vertex(0)[2];
  for (std::size_t v = 1; v < mesh.vertex_count(); ++v) lowest = std::min(lowest, mesh.vertex(v)[2]);
  return fail(ErrorKind::kUsage, fmt::format("{} {:.10g} is not below the lowest vertex, which is at {:.10g}",
                                             OptionId::kBase, base, lowest));
}

Result<void> finish_mesh(const SimplifyPlan& plan, SimplifyRun& run) {
  Mesh& mesh = run.simplified.mesh;
  run.vertices = mesh.vertex_count();
  run.triangles = mesh.triangle_count();
  if (!plan.base) return {};
  SCARP_RETURN_IF_ERROR(close_with_base(mesh, *plan.base));
  run.solid_vertices = mesh.vertex_count();
  run.solid_triangles = mesh.triangle_count();
  return {};
}

void add_origin(const std::string& command, const std::string& frame, const std::string& crs,
                const std::string& crs_option, Mesh& mesh) {
  mesh.metadata["generator"] = fmt::format("Scarp {}", version());
  mesh.metadata["command"] = command;
  mesh.metadata["frame"] = frame;
  if (!crs.empty()) mesh.metadata["crs"] = crs;
  if (!crs_option.empty()) mesh.metadata["crs_option"] = crs_option;
}

void turn_as_planned(const SimplifyPlan& plan, Mesh& mesh) {
  if (plan.is_y_up) turn_y_up(mesh);
}

Result<void> add_drape(const SimplifyPlan& plan, const Picture& image, GlbOptions& glb) {
  if (!plan.images.drape) return {};
  SCARP_TRY(auto&& bytes, encode_image(image, plan.images.drape_format));
  glb.base_color = {std::move(bytes), mime_type_of(plan.images.drape_format)};
  return {};
}

Result<std::vector<std::uint8_t>> encode_as(const OutputFormat& format, const Mesh& mesh, const GlbOptions& glb,
                                            const EncodeOptions& options) {
  if (format.kind == OutputKind::kSvg) return encode_svg(mesh);
  if (format.kind == OutputKind::kEps) return encode_eps(mesh);
  return format.is_glb() ? encode_glb(mesh, glb) : encode_mesh(mesh, format.mesh, options);
}

void take_print(const SimplifyPlan& plan, Print print, SimplifyRun& run) {
  run.print = std::move(print);
  // The mesh may be smaller than the samples' extent, and its print at a larger scale than estimated.
  if (plan.solid->max_error && run.asked)
    run.asked = std::min(*run.asked, *plan.solid->max_error / run.print->placement.scale[2]);
}

Error name_print(Error error) {
  if (error.message.starts_with("base=")) error.message.insert(0, name_of(OptionId::kSolid) + " ");
  constexpr std::string_view kPrintTiles = "print tiles:";
  if (error.message.starts_with(kPrintTiles))
    error.message.replace(0, kPrintTiles.size(), name_of(OptionId::kSplit) + ":");
  return error;
}

std::vector<Mesh> named_solids(const SimplifyPlan& plan, const SimplifyRun& run) {
  std::vector<Mesh> solids;
  const bool is_whole = run.print->tiles.size() == 1 && run.print->empty_tiles == 0;
  for (const PrintTile& tile : run.print->tiles) {
    solids.push_back(tile.mesh);
    solids.back().metadata.insert(run.simplified.mesh.metadata.begin(), run.simplified.mesh.metadata.end());
    turn_as_planned(plan, solids.back());
    solids.back().metadata["name"] = is_whole ? "terrain" : fmt::format("r{}-c{}", tile.row, tile.column);
  }
  return solids;
}

Result<void> encode_print_tiles(const SimplifyPlan& plan, const SimplifyRun& run, std::vector<ReadyFile>& files) {
  const std::vector<std::string> paths = print_paths(plan, *run.print);
  const std::vector<Mesh> solids = named_solids(plan, run);
  std::vector<ReadyFile> tiles;
  for (std::size_t k = 0; k < solids.size(); ++k) {
    SCARP_TRY(std::vector<std::uint8_t> bytes,
              encode_mesh(solids[k], plan.format.mesh, {.double_positions = plan.doubles}));
    tiles.push_back({paths[k], plan.format.name(), std::move(bytes)});
  }
  files.erase(files.begin());
  files.insert(files.begin(), std::make_move_iterator(tiles.begin()), std::make_move_iterator(tiles.end()));
  return {};
}

}  // namespace scarp::cli
