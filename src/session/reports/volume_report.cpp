#include "session/reports/volume_report.h"

#include <fmt/format.h>

#include <cmath>

#include "scarp/version.h"
#include "session/text/json_text.h"
#include "session/text/text.h"

namespace scarp::cli {
namespace {

std::string volume_line(const char* name, const std::string& value) { return fmt::format("  {:<20}{}\n", name, value); }

/// "12,345,678", or format_number() for a small value.
std::string format_amount(double value) {
  constexpr double kLarge = 1e4, kTooLarge = 1e18;
  if (!(std::abs(value) >= kLarge) || std::abs(value) >= kTooLarge) return format_number(value);
  return (value < 0 ? "-" : "") + format_count(static_cast<std::uint64_t>(std::llround(std::abs(value))));
}

Json describe_surface(const Surface& surface, double outside) {
  return Json{{"path", surface.given.level ? Json(nullptr) : Json(surface.given.path)},
              {"level", or_null(surface.given.level)},
              {"triangles", surface.mesh.triangle_count()},
              {"max_error", or_null(surface.max_error)},
              {"outside", outside},
              {"metadata", surface.mesh.metadata}};
}

/// The max errors that add up to the uncertainty.
std::string describe_errors(const ComparedSurfaces& compared) {
  std::string known, unknown;
  for (const Surface& surface : compared.surfaces) {
    if (surface.given.level) continue;
    std::string& text = surface.max_error ? known : unknown;
    text += text.empty() ? "" : " and ";
    text += surface.given.name();
    if (surface.max_error) text += fmt::format(" {} {}", format_number(*surface.max_error), compared.units.height);
    while (text.ends_with(' ')) text.pop_back();
  }
  if (unknown.empty()) return "max errors times the common area: " + known;
  return fmt::format("not known: {} {} no max error", unknown,
                     unknown.find(" and ") == std::string::npos ? "holds" : "hold");
}

}  // namespace

std::optional<double> ComparedSurfaces::uncertainty() const {
  const auto& [from, to] = surfaces;
  if (!from.max_error || !to.max_error) return std::nullopt;
  return (*from.max_error + *to.max_error) * volumes.common_area;
}

Json make_report(const ComparedSurfaces& compared, const std::string& command_line) {
  const auto& [from, to] = compared.surfaces;
  const Volumes& volumes = compared.volumes;
  const auto unit = [&](const std::string& words) { return compared.units.are_known ? Json(words) : Json(nullptr); };
  Json report{{"scarp", version()}, {"command", command_line}};
  report["from"] = describe_surface(from, volumes.from_outside);
  report["to"] = describe_surface(to, volumes.to_outside);
  report["cut"] = volumes.cut;
  report["fill"] = volumes.fill;
  report["net"] = volumes.net();
  report["uncertainty"] = or_null(compared.uncertainty());
  report["common_area"] = volumes.common_area;
  report["volume_unit"] = unit(compared.units.volume);
  report["area_unit"] = unit(compared.units.area);
  report["seconds"] = Json{{"read", compared.seconds_read},
                           {"measure", compared.seconds_measure},
                           {"total", compared.seconds_read + compared.seconds_measure}};
  return report;
}

std::string make_table(const ComparedSurfaces& compared) {
  const auto& [from, to] = compared.surfaces;
  const Volumes& volumes = compared.volumes;
  const std::string before = from.given.name(), after = to.given.name();
  const std::optional<double> uncertainty = compared.uncertainty();
  const std::string within =
      uncertainty ? fmt::format(" ± {} {}", format_amount(*uncertainty), compared.units.volume) : "";
  const auto volume = [&](double value, const std::string& note) {
    return fmt::format("{} {}{}, {}", format_amount(value), compared.units.volume, within, note);
  };
  const auto area = [&](double value) { return fmt::format("{} {}", format_amount(value), compared.units.area); };
  std::string text = fmt::format("volumes from {} to {}\n", before, after);
  text += volume_line("cut", volume(volumes.cut, fmt::format("where {} lies below {}", after, before)));
  text += volume_line("fill", volume(volumes.fill, "where it lies above"));
  const double net = volumes.net();
  text += volume_line("net", volume(std::abs(net), net == 0  ? "as much cut as fill"
                                                   : net > 0 ? "more cut than fill"
                                                             : "more fill than cut"));
  text += volume_line("common area", area(volumes.common_area));
  if (!from.given.level && !to.given.level)
    text += volume_line("outside it", fmt::format("{} of {}, {} of {}", area(volumes.from_outside), before,
                                                  area(volumes.to_outside), after));
  return text + volume_line("uncertainty", describe_errors(compared));
}

}  // namespace scarp::cli
