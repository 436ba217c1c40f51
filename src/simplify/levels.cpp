#include <fmt/format.h>

#include <cmath>
#include <utility>

#include "pieces/conflicts.h"
#include "scarp/simplify.h"

namespace scarp {

namespace {

constexpr int kMostLevels = 32;

Result<void> check(const HeightField& field, const SimplifyOptions& options, const Levels& levels) {
  const auto usage = [](std::string message) { return fail(ErrorKind::kUsage, std::move(message)); };
  if (levels.count < 1 || levels.count > kMostLevels)
    return usage(fmt::format("the number of levels must lie in 1 … {}, not {}", kMostLevels, levels.count));
  if (!(levels.ratio > 1 && std::isfinite(levels.ratio)))
    return usage(fmt::format("the ratio of levels must be a finite number above 1, not {}", levels.ratio));
  const auto conflicts =
      pieces::find_conflicts(pieces::fields_of(field, options) | pieces::Fields(pieces::Field::kLevels));
  if (!conflicts.empty()) return usage(pieces::describe(conflicts.front()));
  if (!options.goals.max_error) return usage("levels need a max error, that of the finest");
  return {};
}

}  // namespace

Result<std::vector<Simplified>> simplify_levels(const HeightField& field, const SimplifyOptions& asked,
                                                const Levels& levels) {
  SimplifyOptions options = asked;
  Border& border = options.domain.border;
  border.is_locked = true;
  SCARP_RETURN_IF_ERROR(check(field, options, levels));
  if (!border.max_error) border.max_error = asked.goals.max_error;
  std::vector<Simplified> meshes;
  for (int level = 0; level < levels.count; ++level) {
    options.goals.max_error = *asked.goals.max_error * std::pow(levels.ratio, level);
    SCARP_TRY(auto&& mesh, simplify(field, options));
    meshes.push_back(std::move(mesh));
  }
  return meshes;
}

}  // namespace scarp
