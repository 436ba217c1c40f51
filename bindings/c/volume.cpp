// measure_volume() by the program's own plans.
#include <fmt/format.h>

#include <CLI/CLI.hpp>
#include <limits>
#include <string>

#include "door.h"
#include "io/lend.h"
#include "mesh.h"
#include "session/options/given_options.h"
#include "session/table/option_table.h"
#include "session/tasks/runner.h"
#include "session/tasks/volume_work.h"
#include "settings.h"

namespace scarp::door {
namespace {

scarp_volumes describe_volumes(const cli::ComparedSurfaces& compared) {
  scarp_volumes volumes{};
  volumes.cut = compared.volumes.cut;
  volumes.fill = compared.volumes.fill;
  volumes.net = compared.volumes.net();
  volumes.uncertainty = compared.uncertainty().value_or(std::numeric_limits<double>::quiet_NaN());
  volumes.common_area = compared.volumes.common_area;
  volumes.from_outside = compared.volumes.from_outside;
  volumes.to_outside = compared.volumes.to_outside;
  return volumes;
}

/// Compares the two surfaces lent under these names, or one surface and a level.
scarp_status compare(const std::string& from, const std::string& to, const scarp_options* options, scarp_volumes* out) {
  const scarp_options asked = known(options, scarp_options_init);
  CLI::App program;
  cli::GivenOptions given(cli::kMeasure);
  given.add_to(program);
  if (auto parsed =
          parse_options(program, cli::kMeasure, {"measure", from, to}, asked, {cli::name_of(cli::OptionId::kVolume)});
      !parsed)
    return report(parsed.error());
  cli::ComparedSurfaces compared;
  if (auto done = cli::compare_surfaces(given, {progress_of(asked)}, compared); !done) return report(done.error());
  hand_out(describe_volumes(compared), out);
  return SCARP_OK;
}

constexpr const char* kFromName = "the first mesh";
constexpr const char* kToName = "the second mesh";

scarp_status refuse_null_surface() {
  return report(ErrorKind::kUsage, "a mesh, or the place for its volumes, is a null pointer");
}

}  // namespace
}  // namespace scarp::door

using namespace scarp::door;

extern "C" {

scarp_status scarp_measure_volume(const scarp_mesh* from, const scarp_mesh* to, const scarp_options* options,
                                  scarp_volumes* out) {
  return guarded([&]() -> scarp_status {
    if (from == nullptr || to == nullptr || out == nullptr) return refuse_null_surface();
    const scarp::io::Lent lent_from(kFromName, from->mesh), lent_to(kToName, to->mesh);
    return compare(kFromName, kToName, options, out);
  });
}

scarp_status scarp_measure_volume_to_level(const scarp_mesh* from, double level, const scarp_options* options,
                                           scarp_volumes* out) {
  return guarded([&]() -> scarp_status {
    if (from == nullptr || out == nullptr) return refuse_null_surface();
    const scarp::io::Lent lent(kFromName, from->mesh);
    return compare(kFromName, fmt::format("level={}", level), options, out);
  });
}

}  // extern "C"
