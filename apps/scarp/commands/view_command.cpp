#include "commands/view_command.h"

#include <fmt/format.h>
#include <spawn.h>
#include <sys/wait.h>
#include <unistd.h>

#include <filesystem>
#include <string_view>
#include <utility>

#include "scarp/io.h"
#include "scarp/measure.h"
#include "scarp/solid.h"
#include "session/inputs/mesh_place.h"
#include "session/options/output_kind.h"
#include "session/plan/outputs.h"
#include "session/plan/page_template.h"
#include "session/reports/level_pages.h"
#include "session/table/option_table.h"
#include "session/text/paths.h"
#include "session/text/text.h"

namespace scarp::cli {
namespace {

std::string without_slash(std::string path) {
  while (path.size() > 1 && path.back() == '/') path.pop_back();
  return path;
}

Result<void> open_in_browser(const std::string& path) {
  std::string program = "xdg-open", file = std::filesystem::absolute(path).string();
  char* const words[] = {program.data(), file.data(), nullptr};
  pid_t child = 0;
  int status = 0;
  const bool is_open = posix_spawnp(&child, program.c_str(), nullptr, nullptr, words, environ) == 0 &&
                       waitpid(child, &status, 0) == child && status == 0;
  if (is_open) return {};
  return fail(ErrorKind::kOutput,
              fmt::format("{} is written, but xdg-open cannot open it: open it in a browser", path));
}

/// A folder of something else lacks these files.
bool is_tile_set(const std::string& path) {
  std::error_code error;
  const std::filesystem::path folder = path;
  return names_tile_set(path) &&
         (!std::filesystem::is_directory(folder, error) || std::filesystem::exists(folder / "layer.json", error) ||
          std::filesystem::exists(folder / "tileset.json", error));
}

/// A mesh for each level that the page holds, the finest first.
Result<std::vector<PageMesh>> read_levels(const std::string& path, std::vector<std::string>& warnings) {
  SCARP_TRY(const auto& set, open_tile_set(path));
  const auto levels = read_level_meshes(*set, kMostTileBytes);
  if (!levels && levels.error().kind == ErrorKind::kUsage) {
    return fail(ErrorKind::kUsage,
                fmt::format("{} is too large for a page: {}; 'scarp serve {}' serves it to globes, with a page of "
                            "docs/guide/globe.md",
                            path, levels.error().message, shell_word(path)));
  }
  if (!levels) return fail(levels.error().kind, path + ": " + levels.error().message);
  const auto& tiles = set->tiles();
  std::size_t finest = tiles.size() - 1;
  while (tiles[finest].empty()) --finest;
  if (static_cast<int>(finest) > levels->front().z) {
    warnings.push_back(fmt::format(
        "the finest level of the page is {} of {}: those below it take more than {}; 'scarp serve {}' serves "
        "all of them to globes, with a page of docs/guide/globe.md",
        levels->front().z, finest, format_bytes(kMostTileBytes), shell_word(path)));
  }
  if (const auto faults = find_set_faults(*set); !faults.empty()) {
    const std::string more = faults.size() > 1 ? fmt::format(", and {} more", faults.size() - 1) : "";
    warnings.push_back(fmt::format("{} is not whole: {}{}; 'scarp tile check {}' tells all", path, faults.front(), more,
                                   shell_word(path)));
  }
  return encode_levels(without_slash(path), *levels);
}

}  // namespace

ViewCommand::ViewCommand(CLI::App& program) : command_(add_command(program, kView)) {
  add_option(*command_, OptionId::kMesh, mesh_);
  add_arguments(*command_, OptionId::kRaster, raster_.paths);
  raster_.add_to(*command_);
  add_option(*command_, OptionId::kUp, up_);
  add_option(*command_, OptionId::kPage, page_);
  add_flag(*command_, OptionId::kOpen, open_);
  add_flag(*command_, OptionId::kOverwrite, overwrite_);
  add_flag(*command_, OptionId::kQuiet, quiet_);
}

std::vector<std::string> ViewCommand::mesh_paths() const {
  std::vector<std::string> paths{mesh_};
  const std::size_t at = mesh_.rfind("_lod0.");
  if (at == std::string::npos) return paths;
  for (int level = 1;; ++level) {
    const std::string path = fmt::format("{}_lod{}{}", mesh_.substr(0, at), level, mesh_.substr(at + 5));
    if (!std::filesystem::exists(path)) return paths;
    paths.push_back(path);
  }
}

Result<std::vector<PageMesh>> ViewCommand::read_meshes(bool is_y_up, Mesh& first) const {
  std::vector<PageMesh> meshes;
  for (const std::string& path : mesh_paths()) {
    SCARP_TRY(auto&& bytes, read_file(path));
    SCARP_TRY(Mesh mesh, decode_mesh(bytes, path));
    turn_up(is_y_up, path, mesh);
    undo_placement(mesh);
    const std::uint64_t size = bytes.size();
    if (!std::string_view(reinterpret_cast<const char*>(bytes.data()), bytes.size()).starts_with("glTF")) {
      SCARP_TRY(bytes, encode_mesh(mesh, MeshFormat::kGlb));
    }
    if (meshes.empty()) first = std::move(mesh);
    meshes.push_back({path, size, std::move(bytes)});
  }
  return meshes;
}

Result<OwnedHeightField> ViewCommand::read_raster(const Mesh& mesh, std::vector<std::string>& warnings) const {
  const RasterArguments asked = remember_options(raster_, mesh);
  SCARP_TRY(ReadOptions read, asked.parse());
  read.heights_in = heights_in(mesh_);
  Result<OwnedHeightField> field = read_height_field(raster_.path(), read);
  if (!field && is_point_file(raster_.path())) {
    return fail(ErrorKind::kInput,
                fmt::format("{} holds points, and a page judges by a raster alone: 'scarp view {}' shows the mesh, "
                            "'scarp measure {} {}' judges it",
                            raster_.path(), shell_word(mesh_), shell_word(raster_.path()), shell_word(mesh_)));
  }
  if (!field) return tl::unexpected(raster_.explain(std::move(field.error())));
  if (!asked.crs && fit_frame(mesh, *field)) {
    read.crs = "source";
    if (field = read_height_field(raster_.path(), read); !field) return field;
  }
  if (!raster_.crs) warnings = place_frame(mesh, *field);
  return field;
}

Result<void> ViewCommand::check_place(const Mesh& mesh, const OwnedHeightField& field) const {
  SCARP_TRY(const auto& measured, measure(field.view(), mesh, {.topology = false}));
  if (measured.samples > 0) return {};
  return fail(ErrorKind::kPromise,
              mesh_ + ": " + describe_elsewhere(extent_of(mesh), extent_of(field.view()), raster_.path()));
}

Result<void> ViewCommand::run() const {
  if (raster_.paths.empty() && !raster_.canonical().empty()) {
    return fail(ErrorKind::kUsage,
                fmt::format("options of a raster are given ({}), and no RASTER: scarp view {} RASTER",
                            raster_.canonical().substr(1), shell_word(mesh_)));
  }
  if (!raster_.paths.empty()) {
    SCARP_RETURN_IF_ERROR(raster_.parse());
  }
  SCARP_TRY(const bool is_y_up, parse_up(up_));
  const bool is_set = is_tile_set(mesh_);
  if (is_set && !raster_.paths.empty()) {
    return fail(ErrorKind::kUsage,
                fmt::format("{} is a set of tiles, which is shown without a raster: 'scarp tile check {} "
                            "--source {}' judges it",
                            mesh_, shell_word(mesh_), shell_word(raster_.path())));
  }
  if (std::error_code error; !is_set && std::filesystem::is_directory(mesh_, error)) {
    return fail(ErrorKind::kInput, fmt::format("{} is a folder without layer.json or tileset.json, so no set of tiles: "
                                               "name the folder that holds one of them, or a mesh",
                                               mesh_));
  }
  SCARP_TRY(const auto& page_template, read_page_template());
  const std::string path =
      page_.value_or(std::filesystem::path(without_slash(mesh_)).replace_extension(".html").string());
  SCARP_RETURN_IF_ERROR(check_outputs({{"--output", path}}, files_read(*command_), overwrite_));
  Mesh mesh;
  std::vector<std::string> warnings;
  SCARP_TRY(const auto& meshes, is_set ? read_levels(mesh_, warnings) : read_meshes(is_y_up, mesh));
  std::optional<OwnedHeightField> field;
  if (!raster_.paths.empty()) {
    SCARP_TRY(field, read_raster(mesh, warnings));
    SCARP_RETURN_IF_ERROR(check_place(mesh, *field));
  }
  SCARP_TRY(const auto& page, make_view_page(page_template, without_slash(mesh_), meshes, field ? &*field : nullptr));
  if (page.left_out) warnings.push_back(*page.left_out);
  SCARP_RETURN_IF_ERROR(write_file(path, page.html, overwrite_));
  if (!quiet_) {
    print_warnings(warnings);
    const std::string summary = fmt::format("{}: {}; open it in a browser\n", path, format_bytes(page.html.size()));
    if (is_stdout(path)) {
      print_to_stderr(summary);
    } else {
      SCARP_RETURN_IF_ERROR(print_summary(summary));
    }
  }
  return open_ ? open_in_browser(path) : Result<void>();
}

}  // namespace scarp::cli
