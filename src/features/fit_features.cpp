#include <fmt/format.h>

#include <cmath>
#include <utility>

#include "scarp/features.h"

namespace scarp {
namespace {

void add_lines(const std::vector<Line>& more, LineConstraints& lines) {
  lines.lines.insert(lines.lines.end(), more.begin(), more.end());
}

Result<void> fit_rivers(const HeightField& field, const Features& features, double max_error, FittedFeatures& fitted) {
  if (features.rivers.empty()) return {};
  SCARP_TRY(fitted.rivers, carve_rivers(field, features.rivers, features.lakes, {fitted.lines.affine, max_error / 2}));
  for (const River& river : fitted.rivers) fitted.lines.lines.push_back(river.course);
  return {};
}

Result<void> fit_walls(const HeightField& field, const WallGoals& goals, const FeatureFitOptions& options,
                       FittedFeatures& fitted) {
  CliffOptions cliffs;
  cliffs.height = goals.height;
  cliffs.max_error = options.max_error;
  cliffs.affine = fitted.lines.affine;
  cliffs.avoid = fitted.lines.lines;
  cliffs.run.memory.limit = options.run.memory.limit;
  cliffs.run.memory.taken = options.run.memory.taken;
  SCARP_TRY(auto&& walls, detect_cliffs(field, cliffs));
  add_lines(walls.lines, fitted.lines);
  fitted.walls = std::move(walls);
  return {};
}

Result<void> fit_ridges(const HeightField& field, const RidgeGoals& goals, const FeatureFitOptions& options,
                        FittedFeatures& fitted) {
  RidgeOptions asked;
  asked.height = goals.height;
  asked.max_error = options.max_error;
  asked.affine = fitted.lines.affine;
  asked.avoid = fitted.lines.lines;
  asked.are_kept = goals.are_kept;
  asked.run.threads = options.run.threads;
  asked.run.progress = options.run.progress;
  asked.run.memory.limit = options.run.memory.limit;
  asked.run.memory.taken = options.run.memory.taken;
  SCARP_TRY(auto&& ridges, detect_ridges(field, asked));
  add_lines(ridges.ridges, fitted.lines);
  add_lines(ridges.valleys, fitted.lines);
  fitted.ridges = std::move(ridges);
  return {};
}

}  // namespace

LineConstraints Features::fixed_lines() const {
  LineConstraints lines = breaklines;
  for (const Lake& lake : lakes) add_lines(lake.shore, lines);
  return lines;
}

std::uint64_t FittedFeatures::given_lines() const {
  return lines.lines.size() - (walls ? walls->lines.size() : 0) -
         (ridges ? ridges->ridges.size() + ridges->valleys.size() : 0);
}

Result<FittedFeatures> fit_features(const HeightField& field, const Features& features, const FeatureFitOptions& options) {
  if (!(options.max_error >= 0) || !std::isfinite(options.max_error))
    return fail(ErrorKind::kUsage,
                fmt::format("features are fitted to a max error of at least 0, not {}", options.max_error));
  FittedFeatures fitted{features.fixed_lines(), {}, std::nullopt, std::nullopt};
  auto fits = fit_rivers(field, features, options.max_error, fitted);
  if (fits && features.walls) fits = fit_walls(field, *features.walls, options, fitted);
  if (fits && features.ridges) fits = fit_ridges(field, *features.ridges, options, fitted);
  SCARP_RETURN_IF_ERROR(fits);
  return fitted;
}

}  // namespace scarp
