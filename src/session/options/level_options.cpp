#include "session/options/level_options.h"

#include <fmt/format.h>

#include "session/table/option_table.h"
#include "session/text/paths.h"

namespace scarp::cli {

namespace {
using enum OptionId;
}

Result<std::optional<Levels>> parse_levels(const GivenOptions& given, const OutputFormat& format) {
  const auto usage = [](std::string message) { return fail(ErrorKind::kUsage, std::move(message)); };
  const Given& lods = given[kLods];
  if (!lods) return std::optional<Levels>();
  const std::size_t colon = lods->find(':');
  SCARP_TRY(const std::uint64_t count, parse_count(name_of(kLods), lods->substr(0, colon), 2));
  if (count > 32) return usage(fmt::format("{} {} is more than 32 levels", kLods, count));
  Levels levels{static_cast<int>(count)};
  if (colon != std::string::npos) {
    SCARP_TRY(const double ratio, parse_number(fmt::format("{} {}: the ratio", kLods, *lods), lods->substr(colon + 1)));
    if (!(ratio > 1)) return usage(fmt::format("{} {} has a ratio that is not above 1", kLods, *lods));
    levels.ratio = ratio;
  }
  if (!format.is_mesh())
    return usage(fmt::format("{} writes meshes, and {} is none: choose .glb, .ply or .obj", kLods, format.title()));
  const bool in_one = given.has(kLodsInOne);
  if (in_one && !format.is_glb())
    return usage(fmt::format("{} writes one GLB, not {}: name OUTPUT .glb", kLodsInOne, format.title()));
  if (is_stdout(*given[kOutput]) && !in_one)
    return usage(fmt::format("{} writes several files: /dev/stdout is only one", kLods));
  return std::optional(levels);
}

std::string level_path(const std::string& output, int level) {
  const std::size_t point = output.size() - lower_extension(output).size();
  return fmt::format("{}_lod{}{}", output.substr(0, point), level, output.substr(point));
}

}  // namespace scarp::cli
