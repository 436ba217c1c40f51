#include <fmt/format.h>
#include <spawn.h>
#include <sys/wait.h>
#include <unistd.h>

#include <filesystem>
#include <string_view>
#include <utility>

#include "commands/commands.h"
#include "scarp/io.h"
#include "scarp/measure.h"
#include "scarp/mesh.h"
#include "session/inputs/mesh_place.h"
#include "session/options/output_kind.h"
#include "session/options/raster_options.h"
#include "session/plan/outputs.h"
#include "session/plan/page_template.h"
#include "session/reports/level_pages.h"
#include "session/reports/view_page.h"
#include "session/table/option_table.h"
#include "session/text/paths.h"
#include "session/text/text.h"

namespace scarp::cli {
namespace {

using enum OptionId;

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

/// True for a tileset; other folders lack these files.
bool is_tile_set(const std::string& path) {
  std::error_code error;
  const std::filesystem::path folder = path;
  return names_tile_set(path) &&
         (!std::filesystem::is_directory(folder, error) || std::filesystem::exists(folder / "layer.json", error) ||
          std::filesystem::exists(folder / "tileset.json", error));
}

/// A mesh for each level that the page can hold, the finest first.
Result<std::vector<PageMesh>> read_levels(const std::string& path, std::vector<std::string>& warnings) {
  SCARP_TRY(const auto& set, open_tile_set(path));
  const auto levels = check::read_level_meshes(*set, kMostTileBytes);
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
  if (const auto faults = check::find_set_faults(*set); !faults.empty()) {
    const std::string more = faults.size() > 1 ? fmt::format(", and {} more", faults.size() - 1) : "";
    warnings.push_back(fmt::format("{} is not whole: {}{}; 'scarp tile check {}' tells all", path, faults.front(), more,
                                   shell_word(path)));
  }
  return encode_levels(without_slash(path), *levels);
}

/// MESH; for OUT_lod0.glb, also the other levels.
std::vector<std::string> mesh_paths(const GivenOptions& given) {
  const std::string& mesh = *given[kMesh];
  std::vector<std::string> paths{mesh};
  const std::size_t at = mesh.rfind("_lod0.");
  if (at == std::string::npos) return paths;
  for (int level = 1;; ++level) {
    const std::string path = fmt::format("{}_lod{}{}", mesh.substr(0, at), level, mesh.substr(at + 5));
    if (!std::filesystem::exists(path)) return paths;
    paths.push_back(path);
  }
}

/// Reads the meshes of a page without a raster, `first` completely.
Result<std::vector<PageMesh>> read_meshes(const GivenOptions& given, bool is_y_up, Mesh& first) {
  std::vector<PageMesh> meshes;
  for (const std::string& path : mesh_paths(given)) {
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

/// Reads the raster in the coordinates of the mesh.
Result<OwnedHeightField> read_raster(const GivenOptions& given, const Mesh& mesh, std::vector<std::string>& warnings) {
  const GivenOptions asked = remember_options(given, mesh);
  SCARP_TRY(ReadOptions read, parse_reading(asked));
  read.heights_in = heights_in(*given[kMesh]);
  Result<OwnedHeightField> field = read_height_field(given.input(), read);
  if (!field && is_point_file(given.input())) {
    return fail(
        ErrorKind::kInput,
        fmt::format("{} holds points, and a page judges by a raster alone: 'scarp view {}' shows the mesh, "
                    "'scarp measure {} {}' judges it",
                    given.input(), shell_word(*given[kMesh]), shell_word(given.input()), shell_word(*given[kMesh])));
  }
  if (!field) return tl::unexpected(explain_reading(given, std::move(field.error())));
  if (!asked.has(kCrs) && fit_frame(mesh, *field)) {
    read.crs = "source";
    if (field = read_height_field(given.input(), read); !field) return field;
  }
  if (!given.has(kCrs)) warnings = place_frame(mesh, *field);
  return field;
}

/// Fails with kPromise if the mesh covers no sample, like measure.
Result<void> check_place(const GivenOptions& given, const Mesh& mesh, const OwnedHeightField& field) {
  SCARP_TRY(const auto& measured, measure(field.view(), mesh, {.topology = false}));
  if (measured.samples > 0) return {};
  return fail(ErrorKind::kPromise,
              *given[kMesh] + ": " + describe_elsewhere(extent_of(mesh), extent_of(field.view()), given.input()));
}

}  // namespace

Result<void> run_view(const GivenOptions& given, const std::string&) {
  if (given.inputs().empty()) {
    for (const OptionRow* row : given.given()) {
      if (row->id == kUp || (row->group != OptionGroup::kInput && row->group != OptionGroup::kNodata)) continue;
      return fail(ErrorKind::kUsage,
                  fmt::format("an option of a raster is given ({}), and no RASTER: scarp view {} RASTER", row->name,
                              shell_word(*given[kMesh])));
    }
  }
  if (!given.inputs().empty()) {
    SCARP_RETURN_IF_ERROR(parse_reading(given));
  }
  SCARP_TRY(const bool is_y_up, parse_up(given[kUp]));
  const bool is_set = is_tile_set(*given[kMesh]);
  if (is_set && !given.inputs().empty()) {
    return fail(
        ErrorKind::kUsage,
        fmt::format("{} is a set of tiles, which is shown without a raster: 'scarp tile check {} {} {}' judges it",
                    *given[kMesh], shell_word(*given[kMesh]), kSource, shell_word(given.input())));
  }
  if (std::error_code error; !is_set && std::filesystem::is_directory(*given[kMesh], error)) {
    return fail(ErrorKind::kInput, fmt::format("{} is a folder without layer.json or tileset.json, so no set of tiles: "
                                               "name the folder that holds one of them, or a mesh",
                                               *given[kMesh]));
  }
  SCARP_TRY(const auto& page_template, read_page_template());
  const std::string path =
      given[kPage].value_or(std::filesystem::path(without_slash(*given[kMesh])).replace_extension(".html").string());
  SCARP_RETURN_IF_ERROR(check_outputs({{name_of(kPage), path}}, given.files_read(), given.has(kOverwrite)));
  Mesh mesh;
  std::vector<std::string> warnings;
  SCARP_TRY(const auto& meshes, is_set ? read_levels(*given[kMesh], warnings) : read_meshes(given, is_y_up, mesh));
  std::optional<OwnedHeightField> field;
  if (!given.inputs().empty()) {
    SCARP_TRY(field, read_raster(given, mesh, warnings));
    SCARP_RETURN_IF_ERROR(check_place(given, mesh, *field));
  }
  SCARP_TRY(const auto& page,
            make_view_page(page_template, without_slash(*given[kMesh]), meshes, field ? &*field : nullptr));
  if (page.left_out) warnings.push_back(*page.left_out);
  SCARP_RETURN_IF_ERROR(write_file(path, page.html, given.has(kOverwrite)));
  if (!given.has(kQuiet)) {
    print_warnings(warnings);
    const std::string summary = fmt::format("{}: {}; open it in a browser\n", path, format_bytes(page.html.size()));
    if (is_stdout(path)) {
      print_to_stderr(summary);
    } else {
      SCARP_RETURN_IF_ERROR(print_summary(summary));
    }
  }
  return given.has(OptionId::kOpen) ? open_in_browser(path) : Result<void>();
}

}  // namespace scarp::cli
