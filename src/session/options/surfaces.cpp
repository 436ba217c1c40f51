#include "session/options/surfaces.h"

#include <fmt/format.h>

#include <string_view>

#include "session/options/values.h"
#include "session/text/text.h"

namespace scarp::cli {
namespace {

using enum OptionId;

constexpr std::string_view kLevelIs = "level=";

Result<GivenSurface> parse_surface(const std::string& text) {
  if (!text.starts_with(kLevelIs)) return GivenSurface{text};
  SCARP_TRY(const double level, parse_number("level", text.substr(kLevelIs.size())));
  return GivenSurface{"", level};
}

}  // namespace

std::string GivenSurface::name() const {
  return level ? fmt::format("level {}", format_number(*level)) : base_name(path);
}

Result<std::array<GivenSurface, 2>> parse_surfaces(const GivenOptions& given) {
  if (given.inputs().size() > 1)
    return fail(ErrorKind::kUsage,
                fmt::format("{} compares two surfaces, and {} are given", kVolume, given.inputs().size() + 1));
  SCARP_TRY(GivenSurface from, parse_surface(given.input()));
  SCARP_TRY(GivenSurface to, parse_surface(*given[kMesh]));
  if (from.level && to.level)
    return fail(ErrorKind::kUsage,
                fmt::format("{} compares two surfaces, and both are levels: give a mesh in place of one", kVolume));
  return std::array{std::move(from), std::move(to)};
}

}  // namespace scarp::cli
