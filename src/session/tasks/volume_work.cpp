#include "session/tasks/volume_work.h"

#include <fmt/format.h>

#include <string>
#include <string_view>
#include <utility>

#include "session/inputs/mesh_place.h"
#include "session/options/output_kind.h"
#include "session/options/surfaces.h"
#include "session/text/clock.h"

namespace scarp::cli {
namespace {

using enum OptionId;

Result<Volumes> measure_between(const std::array<Surface, 2>& surfaces, const Run& run) {
  const auto& [from, to] = surfaces;
  if (to.given.level) return measure_volume(from.mesh, *to.given.level, run);
  if (!from.given.level) return measure_volume(from.mesh, to.mesh, run);
  SCARP_TRY(const Volumes& volumes, measure_volume(to.mesh, *from.given.level, run));
  return volumes.reversed();
}

/// The library's messages do not name the files.
Error with_names(Error error, const std::array<Surface, 2>& surfaces) {
  const auto& [from, to] = surfaces;
  const auto put = [&](std::string_view words, const std::string& name) {
    if (const std::size_t at = error.message.find(words); at != std::string::npos)
      error.message.replace(at, words.size(), name);
  };
  put("the first mesh", (from.given.level ? to : from).given.name());
  put("the second mesh", to.given.name());
  return error;
}

}  // namespace

Result<void> compare_surfaces(const GivenOptions& given, const Runner& runner, ComparedSurfaces& compared) {
  const Clock::time_point start = Clock::now();
  SCARP_TRY(const auto& asked, parse_surfaces(given));
  SCARP_TRY(const bool is_y_up, parse_up(given[kUp]));
  Run run;
  SCARP_TRY(run.threads, given.threads());
  run.progress = runner.progress;
  for (std::size_t k = 0; k < 2; ++k) {
    SCARP_TRY(compared.surfaces[k], read_surface(asked[k], is_y_up));
  }
  SCARP_TRY(compared.units, settle_frames(compared.surfaces));
  compared.seconds_read = seconds_since(start);
  if (const auto& [one, other] = compared.surfaces; !has_place(one) && !has_place(other))
    compared.warnings.push_back(
        fmt::format("neither {} nor {} holds its place: both are taken to be in one frame, and "
                    "meshes around middles of their own are not; .glb and .ply hold it",
                    one.given.name(), other.given.name()));

  const Clock::time_point measure_start = Clock::now();
  Result<Volumes> volumes = measure_between(compared.surfaces, run);
  if (!volumes) return tl::unexpected(with_names(std::move(volumes.error()), compared.surfaces));
  compared.volumes = *volumes;
  compared.seconds_measure = seconds_since(measure_start);
  if (compared.volumes.common_area > 0) return {};
  const auto& [from, to] = compared.surfaces;
  return fail(ErrorKind::kInput,
              fmt::format("{} and {} have no area in common: the one lies at {}, the other at {}; give meshes of one "
                          "place, in one frame",
                          from.given.name(), to.given.name(), extent_of(from.mesh).text(), extent_of(to.mesh).text()));
}

}  // namespace scarp::cli
