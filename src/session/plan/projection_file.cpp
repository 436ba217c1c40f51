#include "session/plan/projection_file.h"

#include <fmt/format.h>

#include <algorithm>
#include <filesystem>
#include <fstream>
#include <iterator>
#include <optional>
#include <utility>
#include <vector>

#include "scarp/io.h"
#include "session/text/paths.h"

namespace scarp::cli {
namespace {

namespace fs = std::filesystem;

std::string text_of(const std::string& path) {
  std::ifstream file(path, std::ios::binary);
  return {std::istreambuf_iterator<char>(file), {}};
}

/// True for outputs of Scarp that never need a .prj file.
bool needs_none(const fs::path& name) {
  const auto format = choose_output_format(Given(), name.string());
  return lower_extension(name.string()) == ".json" ||
         (format && format->kind != OutputKind::kDem && !format->has_projection_beside());
}

/// A file of another run with the name of the .prj file and another extension; empty if none.
std::string find_owner(const SimplifyPlan& plan, const fs::path& projection) {
  std::vector<fs::path> ours{projection.filename(), fs::path(plan.output).filename()};
  for (const auto* other : {&plan.preview, &plan.render, &plan.error_raster, &plan.html, &plan.report}) {
    if (*other) ours.push_back(fs::path(**other).filename());
  }
  for (int k = 0; plan.has_file_per_level() && k < plan.levels->count; ++k)
    ours.push_back(fs::path(level_path(plan.output, k)).filename());
  std::string owner;
  std::error_code error;
  const fs::path folder = projection.has_parent_path() ? projection.parent_path() : fs::path(".");
  for (fs::directory_iterator entry(folder, error), end; !error && entry != end; entry.increment(error)) {
    const fs::path name = entry->path().filename();
    if (name.stem() != projection.stem() || std::find(ours.begin(), ours.end(), name) != ours.end()) continue;
    if (needs_none(name)) continue;
    if (owner.empty() || name.string() < owner) owner = name.string();
  }
  return owner;
}

/// `output`: the mesh.
Result<std::optional<ProjectionFile>> plan_file(const SimplifyPlan& plan, const std::string& output,
                                                const std::string& text) {
  ProjectionFile file{fs::path(output).replace_extension(".prj").string(), text};
  std::error_code error;
  const bool is_there = fs::exists(file.path, error);
  if (is_there && text_of(file.path) == file.text) return std::nullopt;
  SCARP_RETURN_IF_ERROR(
      check_outputs({{"the .prj file of OUTPUT,", file.path}}, plan.given.files_read(), plan.overwrite));
  const std::string owner = is_there ? find_owner(plan, file.path) : "";
  if (!owner.empty()) {
    return fail(ErrorKind::kOutput,
                fmt::format("{} tells the CRS of {}, and would be replaced by that of OUTPUT: give OUTPUT another name",
                            file.path, owner));
  }
  return file;
}

}  // namespace

Result<std::vector<ProjectionFile>> plan_projection_files(const SimplifyPlan& plan, const std::string& crs) {
  std::vector<ProjectionFile> files;
  if (!plan.format.has_projection_beside() || is_stdout(plan.output)) return files;
  const auto text = projection_text(crs);
  if (!text) return files;
  const int levels = plan.has_file_per_level() ? plan.levels->count : 1;
  for (int k = 0; k < levels; ++k) {
    SCARP_TRY(auto&& file,
              plan_file(plan, plan.has_file_per_level() ? level_path(plan.output, k) : plan.output, *text));
    if (file) files.push_back(std::move(*file));
  }
  return files;
}

}  // namespace scarp::cli
