#include "session/options/level_options.h"

#include <fmt/format.h>

#include "session/table/option_table.h"
#include "session/text/paths.h"

namespace scarp::cli {

void LevelArguments::add_to(CLI::App& command) {
  add_option(command, OptionId::kLods, lods);
  add_flag(command, OptionId::kLodsInOne, in_one);
  add_flag(command, OptionId::kLockBorder, locks_border);
}

Result<std::optional<Levels>> LevelArguments::parse(const OutputFormat& format, const std::string& output) const {
  const auto usage = [](std::string message) { return fail(ErrorKind::kUsage, std::move(message)); };
  if (!lods) {
    if (in_one) return usage("--lods-in-one needs --lods");
    return std::optional<Levels>();
  }
  const std::size_t colon = lods->find(':');
  SCARP_TRY(const std::uint64_t count, parse_count("--lods", lods->substr(0, colon), 2));
  if (count > 32) return usage(fmt::format("--lods {} is more than 32 levels", count));
  Levels levels{static_cast<int>(count)};
  if (colon != std::string::npos) {
    SCARP_TRY(const double ratio, parse_number(fmt::format("--lods {}: the ratio", *lods), lods->substr(colon + 1)));
    if (!(ratio > 1)) return usage(fmt::format("--lods {} has a ratio that is not above 1", *lods));
    levels.ratio = ratio;
  }
  if (!format.is_mesh())
    return usage(fmt::format("--lods writes meshes, and {} is none: choose .glb, .ply or .obj", format.title()));
  if (in_one && format.mesh != MeshFormat::kGlb)
    return usage(fmt::format("--lods-in-one writes one GLB, not {}: name OUTPUT .glb", format.title()));
  if (is_stdout(output) && !in_one) return usage("--lods writes several files: /dev/stdout is only one");
  return std::optional(levels);
}

std::string LevelArguments::canonical() const {
  return canonical_option("--lods", lods) + (locks_border ? " --lock-border" : "");
}

std::string level_path(const std::string& output, int level) {
  const std::size_t point = output.size() - lower_extension(output).size();
  return fmt::format("{}_lod{}{}", output.substr(0, point), level, output.substr(point));
}

}  // namespace scarp::cli
